//! What a library made of some rows, and what it answers.

use faer::Mat;
use taceva_core::{ErrorKind, Features, ModelError};

use super::task::LibraryPredictor;
use crate::linalg::standard::Standard;

/// What a library made of some rows.
pub(super) struct Fitted {
    /// Of all features.
    pub(super) standard: Standard,
    /// The features that the predictor is asked with, ascending.
    pub(super) kept: Vec<usize>,
    /// The channels that it answers for, ascending.
    pub(super) live: Vec<usize>,
    /// What is added to its answers; for a channel that it does not answer for, the answer.
    pub(super) base: Vec<f64>,
    /// Absent where no feature or no label varies.
    pub(super) predictor: Option<Box<dyn LibraryPredictor>>,
}

impl Fitted {
    /// The answers for every sample of `features`, in the labels that were learnt from, a row a sample.
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
