//! Spectrum of a design matrix, computed from the smaller of its two Gram matrices.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::{Mat, MatRef, Par};
use taceva_core::{ErrorKind, ModelError, Progress};

use super::design::Design;
use super::gram::{Side, gram, multiply};
use crate::linalg::progress::{ReportedStage, interrupted};

/// Eigenvalues, ascending, and eigenvectors of a symmetric matrix. Only the lower triangle of `matrix` is read.
///
/// # Errors
/// [`ErrorKind::Internal`] if the iteration does not converge. Finite numbers never cause this error.
pub(crate) fn symmetric_eigen(matrix: MatRef<'_, f64>) -> Result<(Vec<f64>, Mat<f64>), ModelError> {
    let size = matrix.nrows();
    let mut vectors = Mat::zeros(size, size);
    let mut values = Diag::zeros(size);
    let scratch = self_adjoint_evd_scratch::<f64>(
        size,
        ComputeEigenvectors::Yes,
        Par::Seq,
        Default::default(),
    );
    self_adjoint_evd(
        matrix,
        values.as_mut(),
        Some(vectors.as_mut()),
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Default::default(),
    )
    .map_err(|error| {
        let message = format!("cannot decompose a matrix of {size} rows: {error:?}");
        ModelError::new(ErrorKind::Internal, message)
    })?;
    let values = values.column_vector().iter().copied().collect();
    Ok((values, vectors))
}

/// Singular value decomposition X = U Σ Vᵀ of a design matrix X. One Gram matrix gives Σ² and either U or V.
#[derive(Debug)]
pub(crate) struct Spectrum<'d, 'a> {
    design: &'d Design<'a>,
    side: Side,
    /// Eigenvalues Σ², ascending, at least 0.
    eigenvalues: Vec<f64>,
    /// Eigenvectors: U for the Gram matrix of samples, V for the Gram matrix of features.
    vectors: Mat<f64>,
}

impl<'d, 'a> Spectrum<'d, 'a> {
    pub(crate) fn new(
        design: &'d Design<'a>,
        progress: &dyn Progress,
    ) -> Result<Spectrum<'d, 'a>, ModelError> {
        let side = if design.samples() <= design.width() {
            Side::Samples
        } else {
            Side::Features
        };
        let gram = gram(design, side, progress)?;
        let _stage = ReportedStage::begin(progress, "spectrum of features", 1);
        let (mut eigenvalues, vectors) = symmetric_eigen(gram.as_ref())?;
        interrupted(progress)?;
        // Rounding may make a zero negative.
        eigenvalues
            .iter_mut()
            .for_each(|value| *value = value.max(0.0));
        Ok(Spectrum {
            design,
            side,
            eigenvalues,
            vectors,
        })
    }

    pub(crate) fn eigenvalues(&self) -> &[f64] {
        &self.eigenvalues
    }

    /// Mean eigenvalue. The penalty of a ridge regression is its strength times this value.
    pub(crate) fn mean_eigenvalue(&self) -> f64 {
        self.eigenvalues.iter().sum::<f64>() / self.eigenvalues.len() as f64
    }

    /// Rounding error of an eigenvalue of 0. Eigenvalues below this error contain only noise.
    pub(crate) fn noise(&self) -> f64 {
        let largest = self.eigenvalues.last().copied().unwrap_or(0.0);
        largest * self.eigenvalues.len() as f64 * f64::EPSILON
    }

    /// True if the [sample vectors](Spectrum::sample_vectors) span the whole space of samples.
    pub(crate) fn spans_samples(&self) -> bool {
        self.side == Side::Samples
    }

    /// Projects `targets`, one row per sample, onto the eigenvectors. [`weights`](Spectrum::weights) takes multiples of these projections.
    pub(crate) fn rotate(&self, targets: MatRef<'_, f64>) -> Mat<f64> {
        match self.side {
            Side::Samples => multiply(self.vectors.transpose(), targets),
            Side::Features => {
                let products = self.design.transpose_times(targets);
                multiply(self.vectors.transpose(), products.as_ref())
            }
        }
    }

    /// Feature weights for each column of `coefficients`. Coefficients of projection / (eigenvalue + λ) give ridge regression with penalty λ.
    /// [`rotate`](Spectrum::rotate) computes the projections.
    pub(crate) fn weights(&self, coefficients: MatRef<'_, f64>) -> Mat<f64> {
        let combined = multiply(self.vectors.as_ref(), coefficients);
        match self.side {
            Side::Samples => self.design.transpose_times(combined.as_ref()),
            Side::Features => combined,
        }
    }

    /// Left singular vectors, with one row per sample and one column per eigenvalue. Columns for eigenvalues within [`noise`](Spectrum::noise) are
    /// zero, unless the vectors [span the samples](Spectrum::spans_samples).
    pub(crate) fn sample_vectors(&self) -> Mat<f64> {
        match self.side {
            Side::Samples => self.vectors.clone(),
            Side::Features => {
                let mut vectors = self.design.times(self.vectors.as_ref());
                for (column, &eigenvalue) in self.eigenvalues.iter().enumerate() {
                    let inverse = self.inverse_root(eigenvalue);
                    vectors
                        .col_as_slice_mut(column)
                        .iter_mut()
                        .for_each(|value| *value *= inverse);
                }
                vectors
            }
        }
    }

    /// Right singular vectors of the design matrix for the `count` largest eigenvalues, the largest first.
    pub(crate) fn leading_feature_vectors(&self, count: usize) -> Mat<f64> {
        let size = self.eigenvalues.len();
        let leading = Mat::from_fn(size, count, |row, column| {
            let source = size - 1 - column;
            match self.side {
                Side::Samples => {
                    self.vectors[(row, source)] * self.inverse_root(self.eigenvalues[source])
                }
                Side::Features => self.vectors[(row, source)],
            }
        });
        match self.side {
            Side::Samples => self.design.transpose_times(leading.as_ref()),
            Side::Features => leading,
        }
    }

    fn inverse_root(&self, eigenvalue: f64) -> f64 {
        if eigenvalue > self.noise() {
            1.0 / eigenvalue.sqrt()
        } else {
            0.0
        }
    }
}
