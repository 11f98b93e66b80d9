//! What the error would be if a group had been left out, without fitting again.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::cholesky::llt::solve::{solve_in_place, solve_in_place_scratch};
use faer::{Mat, Par};
use rayon::prelude::*;
use taceva_core::{ModelError, Progress};

use crate::choice::Errors;
use crate::linalg::{Spectrum, multiply};
use crate::problem::centred;
use crate::progress::{Stage, interrupted};

/// The mean squared error of each target at each penalty, each group predicted by a fit that never saw it.
///
/// With the hat matrix H of the fit to all, the residuals of a group g left out are (I − H_gg)⁻¹ e_g of the residuals
/// e = (I − H)y (exact for a penalty that does not depend on the group). I − H is computed as U diag(λ / (σ² + λ)) Uᵀ + R,
/// U without its part along 1 and R what U does not span: at small λ, where I and H nearly cancel, nothing is subtracted.
pub(super) fn errors(
    spectrum: &Spectrum<'_, '_>,
    targets: &Mat<f64>,
    penalties: &[f64],
    groups: &[Vec<usize>],
    progress: &dyn Progress,
) -> Result<Errors, ModelError> {
    let (_, vectors) = centred(spectrum.sample_vectors());
    let rotated = multiply(vectors.transpose(), targets.as_ref());
    let parts: Vec<Group> = groups
        .iter()
        .map(|group| {
            let vectors = rows(&vectors, group);
            let size = group.len();
            let (unspanned, residuals) = if spectrum.spans_samples() {
                (Mat::zeros(size, size), Mat::zeros(size, targets.ncols()))
            } else {
                let projector = centring(size, targets.nrows());
                let spanned = multiply(vectors.as_ref(), vectors.transpose());
                let fitted = multiply(vectors.as_ref(), rotated.as_ref());
                (projector - spanned, rows(targets, group) - fitted)
            };
            Group {
                vectors,
                unspanned,
                residuals,
            }
        })
        .collect();
    let left_out = LeftOut {
        groups: parts,
        eigenvalues: spectrum.eigenvalues(),
        rotated,
        samples: targets.nrows(),
    };
    let stage = Stage::begin(progress, "leaving out", penalties.len());
    penalties
        .par_iter()
        .map(|&penalty| {
            interrupted(progress)?;
            let errors = left_out.errors(penalty);
            stage.advance();
            Ok(errors)
        })
        .collect()
}

struct LeftOut<'s> {
    groups: Vec<Group>,
    eigenvalues: &'s [f64],
    /// Uᵀ of the targets.
    rotated: Mat<f64>,
    samples: usize,
}

/// What the rows of one group know, whatever the penalty.
struct Group {
    /// Its rows of U.
    vectors: Mat<f64>,
    /// Its block of R.
    unspanned: Mat<f64>,
    /// Its rows of R times the targets.
    residuals: Mat<f64>,
}

impl LeftOut<'_> {
    fn errors(&self, penalty: f64) -> Vec<f64> {
        let channels = self.rotated.ncols();
        let shrinkage = |row: usize| penalty / (self.eigenvalues[row] + penalty);
        let coefficients = Mat::from_fn(self.eigenvalues.len(), channels, |row, channel| {
            shrinkage(row) * self.rotated[(row, channel)]
        });
        let mut squares = vec![0.0; channels];
        for group in &self.groups {
            let vectors = &group.vectors;
            let shrunk = Mat::from_fn(vectors.nrows(), vectors.ncols(), |row, column| {
                vectors[(row, column)] * shrinkage(column)
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
        squares
            .iter_mut()
            .for_each(|square| *square /= self.samples as f64);
        squares
    }
}

/// A diagonal block of I − 11ᵀ/n.
fn centring(size: usize, samples: usize) -> Mat<f64> {
    Mat::from_fn(size, size, |row, column| {
        let identity = if row == column { 1.0 } else { 0.0 };
        identity - 1.0 / samples as f64
    })
}

/// The solution for a positive definite matrix; `None` where rounding leaves none, at penalties too weak to judge.
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

fn rows(matrix: &Mat<f64>, positions: &[usize]) -> Mat<f64> {
    Mat::from_fn(positions.len(), matrix.ncols(), |row, column| {
        matrix[(positions[row], column)]
    })
}
