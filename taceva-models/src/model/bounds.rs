//! Clamps predictions to the range of the training labels and a quarter of it on either side.

use super::Model;

impl Model {
    /// The least and the greatest prediction of the channel at `position`, in its unit; `None` for a model file written before bounds were stored.
    ///
    /// A quarter of the range of the labels of the training part is allowed on either side: for lighting or depths
    /// outside those of the training part a model may be wrong, but not by many times the range that it was fitted on. A label that never changes is its own bound.
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

    /// Whether `prediction`, as the model gives it, lies beyond the bounds of the channel at `position`; `None` where there are none.
    ///
    /// A label that never changes bounds nothing that was learnt: no prediction of it counts as beyond.
    pub fn is_beyond(&self, position: usize, prediction: f64) -> Option<bool> {
        let [least, greatest] = self.bounds(position)?;
        let varies = !self.card.channels[position].constant_label;
        Some(varies && !(least..=greatest).contains(&prediction))
    }

    /// Brings `predictions`, a row a sample, within their bounds.
    ///
    /// # Shapes
    /// `[samples, channels]`.
    pub fn bound(&self, predictions: &mut [f64]) {
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
