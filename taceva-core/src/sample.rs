//! One sample: readings taken together. A live rig and a recording push the same samples.

mod with;

use crate::channel::Channels;
use crate::frame::Frame;
use crate::geometry::Pose;
use crate::grating::GratingKind;
use crate::nanometre::Nanometre;
use crate::outcome::Limit;
use crate::phase::Phase;
use crate::signals::Signals;
use crate::stamp::Stamp;
use crate::wrench::Wrench;

/// One sample. Absent values are `None`, never a placeholder number.
///
/// ```
/// use taceva_core::{Readings, Sample};
/// let sample = Sample::new("press 1")
///     .with_truth(Readings::from_values([1.0, 0.5]))
///     .with_prediction(Readings::from_values([1.1, 0.48]))
///     .with_repeat(2);
/// assert_eq!(sample.truth.get(1), Some(0.5));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// Name within the recording.
    pub id: String,
    /// Sensor model.
    pub sensor_id: Option<String>,
    /// Individual unit of the sensor model.
    pub unit_id: Option<String>,
    /// Lighting scene, or another condition of the recording.
    pub scene_id: Option<String>,
    /// Contact point, shared by its repeats. Confidence intervals cluster samples by this point.
    pub point_id: Option<String>,
    /// Depth level within the contact point.
    pub depth_step: Option<u32>,
    /// Number of the repeat.
    pub repeat: Option<u32>,
    /// Branch of the press: load or unload.
    pub phase: Option<Phase>,
    /// Limit of the gel that kept the tip from its target. Labels and picture then belong to the place that the tip reached.
    pub limited_by: Option<Limit>,
    /// Standard uncertainty of the zero height of the depth `Pz`, mm. `None` if the zero height is not fitted.
    pub zero_u_mm: Option<f64>,
    /// Time of the observation.
    pub stamp: Option<Stamp>,
    /// Relief of the touched grating.
    pub kind: Option<GratingKind>,
    /// Spacing of the touched grating.
    pub spacing: Option<Nanometre>,
    /// Spacing that a model predicts.
    pub predicted_spacing: Option<Nanometre>,
    /// Mean luma of the full-size picture, (299 R + 587 G + 114 B) / 1000, on the 8-bit scale from 0 to 255.
    pub intensity: Option<f64>,
    /// SHA-256 of the picture's bytes, `sha256:` and 64 hexadecimal digits. Equal digests show equal pictures without decoding.
    pub frame_digest: Option<String>,
    /// Decoded picture.
    pub frame: Option<Frame>,
    /// Numbers of the sensor's taxels.
    pub signals: Option<Signals>,
    /// Readings of the reference instruments, one value per channel of the stream.
    pub truth: Readings,
    /// Predictions of a model, one value per channel of the stream.
    pub prediction: Option<Readings>,
}

/// One value per channel of the stream, in the order of its [`Channels`]. Absent values are `None`.
///
/// ```
/// use taceva_core::Readings;
/// let readings = Readings::new(vec![Some(0.5), None]);
/// assert_eq!((readings.get(0), readings.get(1)), (Some(0.5), None));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readings {
    values: Vec<Option<f64>>,
}

impl Readings {
    /// Readings with the given values. Absent values are `None`.
    pub fn new(values: Vec<Option<f64>>) -> Readings {
        Readings { values }
    }

    /// Readings with a value for each channel.
    pub fn from_values(values: impl IntoIterator<Item = f64>) -> Readings {
        Readings {
            values: values.into_iter().map(Some).collect(),
        }
    }

    /// Channels of a contact as measured by the robot and the force transducer. Other channels are absent.
    ///
    /// ```
    /// use taceva_core::{Channel, Channels, Newton, Readings, Wrench};
    /// let channels = Channels::new([Channel::PZ, Channel::FZ])?;
    /// let wrench = Wrench { force: [Newton(0.0), Newton(0.1), Newton(1.5)], ..Wrench::default() };
    /// let truth = Readings::of_contact(&channels, None, Some(&wrench));
    /// assert_eq!((truth.get(0), truth.get(1)), (None, Some(1.5)));
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    pub fn of_contact(
        channels: &Channels,
        pose: Option<&Pose>,
        wrench: Option<&Wrench>,
    ) -> Readings {
        let value = |name: &str| match name {
            "Px" => pose.map(|pose| pose.position.x.0),
            "Py" => pose.map(|pose| pose.position.y.0),
            "Pz" => pose.map(|pose| pose.position.z.0),
            "Fx" => wrench.map(|wrench| wrench.force[0].0),
            "Fy" => wrench.map(|wrench| wrench.force[1].0),
            "Fz" => wrench.map(|wrench| wrench.force[2].0),
            _ => None,
        };
        Readings {
            values: channels
                .iter()
                .map(|channel| value(channel.name()))
                .collect(),
        }
    }

    /// The value of the channel at `position`; `None` for a missing value.
    pub fn get(&self, position: usize) -> Option<f64> {
        self.values.get(position).copied().flatten()
    }

    /// The values in order.
    pub fn as_slice(&self) -> &[Option<f64>] {
        &self.values
    }
}
