//! Origin of the readings of a driver: a real device, a simulation or a recording.

use crate::display::display;

/// Origin of the readings of a driver. Each output computed from the readings names this origin. This enum gets no further variant in a compatible
/// version, because programs must handle each origin.
///
/// ```
/// use taceva_core::DriverSource;
/// assert_eq!(DriverSource::Simulated.name(), "simulated");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum DriverSource {
    /// A physical device.
    Real,
    /// A simulated device.
    Simulated,
    /// A recording of a device.
    Recorded,
}

impl DriverSource {
    /// Name of the origin in reports.
    pub const fn name(self) -> &'static str {
        match self {
            DriverSource::Real => "real",
            DriverSource::Simulated => "simulated",
            DriverSource::Recorded => "recorded",
        }
    }
}

display!(DriverSource, name);
