//! The kinds of device.

use super::{Changer, ForceTransducer, Lighting, Robot, Sensor};
use crate::display::display;

/// The kind of a device.
///
/// ```
/// use taceva_core::DriverKind;
/// assert_eq!(DriverKind::ALL.map(DriverKind::name), ["sensor", "robot", "force", "lighting", "changer"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum DriverKind {
    /// Device that captures pictures of a gel.
    Sensor,
    /// Device that moves the indenter.
    Robot,
    /// Device that measures the force of the indenter on the gel.
    Force,
    /// Device that sets the light around the sensor.
    Lighting,
    /// Device that moves specimens or units of a sensor into place.
    Changer,
}

impl DriverKind {
    /// Every kind.
    pub const ALL: [DriverKind; 5] = [
        DriverKind::Sensor,
        DriverKind::Robot,
        DriverKind::Force,
        DriverKind::Lighting,
        DriverKind::Changer,
    ];

    /// Name of the kind in manifests and scenes.
    pub const fn name(self) -> &'static str {
        match self {
            DriverKind::Sensor => "sensor",
            DriverKind::Robot => "robot",
            DriverKind::Force => "force",
            DriverKind::Lighting => "lighting",
            DriverKind::Changer => "changer",
        }
    }
}

display!(DriverKind, name);

/// Trait of the types `dyn Sensor`, `dyn Robot` and so on, one per kind of device. Registries and factories are generic over these types.
///
/// ```
/// use taceva_core::{Device, DriverKind, Robot};
/// assert_eq!(<dyn Robot as Device>::KIND, DriverKind::Robot);
/// ```
pub trait Device {
    /// Kind of the device.
    const KIND: DriverKind;
}

impl Device for dyn Sensor {
    const KIND: DriverKind = DriverKind::Sensor;
}

impl Device for dyn Robot {
    const KIND: DriverKind = DriverKind::Robot;
}

impl Device for dyn ForceTransducer {
    const KIND: DriverKind = DriverKind::Force;
}

impl Device for dyn Lighting {
    const KIND: DriverKind = DriverKind::Lighting;
}

impl Device for dyn Changer {
    const KIND: DriverKind = DriverKind::Changer;
}
