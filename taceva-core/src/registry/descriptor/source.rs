//! Source of the readings of a driver.

use crate::display::display;

/// Source of the readings of a driver. Every output based on these readings names the source. This enum gets no further variant in a
/// compatible version, because every reader must handle each source.
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
    /// A model of a device.
    Simulated,
    /// A recording of a device.
    Recorded,
}

impl DriverSource {
    /// Name of the source in reports.
    pub const fn name(self) -> &'static str {
        match self {
            DriverSource::Real => "real",
            DriverSource::Simulated => "simulated",
            DriverSource::Recorded => "recorded",
        }
    }
}

display!(DriverSource, name);
