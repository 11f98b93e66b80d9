//! One sample: readings taken together, from a live rig or from a recording.

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
    /// Name of the sample in its recording.
    pub id: String,
    /// Name of the sensor model.
    pub sensor_id: Option<String>,
    /// Name of the individual unit of the sensor model.
    pub unit_id: Option<String>,
    /// Lighting scene, or another condition of the recording.
    pub scene_id: Option<String>,
    /// Contact point, shared by its repeats. Confidence intervals cluster samples by this point.
    pub point_id: Option<String>,
    /// Number of the depth level at the contact point.
    pub depth_step: Option<u32>,
    /// Number of the repeated press at the contact point.
    pub repeat: Option<u32>,
    /// Branch of the press: load or unload.
    pub phase: Option<Phase>,
    /// Limit of the gel that stopped the tip before its target. Labels and picture then belong to the position that the tip reached.
    pub limited_by: Option<Limit>,
    /// Standard uncertainty of the fitted height at which the depth `Pz` is 0, mm. `None` if this height is not fitted.
    pub zero_u_mm: Option<f64>,
    /// Time of the observation.
    pub stamp: Option<Stamp>,
    /// Kind of the touched grating: lines or dots.
    pub kind: Option<GratingKind>,
    /// Spacing of the touched grating.
    pub spacing: Option<Nanometre>,
    /// Spacing of the touched grating, as a model predicts it.
    pub predicted_spacing: Option<Nanometre>,
    /// Mean luma over all pixels of the full-size picture, on the 8-bit scale from 0 to 255. Luma is (299 R + 587 G + 114 B) / 1000.
    pub intensity: Option<f64>,
    /// SHA-256 of the picture's bytes, `sha256:` and 64 hexadecimal digits. Equal digests show equal pictures without decoding.
    pub frame_digest: Option<String>,
    /// Decoded picture.
    pub frame: Option<Frame>,
    /// Readings of all taxels, for a sensor with taxels.
    pub signals: Option<Signals>,
    /// Readings of the reference instruments, one per channel.
    pub truth: Readings,
    /// Values that a model predicts, one per channel.
    pub prediction: Option<Readings>,
}

/// One value per channel, in the order of the [`Channels`] of the samples. An absent value is `None`.
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
    /// Readings with the given values; `None` for an absent value.
    pub fn new(values: Vec<Option<f64>>) -> Readings {
        Readings { values }
    }

    /// Readings in which every channel has a value.
    pub fn from_values(values: impl IntoIterator<Item = f64>) -> Readings {
        Readings {
            values: values.into_iter().map(Some).collect(),
        }
    }

    /// Readings of one contact from the pose of the robot and the wrench of the force transducer. Channels other than positions and forces are
    /// absent.
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

    /// The value of the channel at index `position`; `None` if the value is absent or there is no such channel.
    pub fn get(&self, position: usize) -> Option<f64> {
        self.values.get(position).copied().flatten()
    }

    /// Values of all channels, in their order.
    pub fn as_slice(&self) -> &[Option<f64>] {
        &self.values
    }
}
