//! Units in which labels and amounts are written, and their conversion to the stored unit.

use std::fmt;

use super::Unit;

/// Unit in which labels and amounts are written, with the conversion to the stored unit.
///
/// # Units
/// [`convert`](SourceUnit::convert) multiplies from m to mm and divides from um to mm, so that it rounds once.
///
/// ```
/// use taceva_core::{SourceUnit, Unit};
/// let metres = SourceUnit::parse("m")?;
/// assert_eq!(metres.unit(), Unit::Millimetre);
/// assert_eq!(metres.convert(0.0025), 2.5);
/// # Ok::<(), taceva_core::UnitError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceUnit {
    symbol: &'static str,
    unit: Unit,
    scale: Scale,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Scale {
    Times(f64),
    Over(f64),
}

/// Standard gravity, m/s²: exact by definition (3rd CGPM, 1901).
const STANDARD_GRAVITY: f64 = 9.806_65;
/// Pound-force, N: the weight of one international pound (1959), exactly 0.45359237 kg, under standard gravity.
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Ounce-force, N: a sixteenth of a pound-force.
const OUNCE_FORCE: f64 = POUND_FORCE / 16.0;
/// Inch, mm: exact by definition (1959).
const INCH: f64 = 25.4;
/// Foot, mm: twelve inches.
const FOOT: f64 = 304.8;

const SOURCE_UNITS: &[(&str, Unit, Scale)] = &[
    ("mm", Unit::Millimetre, Scale::Times(1.0)),
    ("m", Unit::Millimetre, Scale::Times(1e3)),
    ("cm", Unit::Millimetre, Scale::Times(10.0)),
    ("um", Unit::Millimetre, Scale::Over(1e3)),
    ("µm", Unit::Millimetre, Scale::Over(1e3)),
    // The micro sign and the Greek letter look the same.
    ("\u{3bc}m", Unit::Millimetre, Scale::Over(1e3)),
    ("nm", Unit::Millimetre, Scale::Over(1e6)),
    ("inch", Unit::Millimetre, Scale::Times(INCH)),
    ("N", Unit::Newton, Scale::Times(1.0)),
    ("mN", Unit::Newton, Scale::Over(1e3)),
    ("kN", Unit::Newton, Scale::Times(1e3)),
    ("gf", Unit::Newton, Scale::Times(STANDARD_GRAVITY / 1e3)),
    ("kgf", Unit::Newton, Scale::Times(STANDARD_GRAVITY)),
    ("lbf", Unit::Newton, Scale::Times(POUND_FORCE)),
    ("klbf", Unit::Newton, Scale::Times(4_448.221_615_260_5)),
    ("ozf", Unit::Newton, Scale::Times(OUNCE_FORCE)),
    ("dyn", Unit::Newton, Scale::Over(1e5)),
    ("N·mm", Unit::NewtonMillimetre, Scale::Times(1.0)),
    ("Nmm", Unit::NewtonMillimetre, Scale::Times(1.0)),
    ("N·m", Unit::NewtonMillimetre, Scale::Times(1e3)),
    ("Nm", Unit::NewtonMillimetre, Scale::Times(1e3)),
    ("mNm", Unit::NewtonMillimetre, Scale::Times(1.0)),
    ("kgf-cm", Unit::NewtonMillimetre, Scale::Times(98.066_5)),
    (
        "gf-cm",
        Unit::NewtonMillimetre,
        Scale::Times(98.066_5 / 1e3),
    ),
    (
        "lbf-in",
        Unit::NewtonMillimetre,
        Scale::Times(112.984_829_027_616_7),
    ),
    (
        "lbf-ft",
        Unit::NewtonMillimetre,
        Scale::Times(POUND_FORCE * FOOT),
    ),
    (
        "ozf-in",
        Unit::NewtonMillimetre,
        Scale::Times(OUNCE_FORCE * INCH),
    ),
    ("deg", Unit::Degree, Scale::Times(1.0)),
    (
        "rad",
        Unit::Degree,
        Scale::Times(180.0 / std::f64::consts::PI),
    ),
    ("s", Unit::Second, Scale::Times(1.0)),
    ("ms", Unit::Second, Scale::Over(1e3)),
    ("us", Unit::Second, Scale::Over(1e6)),
    ("µs", Unit::Second, Scale::Over(1e6)),
    ("\u{3bc}s", Unit::Second, Scale::Over(1e6)),
    ("ns", Unit::Second, Scale::Over(1e9)),
    ("Hz", Unit::Hertz, Scale::Times(1.0)),
    ("lx", Unit::Lux, Scale::Times(1.0)),
    ("px", Unit::Pixel, Scale::Times(1.0)),
    ("mm/N", Unit::MillimetrePerNewton, Scale::Times(1.0)),
    ("mm²", Unit::SquareMillimetre, Scale::Times(1.0)),
    ("mm/h", Unit::MillimetrePerHour, Scale::Times(1.0)),
    ("N/h", Unit::NewtonPerHour, Scale::Times(1.0)),
    ("uT", Unit::Microtesla, Scale::Times(1.0)),
    ("µT", Unit::Microtesla, Scale::Times(1.0)),
    ("\u{3bc}T", Unit::Microtesla, Scale::Times(1.0)),
    ("mT", Unit::Microtesla, Scale::Times(1e3)),
    ("G", Unit::Microtesla, Scale::Times(100.0)),
    ("count", Unit::Count, Scale::Times(1.0)),
    ("V", Unit::Volt, Scale::Times(1.0)),
    ("mV", Unit::Volt, Scale::Over(1e3)),
    ("kPa", Unit::Kilopascal, Scale::Times(1.0)),
    ("Pa", Unit::Kilopascal, Scale::Over(1e3)),
    ("hPa", Unit::Kilopascal, Scale::Over(10.0)),
    ("MPa", Unit::Kilopascal, Scale::Times(1e3)),
    ("bar", Unit::Kilopascal, Scale::Times(100.0)),
    ("mbar", Unit::Kilopascal, Scale::Over(10.0)),
    ("psi", Unit::Kilopascal, Scale::Times(6.894_757_293_168_361)),
    ("degC", Unit::DegreeCelsius, Scale::Times(1.0)),
    ("ohm", Unit::Ohm, Scale::Times(1.0)),
    ("pF", Unit::Picofarad, Scale::Times(1.0)),
    ("1", Unit::One, Scale::Times(1.0)),
    ("%", Unit::One, Scale::Over(100.0)),
];

