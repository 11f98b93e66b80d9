//! Leave-out errors, computed without refitting.

mod groups;
mod singles;

use faer::Mat;

use crate::linalg::{Spectrum, multiply};
use crate::training::problem::centred;

/// Leave-out residuals from a fit to all samples.
///
/// Let H be the hat matrix of the whole fit and e = (I − H)y its residuals. A left-out group g has the residuals (I − H_gg)⁻¹ e_g. This is exact for
/// a penalty that does not depend on the group. I − H is computed as U diag(λ / (σ² + λ)) Uᵀ + R, with the penalty λ and the eigenvalues σ² of the
/// Gram matrix of samples. U are its eigenvectors, centred, and R is the part of the centring matrix not spanned by U. This avoids the loss of digits
/// in I − H at small λ, where I and H nearly cancel.
pub(super) struct LeaveOut<'s> {
    targets: &'s Mat<f64>,
    eigenvalues: &'s [f64],
    /// Centred eigenvectors U of the Gram matrix.
    vectors: Mat<f64>,
    /// Targets rotated by Uᵀ.
    rotated: Mat<f64>,
    /// True if the remainder R is 0, because U spans all centred targets.
    complete: bool,
}

impl<'s> LeaveOut<'s> {
    /// Prepares leave-out errors for centred `targets` and features with `spectrum`.
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

    /// Factors λ / (σ² + λ) for every eigenvalue (row) and penalty (column).
    fn shrinkage(&self, penalties: &[f64]) -> Mat<f64> {
        Mat::from_fn(self.eigenvalues.len(), penalties.len(), |row, column| {
            penalties[column] / (self.eigenvalues[row] + penalties[column])
        })
    }

    /// Rows `positions` of the product of R and the targets. `vectors` contains the same rows of U.
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
