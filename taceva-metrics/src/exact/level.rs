//! Values as whole steps: where they are compared with a bound, or sorted into bins, rounding decides nothing.

use taceva_core::{Nanometre, Unit};

/// `value` in whole millionths of its unit, ties to even; `None` for what is no number up to 2⁵³ of them.
pub(crate) fn millionths(value: f64) -> Option<i64> {
    // What a nanometre is to a millimetre.
    Nanometre::from_millimetres(value).map(|millionths| millionths.0)
}

/// Whole millionths in the unit, rounded once.
pub(crate) fn from_millionths(millionths: i64) -> f64 {
    Nanometre(millionths).to_millimetres()
}

/// The width of a level of a unit, in millionths of it: 0.1 mm and 0.1 N, 1 degree and 1 N mm.
///
/// It is not defined for other units.
pub(crate) fn step(unit: Unit) -> Option<i64> {
    match unit {
        Unit::Millimetre | Unit::Newton => Some(100_000),
        Unit::Degree | Unit::NewtonMillimetre => Some(1_000_000),
        _ => None,
    }
}
