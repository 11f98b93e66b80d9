//! Leave-out errors without refitting.

mod groups;
mod singles;

use faer::Mat;

use crate::linalg::{Spectrum, multiply};
use crate::training::problem::centred;

/// Leave-out residuals from a fit to all samples.
///
/// With the hat matrix H of the whole fit and residuals e = (I − H)y, a left-out group g has the residuals (I − H_gg)⁻¹ e_g. This is
/// exact for a penalty that does not depend on the group. I − H is computed as U diag(λ / (σ² + λ)) Uᵀ + R, with U without its part
/// along 1 and R the part not spanned by U. At small λ, where I and H nearly cancel, this subtracts nothing.
pub(super) struct LeaveOut<'s> {
    targets: &'s Mat<f64>,
    eigenvalues: &'s [f64],
    /// Eigenvectors U.
    vectors: Mat<f64>,
    /// Rotated targets, Uᵀ times the targets.
    rotated: Mat<f64>,
    /// True if R is 0.
    complete: bool,
}

impl<'s> LeaveOut<'s> {
    /// Prepares leaving out for centred `targets` and features with `spectrum`.
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

    /// Rows `positions` of R times the targets. `vectors` are the same rows of U.
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
