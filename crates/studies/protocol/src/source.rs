//! Sources of the samples of a study, as data: descriptors of devices, or the contents of a recording. Planning opens no device.

use taceva_core::{Channels, Descriptor, FieldSet, Footprint, FrameInfo};

/// Source of the samples of a study.
#[derive(Clone, Debug)]
pub enum SourceInfo {
    /// Devices of a rig, which record the samples.
    Rig(Box<RigInfo>),
    /// A recording that already has the samples.
    Recording(RecordingInfo),
}

/// Descriptors of the devices of a rig; `None` for a missing device.
#[derive(Clone, Debug, Default)]
pub struct RigInfo {
    /// The sensor.
    pub sensor: Option<Descriptor>,
    /// The robot.
    pub robot: Option<Descriptor>,
    /// The force transducer.
    pub force: Option<Descriptor>,
    /// Lighting around the sensor, if the lighting has its own driver.
    pub lighting: Option<Descriptor>,
}

/// Contents of a recording.
#[derive(Clone, Debug)]
pub struct RecordingInfo {
    /// Fields of the recording's samples. Predictions are not included, because a model computes them.
    pub fields: FieldSet,
    /// Channels of the measured truth.
    pub channels: Channels,
    /// True if ambient light cannot reach the camera; `None` if unknown.
    pub opaque: Option<bool>,
    /// Sensing area, if known.
    pub footprint: Option<Footprint>,
    /// Size and format of the frames; `None` if the recording has no frames.
    pub frame: Option<FrameInfo>,
}
