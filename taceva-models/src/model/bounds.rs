//! Clamps predictions to the range of the training labels and a quarter of it on either side.

use taceva_core::Targets;

use super::Model;
use super::card::MARGIN;
use crate::training::label_scaling::LabelScaling;

/// Where predictions of each channel may lie, by the labels of the training part.
///
/// A quarter of the range of the labels is allowed on either side: for lighting or depths outside those of the training part a model may be
/// wrong, but not by many times the range that it was fitted on. A label that never changes is its own bound.
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
    /// Whether there was more than one label.
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
    /// The bounds of `channels` of which nothing is known.
    pub fn unknown(channels: usize) -> LabelBounds {
        LabelBounds(vec![None; channels])
    }

    /// The bounds of a model that has learnt `labels`, at least one of each channel.
    pub fn of_labels(labels: Targets<'_>) -> LabelBounds {
        let scaling = LabelScaling::of(labels);
        let ranges = scaling.minimum().iter().zip(scaling.span()).enumerate();
        let bounds = ranges.map(|(position, (minimum, span))| {
            let varies = !scaling.is_constant(position);
            Some(ChannelBounds::new(*minimum, *span, varies, MARGIN))
        });
        LabelBounds(bounds.collect())
    }

    /// The least and the greatest prediction of the channel at `position`, in its unit; `None` where nothing is known.
    pub fn of(&self, position: usize) -> Option<[f64; 2]> {
        self.0[position].map(|bounds| [bounds.least, bounds.greatest])
    }

    /// Whether `prediction`, as the model gives it, lies beyond the bounds of the channel at `position`; `None` where there are none.
    ///
    /// A label that never changes bounds nothing that was learnt: no prediction of it counts as beyond.
    pub fn is_beyond(&self, position: usize, prediction: f64) -> Option<bool> {
        let bounds = self.0[position]?;
        Some(bounds.varies && !(bounds.least..=bounds.greatest).contains(&prediction))
    }

    /// Brings `predictions`, a row a sample, within their bounds.
    ///
    /// # Shapes
    /// `[samples, channels]`.
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
    /// The bounds of its predictions; an angle with a period has none.
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
