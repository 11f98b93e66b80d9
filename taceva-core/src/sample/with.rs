//! Constructor of a sample and setters for its single fields. They let callers compile when a field is added.

use super::{Readings, Sample};
use crate::frame::Frame;
use crate::grating::GratingKind;
use crate::nanometre::Nanometre;
use crate::outcome::Limit;
use crate::phase::Phase;
use crate::signals::Signals;
use crate::stamp::Stamp;

impl Sample {
    /// A sample called `id`, with all other fields empty.
    pub fn new(id: impl Into<String>) -> Sample {
        Sample {
            id: id.into(),
            ..Sample::default()
        }
    }

    /// The same sample with the name `sensor_id` of its sensor model. `None` removes the name.
    #[must_use]
    pub fn with_sensor_id(mut self, sensor_id: impl Into<Option<String>>) -> Sample {
        self.sensor_id = sensor_id.into();
        self
    }

    /// The same sample with the name of the individual unit of its sensor model.
    #[must_use]
    pub fn with_unit_id(mut self, unit_id: impl Into<Option<String>>) -> Sample {
        self.unit_id = unit_id.into();
        self
    }

    /// The same sample with the lighting scene.
    #[must_use]
    pub fn with_scene_id(mut self, scene_id: impl Into<Option<String>>) -> Sample {
        self.scene_id = scene_id.into();
        self
    }

    /// The same sample with the contact point.
    #[must_use]
    pub fn with_point_id(mut self, point_id: impl Into<Option<String>>) -> Sample {
        self.point_id = point_id.into();
        self
    }

    /// The same sample with the number of the depth level at its contact point.
    #[must_use]
    pub fn with_depth_step(mut self, depth_step: impl Into<Option<u32>>) -> Sample {
        self.depth_step = depth_step.into();
        self
    }

    /// The same sample with the number of the repeated press.
    #[must_use]
    pub fn with_repeat(mut self, repeat: impl Into<Option<u32>>) -> Sample {
        self.repeat = repeat.into();
        self
    }

    /// The same sample with the branch of the press, load or unload.
    #[must_use]
    pub fn with_phase(mut self, phase: impl Into<Option<Phase>>) -> Sample {
        self.phase = phase.into();
        self
    }

    /// The same sample with the limit that stopped the tip before its target.
    #[must_use]
    pub fn with_limited_by(mut self, limited_by: impl Into<Option<Limit>>) -> Sample {
        self.limited_by = limited_by.into();
        self
    }

    /// The same sample with the standard uncertainty of the height at which its depth is 0, mm.
    #[must_use]
    pub fn with_zero_u_mm(mut self, zero_u_mm: impl Into<Option<f64>>) -> Sample {
        self.zero_u_mm = zero_u_mm.into();
        self
    }

    /// The same sample with a time stamp.
    #[must_use]
    pub fn with_stamp(mut self, stamp: impl Into<Option<Stamp>>) -> Sample {
        self.stamp = stamp.into();
        self
    }

    /// The same sample with the kind of the touched grating.
    #[must_use]
    pub fn with_kind(mut self, kind: impl Into<Option<GratingKind>>) -> Sample {
        self.kind = kind.into();
        self
    }

    /// The same sample with the spacing of the touched grating.
    #[must_use]
    pub fn with_spacing(mut self, spacing: impl Into<Option<Nanometre>>) -> Sample {
        self.spacing = spacing.into();
        self
    }

    /// The same sample with the grating spacing that a model predicts.
    #[must_use]
    pub fn with_predicted_spacing(
        mut self,
        predicted_spacing: impl Into<Option<Nanometre>>,
    ) -> Sample {
        self.predicted_spacing = predicted_spacing.into();
        self
    }

    /// The same sample with the mean luma of its picture, from 0 to 255.
    #[must_use]
    pub fn with_intensity(mut self, intensity: impl Into<Option<f64>>) -> Sample {
        self.intensity = intensity.into();
        self
    }

    /// The same sample with the digest of its picture.
    #[must_use]
    pub fn with_frame_digest(mut self, frame_digest: impl Into<Option<String>>) -> Sample {
        self.frame_digest = frame_digest.into();
        self
    }

    /// The same sample with its picture.
    #[must_use]
    pub fn with_frame(mut self, frame: impl Into<Option<Frame>>) -> Sample {
        self.frame = frame.into();
        self
    }

    /// The same sample with the readings of its taxels.
    #[must_use]
    pub fn with_signals(mut self, signals: impl Into<Option<Signals>>) -> Sample {
        self.signals = signals.into();
        self
    }

    /// The same sample with the readings of the reference instruments.
    #[must_use]
    pub fn with_truth(mut self, truth: Readings) -> Sample {
        self.truth = truth;
        self
    }

    /// The same sample with the predictions of a model.
    #[must_use]
    pub fn with_prediction(mut self, prediction: impl Into<Option<Readings>>) -> Sample {
        self.prediction = prediction.into();
        self
    }
}
