//! Scaling of labels to the range from 0 to 1, and back to their units.

use faer::Mat;
use taceva_core::Targets;

/// Minimum and span (maximum − minimum) of the training labels of each channel.
///
/// Models learn (label − minimum) / span. Predictions are converted back to the unit of the channel. If all labels of a channel are equal, the span
/// is set to 1, and the channel is [marked as constant](LabelScaling::is_constant).
#[derive(Clone, Debug, PartialEq)]
pub struct LabelScaling {
    minimum: Vec<f64>,
    span: Vec<f64>,
    constant: Vec<bool>,
}

impl LabelScaling {
    /// Label ranges of `targets`, which must not be empty.
    pub(crate) fn of(targets: Targets<'_>) -> LabelScaling {
        let channels = targets.channels.len();
        let column = |channel: usize| {
            let values = targets.values.iter().skip(channel);
            values.step_by(channels.max(1)).copied()
        };
        let extreme = |of: fn(f64, f64) -> f64, from| {
            (0..channels).map(move |channel| column(channel).fold(from, of))
        };
        let minimum: Vec<f64> = extreme(f64::min, f64::INFINITY).collect();
        let spans = extreme(f64::max, f64::NEG_INFINITY).zip(&minimum);
        let span: Vec<f64> = spans.map(|(maximum, minimum)| maximum - minimum).collect();
        let constant: Vec<bool> = span.iter().map(|&span| span <= 0.0).collect();
        LabelScaling {
            span: span
                .iter()
                .map(|&span| if span > 0.0 { span } else { 1.0 })
                .collect(),
            minimum,
            constant,
        }
    }

    /// Least label of each channel, in the unit of the channel.
    pub fn minimum(&self) -> &[f64] {
        &self.minimum
    }

    /// Maximum minus minimum label of each channel, in the unit of the channel; 1 if all labels are equal.
    pub fn span(&self) -> &[f64] {
        &self.span
    }

    /// True if all training labels of the channel with index `position` are equal.
    pub fn is_constant(&self, position: usize) -> bool {
        self.constant[position]
    }

    /// Labels minus the minimum of their channel, divided by its span. Shape `[samples, channels]`.
    pub(crate) fn scaled(&self, targets: Targets<'_>) -> Mat<f64> {
        let channels = self.span.len();
        let samples = targets.values.len() / channels.max(1);
        Mat::from_fn(samples, channels, |sample, channel| {
            let value = targets.values[sample * channels + channel];
            (value - self.minimum[channel]) / self.span[channel]
        })
    }
}

/// Mean label of each channel over the samples, in the unit of the channel. This is the best constant prediction. `targets` must not be empty.
pub fn label_means(targets: Targets<'_>) -> Vec<f64> {
    let channels = targets.channels.len();
    let mean = |channel: usize| {
        let own = || targets.values.iter().skip(channel).step_by(channels.max(1));
        let (sum, count) = own().fold((0.0, 0.0), |(sum, count), label| (sum + label, count + 1.0));
        // Limits the rounded mean to the label range. For equal labels, the mean is their value.
        let least = own().copied().fold(f64::INFINITY, f64::min);
        let greatest = own().copied().fold(f64::NEG_INFINITY, f64::max);
        (sum / count).max(least).min(greatest)
    };
    (0..channels).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{Channel, Channels};

    #[test]
    fn labels_map_to_zero_to_one_and_constant_ones_to_zero() {
        let channels = Channels::new([Channel::FX, Channel::FZ]).expect("distinct");
        let targets = Targets::new(&channels, &[-1.0, 5.0, 3.0, 5.0, 0.0, 5.0]);
        let scaling = LabelScaling::of(targets);
        assert_eq!(scaling.span(), [4.0, 1.0]);
        assert!(!scaling.is_constant(0) && scaling.is_constant(1));
        let scaled = scaling.scaled(targets);
        assert_eq!(scaled.col_as_slice(0), [0.0, 1.0, 0.25]);
        assert_eq!(scaled.col_as_slice(1), [0.0, 0.0, 0.0]);
    }
}
