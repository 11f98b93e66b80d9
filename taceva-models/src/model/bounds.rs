//! Bounds of predictions: the range of the training labels, extended by a quarter of the range on either side.

use taceva_core::Targets;

use super::Model;
use super::card::MARGIN;
use crate::training::label_scaling::LabelScaling;

/// Bounds of predictions for each channel, computed from the training labels.
///
/// The bounds limit errors of a model for lighting or depths outside the training part. They include a quarter of the label range on either side. A constant
/// label is its own lower and upper bound.
///
/// ```
/// use taceva_core::{Channel, Channels, Targets};
/// use taceva_models::LabelBounds;
/// let channels = Channels::new([Channel::FZ])?;
/// let bounds = LabelBounds::of_labels(Targets::new(&channels, &[1.0, 2.0, 3.0]));
/// let mut predictions = [4.0, 2.5];
/// bounds.bound(&mut predictions);
/// assert_eq!((predictions, bounds.is_beyond(0, 4.0)), ([3.5, 2.5], Some(true)));
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct LabelBounds(Vec<Option<ChannelBounds>>);

#[derive(Clone, Copy, Debug)]
struct ChannelBounds {
    least: f64,
    greatest: f64,
    /// True if the training labels of the channel vary.
    varies: bool,
}

impl ChannelBounds {
    fn new(minimum: f64, span: f64, varies: bool, margin: f64) -> ChannelBounds {
        let (span, beyond) = match varies {
            true => (span, margin * span),
            false => (0.0, 0.0),
        };
        ChannelBounds {
            least: minimum - beyond,
            greatest: minimum + span + beyond,
            varies,
        }
    }
}

impl LabelBounds {
    /// Unknown bounds for `channels` channels.
    pub fn unknown(channels: usize) -> LabelBounds {
        LabelBounds(vec![None; channels])
    }

    /// Bounds from the training `labels`. There must be at least one label per channel.
    pub fn of_labels(labels: Targets<'_>) -> LabelBounds {
        let scaling = LabelScaling::of(labels);
        let ranges = scaling.minimum().iter().zip(scaling.span()).enumerate();
        let bounds = ranges.map(|(position, (minimum, span))| {
            let varies = !scaling.is_constant(position);
            Some(ChannelBounds::new(*minimum, *span, varies, MARGIN))
        });
        LabelBounds(bounds.collect())
    }

    /// Lower and upper bound of predictions of the channel with index `position`, in the unit of the channel; `None` if unknown.
    pub fn of(&self, position: usize) -> Option<[f64; 2]> {
        self.0[position].map(|bounds| [bounds.least, bounds.greatest])
    }

    /// True if the unclipped `prediction` is outside the bounds of the channel with index `position`; `None` if the bounds are unknown.
    ///
    /// Always false for a constant label.
    pub fn is_beyond(&self, position: usize, prediction: f64) -> Option<bool> {
        let bounds = self.0[position]?;
        Some(bounds.varies && !(bounds.least..=bounds.greatest).contains(&prediction))
    }

    /// Clips `predictions`, one row per sample, to the bounds of each channel.
    ///
    /// # Shapes
    /// `predictions`: `[samples, channels]`.
    pub fn bound(&self, predictions: &mut [f64]) {
        let channels = self.0.len();
        for (position, bounds) in self.0.iter().enumerate() {
            let Some(bounds) = bounds else { continue };
            for place in predictions.iter_mut().skip(position).step_by(channels) {
                *place = place.clamp(bounds.least, bounds.greatest);
            }
        }
    }
}

impl Model {
    /// Bounds of predictions. The bounds of angles with a period are unknown.
    pub fn label_bounds(&self) -> LabelBounds {
        let bounds = self.channels.as_they_are().map(|position| {
            let channel = &self.card.channels[position?];
            let varies = !channel.constant_label;
            Some(ChannelBounds::new(
                channel.minimum,
                channel.span,
                varies,
                self.card.margin,
            ))
        });
        LabelBounds(bounds.collect())
    }
}
