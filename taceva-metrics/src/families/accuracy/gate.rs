//! Least magnitude of truth of a sample in contact.

use taceva_core::Unit;

/// Least |y| of a sample of the gated sMAPE: 0.02 N, the contact threshold, and 0.02 mm.
///
/// No gate is defined for other units.
pub(crate) fn gate(unit: Unit) -> Option<f64> {
    match unit {
        Unit::Newton | Unit::Millimetre => Some(0.02),
        _ => None,
    }
}
