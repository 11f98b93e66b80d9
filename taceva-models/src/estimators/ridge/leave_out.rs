//! Leave-out errors of ridge regression, computed from one fit to all samples.

mod groups;
mod singles;

use faer::Mat;

use crate::linalg::{Spectrum, multiply};
use crate::training::problem::centred;

/// Residuals of left-out samples, computed from one fit to all samples.
///
/// Let H be the hat matrix of that fit, y the labels and e = (I − H)y its residuals. A left-out group g has the residuals (I − H_gg)⁻¹ e_g, where the
/// index g selects the rows and columns of the group. This is exact if the penalty does not depend on the group. I − H is computed as the sum of U
/// diag(λ / (σ² + λ)) Uᵀ and R. Here λ is the penalty. The Gram matrix of samples has the eigenvalues σ² and the centred eigenvectors U. R is the
/// part of the centring matrix that U does not span. At small λ, this form keeps the digits that I − H would lose.
pub(super) struct LeaveOut<'s> {
    targets: &'s Mat<f64>,
    eigenvalues: &'s [f64],
    /// Centred eigenvectors U of the Gram matrix.
    vectors: Mat<f64>,
    /// Product Uᵀ × targets: one row per eigenvector, one column per channel.
    rotated: Mat<f64>,
    /// True if the eigenvectors U span all centred targets. The remainder R of [`LeaveOut`] is then 0.
    complete: bool,
}

impl<'s> LeaveOut<'s> {
    /// Prepares leave-out errors for the centred labels `targets`. `spectrum` is the eigendecomposition of the features.
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

    /// Factors λ / (σ² + λ) for every eigenvalue σ² (row) and penalty λ (column).
    fn shrinkage(&self, penalties: &[f64]) -> Mat<f64> {
        Mat::from_fn(self.eigenvalues.len(), penalties.len(), |row, column| {
            penalties[column] / (self.eigenvalues[row] + penalties[column])
        })
    }

    /// Rows of R × targets for the samples `positions`, with R of [`LeaveOut`]. `vectors` contains the same rows of the eigenvectors.
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
