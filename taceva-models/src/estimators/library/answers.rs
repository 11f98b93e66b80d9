//! Fitted library models and their predictions.

use faer::Mat;
use taceva_core::{ErrorKind, Features, ModelError};

use super::task::LibraryPredictor;
use crate::linalg::standard::Standard;

/// Library model that was fitted to a selection of samples.
pub(super) struct Fitted {
    /// Standardisation applied to all features.
    pub(super) standard: Standard,
    /// Indices of the features passed to the predictor, ascending.
    pub(super) kept: Vec<usize>,
    /// Indices of the channels that the predictor predicts, ascending.
    pub(super) live: Vec<usize>,
    /// Constant of each channel, added to its predictions. Channels that are not in `live` are predicted by this constant alone.
    pub(super) base: Vec<f64>,
    /// Predictor of the library; `None` if no feature or no label varies.
    pub(super) predictor: Option<Box<dyn LibraryPredictor>>,
}

impl Fitted {
    /// Predicts every sample of `features`, one row per sample, in the scale of the labels that the model was fitted to.
    pub(super) fn predict(&self, features: &Features) -> Result<Mat<f64>, ModelError> {
        let mut found = Mat::from_fn(features.samples(), self.base.len(), |_, channel| {
            self.base[channel]
        });
        let Some(predictor) = &self.predictor else {
            return Ok(found);
        };
        let mut own = vec![0.0; features.shape().len()];
        let mut answers = vec![0.0; self.live.len()];
        for sample in 0..features.samples() {
            self.standard.write(features.sample(sample), &mut own);
            let seen: Vec<f32> = self.kept.iter().map(|&feature| own[feature]).collect();
            predictor.predict(&seen, &mut answers)?;
            for (&channel, answer) in self.live.iter().zip(&answers) {
                found[(sample, channel)] += answer;
            }
        }
        if (0..found.ncols()).all(|channel| {
            let column = found.col_as_slice(channel);
            column.iter().all(|value| value.is_finite())
        }) {
            Ok(found)
        } else {
            Err(ModelError::new(
                ErrorKind::OutOfRange,
                "a prediction of the library is not finite",
            ))
        }
    }
}
