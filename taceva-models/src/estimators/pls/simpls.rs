//! The directions of SIMPLS, by products with the features alone: neither a Gram matrix nor a deflated copy is stored.

use faer::{Mat, MatRef};
use taceva_core::{ModelError, Progress};

use crate::linalg::progress::{ReportedStage, interrupted};
use crate::linalg::{Design, multiply, symmetric_eigen};

/// A part of the features' norm below which a direction is rounding, not data.
const NOISE: f64 = 1e-10;

/// Directions in feature space with orthonormal scores, and how each channel follows each of them.
#[derive(Debug)]
pub(super) struct Directions {
    /// A column a direction.
    weights: Mat<f64>,
    /// A row a direction, a column a channel.
    loadings: Vec<Vec<f64>>,
}

impl Directions {
    /// At most `count` directions of `design` for centred `targets`; fewer where the labels are explained before.
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
            // Twice, because one pass leaves rounding of the parts it took away.
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

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.loadings.len()
    }

    pub(super) fn weights(&self) -> MatRef<'_, f64> {
        self.weights.as_ref()
    }

    pub(super) fn loading(&self, direction: usize, channel: usize) -> f64 {
        self.loadings[direction][channel]
    }

    /// The weights of features where each channel uses the first of `counts` directions, a column a channel.
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

/// The combination of channels with which the features go best.
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

/// Takes the part along the unit vector `direction` out of every column.
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