impl SourceUnit {
    /// Parses the unit `symbol`. Case matters, because `mN` is not `MN`.
    ///
    /// # Errors
    /// [`UnitError`] with the accepted symbols.
    pub fn parse(symbol: &str) -> Result<SourceUnit, UnitError> {
        SOURCE_UNITS
            .iter()
            .find(|(known, _, _)| *known == symbol)
            .map(|&(symbol, unit, scale)| SourceUnit {
                symbol,
                unit,
                scale,
            })
            .ok_or_else(|| UnitError {
                symbol: symbol.to_owned(),
            })
    }

    /// Every symbol that [`parse`](SourceUnit::parse) accepts.
    pub fn symbols() -> impl Iterator<Item = &'static str> {
        SOURCE_UNITS.iter().map(|(symbol, _, _)| *symbol)
    }

    /// Symbol of the unit, as [`parse`](SourceUnit::parse) accepted it.
    pub const fn symbol(&self) -> &'static str {
        self.symbol
    }

    /// Unit of the values after conversion.
    pub const fn unit(&self) -> Unit {
        self.unit
    }

    /// Places by which the conversion to the stored unit shifts the decimal point: 3 from m to mm. `None` if the factor is not a power of ten.
    /// Shifting the point in the text rounds once, in parsing; [`convert`](SourceUnit::convert) rounds the parsed number again.
    pub fn decimal_shift(&self) -> Option<i32> {
        let find = |factor: f64| {
            let powers: [(f64, i32); 7] = [
                (1e0, 0),
                (1e1, 1),
                (1e2, 2),
                (1e3, 3),
                (1e5, 5),
                (1e6, 6),
                (1e9, 9),
            ];
            let is_it = |power: f64| power.to_bits() == factor.to_bits();
            let found = powers.into_iter().find(|(power, _)| is_it(*power));
            found.map(|(_, shift)| shift)
        };
        match self.scale {
            Scale::Times(factor) => find(factor),
            Scale::Over(divisor) => find(divisor).map(|shift| -shift),
        }
    }

    /// Converts `value` to the stored unit, rounded once.
    pub fn convert(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Times(factor) => value * factor,
            Scale::Over(divisor) => value / divisor,
        }
    }
}

