//! Stored units of channels, and accepted units of labels.

mod amount;
mod source;

pub use amount::{Amount, AmountError};
pub use source::{SourceUnit, UnitError};

use crate::display::display;

/// Unit in which TacEva stores and reports a channel.
///
/// ```
/// use taceva_core::Unit;
/// assert_eq!((Unit::Newton.symbol(), Unit::from_symbol("mm")), ("N", Some(Unit::Millimetre)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Unit {
    /// Millimetres, mm, for positions and indentation depths.
    #[cfg_attr(feature = "serde", serde(rename = "mm"))]
    Millimetre,
    /// Newtons, N, for forces.
    #[cfg_attr(feature = "serde", serde(rename = "N"))]
    Newton,
    /// Newton millimetres, N·mm, for torques.
    #[cfg_attr(feature = "serde", serde(rename = "N·mm"))]
    NewtonMillimetre,
    /// Degrees, for angles.
    #[cfg_attr(feature = "serde", serde(rename = "deg"))]
    Degree,
    /// Radians, for angles in tables that are scored without conversion. Labels of datasets are converted to degrees.
    #[cfg_attr(feature = "serde", serde(rename = "rad"))]
    Radian,
    /// Seconds.
    #[cfg_attr(feature = "serde", serde(rename = "s"))]
    Second,
    /// Hertz, Hz, for rates.
    #[cfg_attr(feature = "serde", serde(rename = "Hz"))]
    Hertz,
    /// Lux, lx, for illuminance.
    #[cfg_attr(feature = "serde", serde(rename = "lx"))]
    Lux,
    /// Pixels of the sensor's picture.
    #[cfg_attr(feature = "serde", serde(rename = "px"))]
    Pixel,
    /// Millimetres per newton, mm/N, for compliances: indentation per force.
    #[cfg_attr(feature = "serde", serde(rename = "mm/N"))]
    MillimetrePerNewton,
    /// Square millimetres, mm², for areas.
    #[cfg_attr(feature = "serde", serde(rename = "mm²"))]
    SquareMillimetre,
    /// Millimetres per hour, mm/h, for drifts of positions.
    #[cfg_attr(feature = "serde", serde(rename = "mm/h"))]
    MillimetrePerHour,
    /// Newtons per hour, N/h, for drifts of forces.
    #[cfg_attr(feature = "serde", serde(rename = "N/h"))]
    NewtonPerHour,
    /// Microteslas, µT, for magnetic flux densities.
    #[cfg_attr(feature = "serde", serde(rename = "uT"))]
    Microtesla,
    /// Steps of an analogue-to-digital converter.
    #[cfg_attr(feature = "serde", serde(rename = "count"))]
    Count,
    /// Volts, V, for voltages.
    #[cfg_attr(feature = "serde", serde(rename = "V"))]
    Volt,
    /// Kilopascals, kPa, for pressures.
    #[cfg_attr(feature = "serde", serde(rename = "kPa"))]
    Kilopascal,
    /// Degrees Celsius, °C, for temperatures.
    #[cfg_attr(feature = "serde", serde(rename = "degC"))]
    DegreeCelsius,
    /// Ohms, Ω, for resistances.
    #[cfg_attr(feature = "serde", serde(rename = "ohm"))]
    Ohm,
    /// Picofarads, pF, for capacitances.
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

    /// Symbol of the unit in files and reports.
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

    /// Unit with exactly this `symbol`; `None` for an unknown symbol.
    pub fn from_symbol(symbol: &str) -> Option<Unit> {
        Unit::ALL.into_iter().find(|unit| unit.symbol() == symbol)
    }
}

display!(Unit, symbol);
