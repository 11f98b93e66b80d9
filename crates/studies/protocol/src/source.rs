//! What a study can be fed from, as data: the descriptors of its devices, or what a recording holds. Planning opens nothing.

use taceva_core::{Channels, Descriptor, FieldSet, Footprint, FrameInfo};

/// Where the samples of a study come from.
#[derive(Clone, Debug)]
pub enum SourceInfo {
    /// Devices.
    Rig(Box<RigInfo>),
    /// A recording.
    Recording(RecordingInfo),
}

/// The descriptors of the devices of a rig; absent ones are not there.
#[derive(Clone, Debug, Default)]
pub struct RigInfo {
    /// The sensor.
    pub sensor: Option<Descriptor>,
    /// The robot.
    pub robot: Option<Descriptor>,
    /// The force transducer.
    pub force: Option<Descriptor>,
    /// The light around the sensor, if a driver of its own sets it.
    pub lighting: Option<Descriptor>,
}

/// What a recording holds.
#[derive(Clone, Debug)]
pub struct RecordingInfo {
    /// The fields that its samples carry; predictions never, a model makes them.
    pub fields: FieldSet,
    /// The channels of the truth.
    pub channels: Channels,
    /// Whether ambient light cannot reach the camera, if anybody wrote it down.
    pub opaque: Option<bool>,
    /// Where the sensor senses, if anybody wrote it down.
    pub footprint: Option<Footprint>,
    /// Size and format of the frames, if there are any.
    pub frame: Option<FrameInfo>,
}
