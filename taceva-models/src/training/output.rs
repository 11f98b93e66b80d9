//! Checks of shapes and finiteness for predictions, and conversion of scaled predictions to the units of their channels.

use taceva_core::{Channels, ErrorKind, FeatureShape, Features, ModelError};

use crate::linalg::invalid;
use crate::training::problem::Problem;

/// Returns an error if the features have the wrong shape, or if the prediction buffer `into` has the wrong length.
pub(crate) fn check_call(
    channels: &Channels,
    shape: FeatureShape,
    features: &Features,
    into: &[f64],
) -> Result<(), ModelError> {
    if features.shape() != shape {
        return Err(invalid(format!(
            "features of shape {}, expected {shape}",
            features.shape()
        )));
    }
    let channels = channels.len();
    if into.len() != features.samples() * channels {
        return Err(invalid(format!(
            "a buffer of {} values, expected {} samples × {channels} channels",
            into.len(),
            features.samples()
        )));
    }
    Ok(())
}

/// Returns an error for the first prediction that is not finite.
pub(crate) fn check_finite(channels: &Channels, predictions: &[f64]) -> Result<(), ModelError> {
    match predictions.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(position) => Err(ModelError::new(
            ErrorKind::OutOfRange,
            format!(
                "sample {}: the prediction of `{}` is not finite",
                position / channels.len(),
                channels.as_slice()[position % channels.len()]
            ),
        )),
    }
}

/// Offset and span of each channel, which convert a scaled and centred label y to the unit of the channel: offset + span · y.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OutputScale {
    pub(crate) offset: Vec<f64>,
    pub(crate) span: Vec<f64>,
}

impl OutputScale {
    /// Adapts the offsets to labels from which the additional mean `shift` was subtracted, one value per channel.
    pub(crate) fn moved(mut self, shift: &[f64]) -> OutputScale {
        let moved = self.span.iter().zip(shift);
        let places = self.offset.iter_mut().zip(moved);
        places.for_each(|(offset, (span, shift))| *offset += span * shift);
        self
    }

    /// Offsets and spans that undo the scaling and centring of the labels of `problem`.
    pub(crate) fn of(problem: &Problem<'_>) -> OutputScale {
        let span = problem.scaling.span().to_vec();
        let minimum = problem.scaling.minimum().iter();
        let mean = span.iter().zip(&problem.mean);
        OutputScale {
            offset: minimum
                .zip(mean)
                .map(|(minimum, (span, mean))| minimum + span * mean)
                .collect(),
            span,
        }
    }

    /// True if all offsets and spans are finite, and their numbers equal `channels`.
    pub(crate) fn is_valid(&self, channels: usize) -> bool {
        let mut numbers = self.offset.iter().chain(&self.span);
        [self.offset.len(), self.span.len()] == [channels; 2]
            && numbers.all(|value| value.is_finite())
    }

    /// Converts the scaled and centred predictions of one sample to the units of the channels, in place.
    pub(crate) fn unscale(&self, sample: &mut [f64]) {
        let own = self.offset.iter().zip(&self.span);
        for (place, (offset, span)) in sample.iter_mut().zip(own) {
            *place = offset + span * *place;
        }
    }
}
