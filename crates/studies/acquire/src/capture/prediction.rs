//! Prediction of a frame.

use taceva_models::FeatureDistance;

/// Prediction for one frame.
///
/// ```
/// use taceva_acquire::Prediction;
///
/// let prediction = Prediction::new(12.5, vec![1.25]).with_distance(1.7);
/// assert_eq!(prediction.is_outside(), Some(true));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Prediction {
    /// Time stamp of the frame, in s, on the clock of frame stamps.
    pub stamp_s: f64,
    /// Value of each channel of the model, in the unit of the channel.
    pub values: Vec<f64>,
    /// Distance of the frame from the training data; above 1, the frame is outside these data. `None` if the model does not compute it.
    pub distance: Option<f64>,
}

impl Prediction {
    /// Creates a prediction for a frame with the time stamp `stamp_s`, in s, without a distance.
    pub fn new(stamp_s: f64, values: Vec<f64>) -> Prediction {
        Prediction {
            stamp_s,
            values,
            distance: None,
        }
    }

    /// Sets the distance of the frame from the training data.
    #[must_use]
    pub fn with_distance(self, distance: f64) -> Prediction {
        Prediction {
            distance: Some(distance),
            ..self
        }
    }

    /// True if the frame is outside the training data; `None` if the model does not compute the distance.
    pub fn is_outside(&self) -> Option<bool> {
        self.distance.map(FeatureDistance::is_outside)
    }
}
