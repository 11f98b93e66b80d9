//! The spectrum of a design matrix, from the smaller of its two Gram matrices.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::{Mat, MatRef, Par};
use taceva_core::{ErrorKind, ModelError, Progress};

use super::design::Design;
use super::gram::{Side, gram, multiply};
use crate::linalg::progress::{ReportedStage, interrupted};

/// Eigenvalues in ascending order and their vectors, of a symmetric matrix whose lower triangle is `matrix`.
///
/// # Errors
/// [`ErrorKind::Internal`] if the iteration does not end, which finite numbers do not cause.
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

/// X = U Σ Vᵀ, of which one Gram matrix gives Σ² and either U or V.
#[derive(Debug)]
pub(crate) struct Spectrum<'d, 'a> {
    design: &'d Design<'a>,
    side: Side,
    /// Σ², ascending, never below 0.
    eigenvalues: Vec<f64>,
    /// U or V.
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
        // Rounding may carry a zero below zero.
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

    /// The mean of the eigenvalues: the unit in which strengths are given.
    pub(crate) fn mean_eigenvalue(&self) -> f64 {
        self.eigenvalues.iter().sum::<f64>() / self.eigenvalues.len() as f64
    }

    /// What rounding makes of an eigenvalue of 0: smaller eigenvalues are noise.
    pub(crate) fn noise(&self) -> f64 {
        let largest = self.eigenvalues.last().copied().unwrap_or(0.0);
        largest * self.eigenvalues.len() as f64 * f64::EPSILON
    }

    /// Whether the [sample vectors](Spectrum::sample_vectors) span all vectors of a number for each sample.
    pub(crate) fn spans_samples(&self) -> bool {
        self.side == Side::Samples
    }

    /// `targets` (a row a sample) in the basis of the vectors, ready for [`weights`](Spectrum::weights).
    pub(crate) fn rotate(&self, targets: MatRef<'_, f64>) -> Mat<f64> {
        match self.side {
            Side::Samples => multiply(self.vectors.transpose(), targets),
            Side::Features => {
                let products = self.design.transpose_times(targets);
                multiply(self.vectors.transpose(), products.as_ref())
            }
        }
    }

    /// The weights of features, a column each of `coefficients`: those of ridge regression with λ, if a coefficient is
    /// the rotated target over (eigenvalue + λ).
    pub(crate) fn weights(&self, coefficients: MatRef<'_, f64>) -> Mat<f64> {
        let combined = multiply(self.vectors.as_ref(), coefficients);
        match self.side {
            Side::Samples => self.design.transpose_times(combined.as_ref()),
            Side::Features => combined,
        }
    }

    /// U: a row a sample, a column an eigenvalue; zero where the eigenvalue is [`noise`](Spectrum::noise).
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

    /// The last `count` columns of V, largest eigenvalue first.
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
