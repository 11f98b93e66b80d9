//! What the error would be if samples had been left out, without fitting again.

mod groups;
mod singles;

use faer::Mat;

use crate::linalg::{Spectrum, multiply};
use crate::training::problem::centred;

/// What a fit to all samples says about fits to fewer.
///
/// With the hat matrix H of the fit to all, the residuals of a group g left out are (I − H_gg)⁻¹ e_g of the residuals
/// e = (I − H)y (exact for a penalty that does not depend on the group). I − H is computed as U diag(λ / (σ² + λ)) Uᵀ + R,
/// U without its part along 1 and R what U does not span: at small λ, where I and H nearly cancel, nothing is subtracted.
pub(super) struct LeaveOut<'s> {
    targets: &'s Mat<f64>,
    eigenvalues: &'s [f64],
    /// U.
    vectors: Mat<f64>,
    /// Uᵀ of the targets.
    rotated: Mat<f64>,
    /// Whether R is 0.
    complete: bool,
}

impl<'s> LeaveOut<'s> {
    /// For the centred `targets` whose features have `spectrum`.
    pub(super) fn new(spectrum: &'s Spectrum<'_, '_>, targets: &'s Mat<f64>) -> LeaveOut<'s> {
        let (_, vectors) = centred(spectrum.sample_vectors());
        LeaveOut {
            targets,
            eigenvalues: spectrum.eigenvalues(),
            rotated: multiply(vectors.transpose(), targets.as_ref()),
            vectors,
            complete: spectrum.spans_samples(),
        }
    }

    /// λ / (σ² + λ) for every eigenvalue (row) and penalty (column).
    fn shrinkage(&self, penalties: &[f64]) -> Mat<f64> {
        Mat::from_fn(self.eigenvalues.len(), penalties.len(), |row, column| {
            penalties[column] / (self.eigenvalues[row] + penalties[column])
        })
    }

    /// The rows at `positions` of R times the targets; `vectors` are those rows of U.
    fn unspanned_residuals(&self, positions: &[usize], vectors: &Mat<f64>) -> Mat<f64> {
        if self.complete {
            return Mat::zeros(positions.len(), self.targets.ncols());
        }
        rows(self.targets, positions) - multiply(vectors.as_ref(), self.rotated.as_ref())
    }
}

fn rows(matrix: &Mat<f64>, positions: &[usize]) -> Mat<f64> {
    Mat::from_fn(positions.len(), matrix.ncols(), |row, column| {
        matrix[(positions[row], column)]
    })
}
