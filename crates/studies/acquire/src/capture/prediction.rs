//! The prediction of a frame.

use taceva_models::FeatureDistance;

/// The prediction of one frame, which is no measurement.
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
    /// When the frame was true that it is of, in s of the clock that stamps frames: not when it was made.
    pub stamp_s: f64,
    /// The value of each channel of the model, in the unit of the channel.
    pub values: Vec<f64>,
    /// Distance of the frame from what the model has seen, 1 at the limit; `None` where the model does not know.
    pub distance: Option<f64>,
}

impl Prediction {
    /// The prediction of a frame that was true at `stamp_s`, in s, without a distance.
    pub fn new(stamp_s: f64, values: Vec<f64>) -> Prediction {
        Prediction {
            stamp_s,
            values,
            distance: None,
        }
    }

    /// The same of a frame that lies so far from what the model has seen.
    #[must_use]
    pub fn with_distance(self, distance: f64) -> Prediction {
        Prediction {
            distance: Some(distance),
            ..self
        }
    }

    /// True if the frame lies outside what the model has seen; `None` where the model does not know.
    pub fn is_outside(&self) -> Option<bool> {
        self.distance.map(FeatureDistance::is_outside)
    }
}
