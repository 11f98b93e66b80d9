//! SIMPLS algorithm for the directions of partial least squares. It multiplies vectors with the features, and needs no Gram matrix and no deflated
//! copy.

use faer::{Mat, MatRef};
use taceva_core::{ModelError, Progress};

use crate::linalg::progress::{ReportedStage, interrupted};
use crate::linalg::{Design, multiply, symmetric_eigen};

/// Smallest norm of a remainder, relative to its norm before subtraction. A smaller remainder is rounding noise, and the search ends.
const NOISE: f64 = 1e-10;

/// Directions in feature space. The scores, which are the projections of the samples, are orthonormal over directions.
#[derive(Debug)]
pub(super) struct Directions {
    /// Weight of each feature (row) in each direction (column).
    weights: Mat<f64>,
    /// Change of each channel's label per unit of score. One row per direction, one column per channel.
    loadings: Vec<Vec<f64>>,
}

impl Directions {
    /// Finds up to `count` directions of the features `design` that predict the centred labels `targets`. The search ends early if the labels are
    /// fully explained.
    pub(super) fn find(
        design: &Design<'_>,
        targets: &Mat<f64>,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<Directions, ModelError> {
        let most = count.min(design.width()).min(design.samples() - 1);
        let stage = ReportedStage::begin(progress, "directions", most);
        let mut covariance = design.transpose_times(targets.as_ref());
        let start = covariance.norm_l2();
        let mut weights: Vec<Mat<f64>> = Vec::new();
        let mut loadings = Vec::new();
        let mut basis: Vec<Mat<f64>> = Vec::new();
        while weights.len() < most && covariance.norm_l2() > start * NOISE {
            interrupted(progress)?;
            let mut weight = multiply(covariance.as_ref(), dominant(&covariance)?.as_ref());
            let mut score = design.times(weight.as_ref());
            let norm = score.norm_l2();
            if norm <= f64::MIN_POSITIVE {
                break;
            }
            divide(&mut weight, norm);
            divide(&mut score, norm);
            loadings.push(
                multiply(targets.transpose(), score.as_ref())
                    .col_as_slice(0)
                    .to_vec(),
            );
            let mut loading = design.transpose_times(score.as_ref());
            let length = loading.norm_l2();
            // Orthogonalises twice, because one pass leaves rounding errors.
            for _ in 0..2 {
                basis
                    .iter()
                    .for_each(|earlier| remove(&mut loading, earlier));
            }
            let rest = loading.norm_l2();
            weights.push(weight);
            stage.advance();
            if rest <= length * NOISE {
                break;
            }
            divide(&mut loading, rest);
            remove(&mut covariance, &loading);
            basis.push(loading);
        }
        Ok(Directions {
            weights: Mat::from_fn(design.width(), weights.len(), |row, column| {
                weights[column][(row, 0)]
            }),
            loadings,
        })
    }

    /// Number of directions.
    pub(super) fn count(&self) -> usize {
        self.loadings.len()
    }

    pub(super) fn weights(&self) -> MatRef<'_, f64> {
        self.weights.as_ref()
    }

    pub(super) fn loading(&self, direction: usize, channel: usize) -> f64 {
        self.loadings[direction][channel]
    }

    /// Weights of the features for prediction, one column per channel. Column c uses the first `counts[c]` directions.
    pub(super) fn solution(&self, counts: &[usize]) -> Mat<f64> {
        let coefficients = Mat::from_fn(self.count(), counts.len(), |direction, channel| {
            if direction < counts[channel] {
                self.loading(direction, channel)
            } else {
                0.0
            }
        });
        multiply(self.weights(), coefficients.as_ref())
    }
}

/// Coefficients of the linear combination of channels that has the greatest covariance with the features. Shape: `[channels, 1]`.
fn dominant(covariance: &Mat<f64>) -> Result<Mat<f64>, ModelError> {
    let square = multiply(covariance.transpose(), covariance.as_ref());
    let (_, vectors) = symmetric_eigen(square.as_ref())?;
    let last = vectors.ncols() - 1;
    Ok(Mat::from_fn(vectors.nrows(), 1, |row, _| {
        vectors[(row, last)]
    }))
}

fn divide(vector: &mut Mat<f64>, by: f64) {
    vector
        .col_as_slice_mut(0)
        .iter_mut()
        .for_each(|value| *value /= by);
}

/// Subtracts the component along the unit vector `direction` from every column.
fn remove(columns: &mut Mat<f64>, direction: &Mat<f64>) {
    let along = multiply(direction.transpose(), columns.as_ref());
    for column in 0..columns.ncols() {
        let along = along[(0, column)];
        columns
            .col_as_slice_mut(column)
            .iter_mut()
            .zip(direction.col_as_slice(0))
            .for_each(|(value, direction)| *value -= along * direction);
    }
}
