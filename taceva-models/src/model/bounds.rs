//! How far predictions may go: what was never seen is not extrapolated wildly.

use super::Model;

/// How far beyond the labels of the training part predictions may go, as a share of their range.
pub(super) const MARGIN: f64 = 0.25;

impl Model {
    /// The least and the greatest prediction of the channel at `position`, in its unit; `None` for a model of a time before bounds.
    ///
    /// A quarter of the range of the labels of the training part is allowed on either side: under new light or beyond the depths that
    /// were taught, a model may be wrong, but not by many times what the sensor can feel. A label that never changes is its own bound.
    pub fn bounds(&self, position: usize) -> Option<[f64; 2]> {
        let channel = &self.card.channels[position];
        let margin = self.card.margin?;
        if channel.constant_label {
            return Some([channel.minimum; 2]);
        }
        let beyond = margin * channel.span;
        Some([
            channel.minimum - beyond,
            channel.minimum + channel.span + beyond,
        ])
    }

    /// How many of `predictions`, a row a sample, lie on a bound, channel by channel: those that would lie beyond it.
    pub fn bounded(&self, predictions: &[f64]) -> Vec<usize> {
        let channels = self.channels().len();
        let of = |position: usize| {
            let bounds = self.bounds(position)?;
            if self.card.channels[position].constant_label {
                return None;
            }
            let own = predictions.iter().skip(position).step_by(channels);
            let is_bound = |value: &&f64| {
                bounds
                    .iter()
                    .any(|bound| bound.to_bits() == value.to_bits())
            };
            Some(own.filter(is_bound).count())
        };
        (0..channels)
            .map(|position| of(position).unwrap_or(0))
            .collect()
    }

    /// Brings `predictions`, a row a sample, within their bounds.
    pub(super) fn bound(&self, predictions: &mut [f64]) {
        let channels = self.channels().len();
        for position in 0..channels {
            let Some([least, greatest]) = self.bounds(position) else {
                continue;
            };
            for place in predictions.iter_mut().skip(position).step_by(channels) {
                *place = place.clamp(least, greatest);
            }
        }
    }
}
