//! What the error would be if a group had been left out, without fitting again.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::cholesky::llt::solve::{solve_in_place, solve_in_place_scratch};
use faer::{Mat, MatRef, Par};
use rayon::prelude::*;
use taceva_core::{ModelError, Progress};

use crate::choice::Errors;
use crate::linalg::{Spectrum, multiply};
use crate::progress::{Stage, interrupted};

/// The mean squared error of each target at each penalty, each group predicted by a fit that never saw it.
///
/// With H = U diag(σ² / (σ² + λ)) Uᵀ + 11ᵀ/n, the residuals of the group g left out are (I − H_gg)⁻¹ e_g of the residuals
/// e of the fit to all (exact for a penalty that does not depend on the group).
pub(super) fn errors(
    spectrum: &Spectrum<'_, '_>,
    targets: &Mat<f64>,
    penalties: &[f64],
    groups: &[Vec<usize>],
    progress: &dyn Progress,
) -> Result<Errors, ModelError> {
    let vectors = spectrum.sample_vectors();
    let rotated = multiply(vectors.transpose(), targets.as_ref());
    let left_out = LeftOut {
        parts: groups.iter().map(|group| rows(&vectors, group)).collect(),
        targets: groups.iter().map(|group| rows(targets, group)).collect(),
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
    /// For each group, its rows of U.
    parts: Vec<Mat<f64>>,
    /// For each group, its rows of the targets.
    targets: Vec<Mat<f64>>,
    eigenvalues: &'s [f64],
    /// Uᵀ of the targets.
    rotated: Mat<f64>,
    samples: usize,
}

impl LeftOut<'_> {
    fn errors(&self, penalty: f64) -> Vec<f64> {
        let channels = self.rotated.ncols();
        let shrinkage = |row: usize| self.eigenvalues[row] / (self.eigenvalues[row] + penalty);
        let coefficients = Mat::from_fn(self.eigenvalues.len(), channels, |row, channel| {
            shrinkage(row) * self.rotated[(row, channel)]
        });
        let mut squares = vec![0.0; channels];
        for (part, targets) in self.parts.iter().zip(&self.targets) {
            let fitted = multiply(part.as_ref(), coefficients.as_ref());
            let shrunk = Mat::from_fn(part.nrows(), part.ncols(), |row, column| {
                part[(row, column)] * shrinkage(column)
            });
            let hat = multiply(shrunk.as_ref(), part.transpose());
            let mean_hat = 1.0 / self.samples as f64;
            let complement = Mat::from_fn(part.nrows(), part.nrows(), |row, column| {
                let identity = if row == column { 1.0 } else { 0.0 };
                identity - hat[(row, column)] - mean_hat
            });
            let residuals = solve(complement, (targets - &fitted).as_ref());
            for (channel, square) in squares.iter_mut().enumerate() {
                *square += residuals.as_ref().map_or(f64::INFINITY, |residuals| {
                    residuals
                        .col_as_slice(channel)
                        .iter()
                        .map(|value| value * value)
                        .sum()
                });
            }
        }
        squares
            .iter_mut()
            .for_each(|square| *square /= self.samples as f64);
        squares
    }
}

/// The solution for a positive definite matrix; `None` where rounding leaves none, at penalties too weak to judge.
fn solve(mut matrix: Mat<f64>, right: MatRef<'_, f64>) -> Option<Mat<f64>> {
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
    let mut solution = right.to_owned();
    solve_in_place(matrix.as_ref(), solution.as_mut(), Par::Seq, stack);
    Some(solution)
}

fn rows(matrix: &Mat<f64>, positions: &[usize]) -> Mat<f64> {
    Mat::from_fn(positions.len(), matrix.ncols(), |row, column| {
        matrix[(positions[row], column)]
    })
}