/// Error for a symbol that is not a known unit.
///
/// ```
/// use taceva_core::SourceUnit;
/// let error = SourceUnit::parse("furlong").unwrap_err();
/// assert!(error.to_string().starts_with("unknown unit `furlong`, expected one of mm, "));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    symbol: String,
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "unknown unit `{}`, expected one of ",
            crate::shown(&self.symbol)
        )?;
        for (position, symbol) in SourceUnit::symbols().enumerate() {
            let separator = if position == 0 { "" } else { ", " };
            write!(f, "{separator}{symbol}")?;
        }
        Ok(())
    }
}

impl std::error::Error for UnitError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kept_unit_is_a_source_unit_that_changes_nothing() {
        // Angles are kept in degrees; radians are those of foreign tables alone.
        for unit in Unit::ALL.into_iter().filter(|unit| *unit != Unit::Radian) {
            let source = SourceUnit::parse(unit.symbol()).expect("kept units are accepted");
            assert_eq!(source.unit(), unit);
            assert_eq!(source.convert(0.1).to_bits(), 0.1_f64.to_bits());
        }
    }

    #[test]
    fn micrometres_divide_so_that_the_result_is_the_nearest_binary64() {
        let micrometres = SourceUnit::parse("um").expect("known");
        assert_eq!(micrometres.convert(2_343.0).to_bits(), 2.343_f64.to_bits());
    }

    #[test]
    fn units_of_taxels_are_kept_in_one_of_each_quantity() {
        let kept = |symbol, value| {
            let source = SourceUnit::parse(symbol).expect("known");
            (source.unit(), source.convert(value))
        };
        assert_eq!(kept("mT", 0.25), (Unit::Microtesla, 250.0));
        assert_eq!(kept("G", 0.5), (Unit::Microtesla, 50.0));
        assert_eq!(kept("mV", 512.0), (Unit::Volt, 0.512));
        assert_eq!(kept("Pa", 101_325.0), (Unit::Kilopascal, 101.325));
    }

    #[test]
    fn units_of_american_transducers_and_of_pressures_are_those_of_nist_special_publication_811() {
        for (symbol, unit, one) in [
            ("lbf", Unit::Newton, 4.448_221_615_260_5),
            ("klbf", Unit::Newton, 4_448.221_615_260_5),
            ("ozf", Unit::Newton, 0.278_013_850_953_781_2),
            ("dyn", Unit::Newton, 1e-5),
            ("lbf-in", Unit::NewtonMillimetre, 112.984_829_027_616_7),
            ("lbf-ft", Unit::NewtonMillimetre, 1_355.817_948_331_400_4),
            ("ozf-in", Unit::NewtonMillimetre, 7.061_551_814_226_044),
            ("kgf-cm", Unit::NewtonMillimetre, 98.066_5),
            ("psi", Unit::Kilopascal, 6.894_757_293_168_361),
            ("bar", Unit::Kilopascal, 100.0),
            ("mbar", Unit::Kilopascal, 0.1),
            ("inch", Unit::Millimetre, 25.4),
        ] {
            let source = SourceUnit::parse(symbol).expect("known");
            assert_eq!(source.unit(), unit, "{symbol}");
            let error = (source.convert(1.0) - one).abs();
            assert!(
                error <= f64::EPSILON * one,
                "{symbol}: {}",
                source.convert(1.0)
            );
        }
    }

    #[test]
    fn a_shift_is_there_for_powers_of_ten_alone() {
        let shift = |symbol| SourceUnit::parse(symbol).expect("known").decimal_shift();
        assert_eq!(
            ["mm", "m", "cm", "um", "ns", "%"].map(shift),
            [0, 3, 1, -3, -9, -2].map(Some)
        );
        assert_eq!(["rad", "kgf", "gf"].map(shift), [None; 3]);
    }

    #[test]
    fn an_unknown_unit_lists_what_is_accepted() {
        let message = SourceUnit::parse("newton")
            .expect_err("unknown")
            .to_string();
        assert!(
            message.starts_with("unknown unit `newton`, expected one of mm, m, "),
            "{message}"
        );
    }
}
