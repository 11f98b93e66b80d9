//! Values as integers, so that rounding affects neither comparisons with a bound nor the choice of a bin.

use taceva_core::{Nanometre, Unit};

/// `value` in whole millionths of its unit, ties to even; `None` for NaN or for more than 2⁵³ millionths.
#[inline]
pub(crate) fn millionths(value: f64) -> Option<i64> {
    /// 1.5 × 2⁵²: adding this number rounds to an integer, which is then the low part of the bit pattern.
    const ONES: f64 = 6_755_399_441_055_744.0;
    const GREATEST: f64 = 1_125_899_906_842_624.0;
    let scaled = value * 1e6;
    if scaled.abs() <= GREATEST {
        return Some((scaled + ONES).to_bits().cast_signed() - ONES.to_bits().cast_signed());
    }
    // `from_millimetres` counts millionths of any unit.
    Nanometre::from_millimetres(value).map(|millionths| millionths.0)
}

/// Converts `millionths` of a unit to a value in this unit, rounded once.
pub(crate) fn from_millionths(millionths: i64) -> f64 {
    Nanometre(millionths).to_millimetres()
}

/// Width of a level, a bin of truths, in millionths of the unit: 0.1 mm and 0.1 N, 1 degree and 1 N mm.
///
/// `None` for other units.
pub(crate) fn step(unit: Unit) -> Option<i64> {
    match unit {
        Unit::Millimetre | Unit::Newton => Some(100_000),
        Unit::Degree | Unit::NewtonMillimetre => Some(1_000_000),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millionths_are_the_nanometres_of_as_many_millimetres() {
        let ties = (-8..8).map(|half| f64::from(half) * 0.5e-6);
        let lengths = (-900..900).map(|step| f64::from(step) * 1.234_567_8e6);
        let ends = [2_f64.powi(50) * 1e-6, 2_f64.powi(53) * 1e-6, 9.1e9, -9.1e9];
        let others = [0.0, -0.0, 1e-300, f64::NAN, f64::INFINITY];
        for value in ties.chain(lengths).chain(ends).chain(others) {
            let expected = Nanometre::from_millimetres(value).map(|length| length.0);
            assert_eq!(millionths(value), expected, "{value:e}");
        }
    }
}
