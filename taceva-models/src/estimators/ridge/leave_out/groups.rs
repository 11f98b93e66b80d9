//! Leave-one-group-out errors of ridge regression.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::cholesky::llt::solve::{solve_in_place, solve_in_place_scratch};
use faer::{Mat, Par};
use rayon::prelude::*;
use taceva_core::{ModelError, Progress};

use super::{LeaveOut, rows};
use crate::linalg::multiply;
use crate::linalg::progress::{ReportedStage, interrupted};
use crate::training::choice::Errors;

/// Precomputed matrices of one left-out group. They do not depend on the penalty.
struct Group {
    /// Rows for the group's samples in the eigenvectors U of [`LeaveOut`].
    vectors: Mat<f64>,
    /// Rows and columns for the group's samples in R, the part of the centring matrix that U does not span.
    unspanned: Mat<f64>,
    /// Rows for the group's samples in the product of R and the targets.
    residuals: Mat<f64>,
}

impl LeaveOut<'_> {
    /// Squared error, averaged over samples: one row per penalty, one column per target. Each group is predicted by a fit to the other groups.
    pub(in crate::estimators::ridge) fn groups(
        &self,
        groups: &[Vec<usize>],
        penalties: &[f64],
        progress: &dyn Progress,
    ) -> Result<Errors, ModelError> {
        let groups: Vec<Group> = groups.iter().map(|group| self.group(group)).collect();
        let stage = ReportedStage::begin(progress, "leaving groups out", penalties.len());
        penalties
            .par_iter()
            .map(|&penalty| {
                interrupted(progress)?;
                let errors = self.errors(&groups, penalty);
                stage.advance();
                Ok(errors)
            })
            .collect()
    }

    fn group(&self, positions: &[usize]) -> Group {
        let vectors = rows(&self.vectors, positions);
        let size = positions.len();
        let unspanned = if self.complete {
            Mat::zeros(size, size)
        } else {
            centring(size, self.targets.nrows()) - multiply(vectors.as_ref(), vectors.transpose())
        };
        Group {
            residuals: self.unspanned_residuals(positions, &vectors),
            vectors,
            unspanned,
        }
    }

    fn errors(&self, groups: &[Group], penalty: f64) -> Vec<f64> {
        let channels = self.targets.ncols();
        let shrinkage = self.shrinkage(&[penalty]);
        let shrinkage = shrinkage.col_as_slice(0);
        let coefficients = Mat::from_fn(shrinkage.len(), channels, |row, channel| {
            shrinkage[row] * self.rotated[(row, channel)]
        });
        let mut squares = vec![0.0; channels];
        for group in groups {
            let vectors = &group.vectors;
            let shrunk = Mat::from_fn(vectors.nrows(), vectors.ncols(), |row, column| {
                vectors[(row, column)] * shrinkage[column]
            });
            let complement = multiply(shrunk.as_ref(), vectors.transpose()) + &group.unspanned;
            let residuals = multiply(vectors.as_ref(), coefficients.as_ref()) + &group.residuals;
            let left_out = solve(complement, residuals);
            for (channel, square) in squares.iter_mut().enumerate() {
                *square += left_out.as_ref().map_or(f64::INFINITY, |left_out| {
                    let left_out = left_out.col_as_slice(channel).iter();
                    left_out.map(|value| value * value).sum()
                });
            }
        }
        let samples = self.targets.nrows() as f64;
        squares.iter_mut().for_each(|square| *square /= samples);
        squares
    }
}

/// Diagonal block with `size` rows of the centring matrix I − 11ᵀ/n, where n is the number of `samples`.
fn centring(size: usize, samples: usize) -> Mat<f64> {
    Mat::from_fn(size, size, |row, column| {
        let identity = if row == column { 1.0 } else { 0.0 };
        identity - 1.0 / samples as f64
    })
}

/// Solves `matrix` × x = `right`. `None` if `matrix` is not numerically positive definite, as for very weak penalties.
fn solve(mut matrix: Mat<f64>, mut right: Mat<f64>) -> Option<Mat<f64>> {
    let size = matrix.nrows();
    let scratch = cholesky_in_place_scratch::<f64>(size, Par::Seq, Default::default())
        .or(solve_in_place_scratch::<f64>(size, right.ncols(), Par::Seq));
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    cholesky_in_place(
        matrix.as_mut(),
        Default::default(),
        Par::Seq,
        stack,
        Default::default(),
    )
    .ok()?;
    solve_in_place(matrix.as_ref(), right.as_mut(), Par::Seq, stack);
    Some(right)
}
