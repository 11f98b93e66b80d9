//! Stored units of channels, and accepted units of labels.

mod amount;
mod source;

pub use amount::{Amount, AmountError};
pub use source::{SourceUnit, UnitError};

use std::fmt;

/// The unit in which TacEva keeps and reports a channel.
///
/// ```
/// use taceva_core::Unit;
/// assert_eq!((Unit::Newton.symbol(), Unit::from_symbol("mm")), ("N", Some(Unit::Millimetre)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Unit {
    /// mm, of positions and indentation depths.
    #[cfg_attr(feature = "serde", serde(rename = "mm"))]
    Millimetre,
    /// N, of forces.
    #[cfg_attr(feature = "serde", serde(rename = "N"))]
    Newton,
    /// N·mm, of torques.
    #[cfg_attr(feature = "serde", serde(rename = "N·mm"))]
    NewtonMillimetre,
    /// Degrees, of angles.
    #[cfg_attr(feature = "serde", serde(rename = "deg"))]
    Degree,
    /// Radians, of angles in tables that are scored as they are. Labels of datasets are converted to degrees.
    #[cfg_attr(feature = "serde", serde(rename = "rad"))]
    Radian,
    /// Seconds.
    #[cfg_attr(feature = "serde", serde(rename = "s"))]
    Second,
    /// Hz, of rates.
    #[cfg_attr(feature = "serde", serde(rename = "Hz"))]
    Hertz,
    /// lx, of illuminance.
    #[cfg_attr(feature = "serde", serde(rename = "lx"))]
    Lux,
    /// Pixels of the sensor's own picture.
    #[cfg_attr(feature = "serde", serde(rename = "px"))]
    Pixel,
    /// mm/N, of compliances: how far the gel yields per newton.
    #[cfg_attr(feature = "serde", serde(rename = "mm/N"))]
    MillimetrePerNewton,
    /// mm², of areas.
    #[cfg_attr(feature = "serde", serde(rename = "mm²"))]
    SquareMillimetre,
    /// mm/h, of positions that drift.
    #[cfg_attr(feature = "serde", serde(rename = "mm/h"))]
    MillimetrePerHour,
    /// N/h, of forces that drift.
    #[cfg_attr(feature = "serde", serde(rename = "N/h"))]
    NewtonPerHour,
    /// µT, of magnetic flux densities.
    #[cfg_attr(feature = "serde", serde(rename = "uT"))]
    Microtesla,
    /// Steps of an analogue-to-digital converter.
    #[cfg_attr(feature = "serde", serde(rename = "count"))]
    Count,
    /// V, of voltages.
    #[cfg_attr(feature = "serde", serde(rename = "V"))]
    Volt,
    /// kPa, of pressures.
    #[cfg_attr(feature = "serde", serde(rename = "kPa"))]
    Kilopascal,
    /// °C, of temperatures.
    #[cfg_attr(feature = "serde", serde(rename = "degC"))]
    DegreeCelsius,
    /// Ω, of resistances.
    #[cfg_attr(feature = "serde", serde(rename = "ohm"))]
    Ohm,
    /// pF, of capacitances.
    #[cfg_attr(feature = "serde", serde(rename = "pF"))]
    Picofarad,
    /// No unit: a ratio or a normalised value.
    #[cfg_attr(feature = "serde", serde(rename = "1"))]
    One,
}

impl Unit {
    /// Every unit, for tests and for help texts.
    pub const ALL: [Unit; 21] = [
        Unit::Millimetre,
        Unit::Newton,
        Unit::NewtonMillimetre,
        Unit::Degree,
        Unit::Radian,
        Unit::Second,
        Unit::Hertz,
        Unit::Lux,
        Unit::Pixel,
        Unit::MillimetrePerNewton,
        Unit::SquareMillimetre,
        Unit::MillimetrePerHour,
        Unit::NewtonPerHour,
        Unit::Microtesla,
        Unit::Count,
        Unit::Volt,
        Unit::Kilopascal,
        Unit::DegreeCelsius,
        Unit::Ohm,
        Unit::Picofarad,
        Unit::One,
    ];

    /// Symbol in files and reports.
    pub const fn symbol(self) -> &'static str {
        match self {
            Unit::Millimetre => "mm",
            Unit::Newton => "N",
            Unit::NewtonMillimetre => "N·mm",
            Unit::Degree => "deg",
            Unit::Radian => "rad",
            Unit::Second => "s",
            Unit::Hertz => "Hz",
            Unit::Lux => "lx",
            Unit::Pixel => "px",
            Unit::MillimetrePerNewton => "mm/N",
            Unit::SquareMillimetre => "mm²",
            Unit::MillimetrePerHour => "mm/h",
            Unit::NewtonPerHour => "N/h",
            Unit::Microtesla => "uT",
            Unit::Count => "count",
            Unit::Volt => "V",
            Unit::Kilopascal => "kPa",
            Unit::DegreeCelsius => "degC",
            Unit::Ohm => "ohm",
            Unit::Picofarad => "pF",
            Unit::One => "1",
        }
    }

    /// The unit written as `symbol`, exactly.
    pub fn from_symbol(symbol: &str) -> Option<Unit> {
        Unit::ALL.into_iter().find(|unit| unit.symbol() == symbol)
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}
