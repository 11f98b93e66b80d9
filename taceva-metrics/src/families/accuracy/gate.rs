//! From which magnitude of truth on a sample counts as contact.

use taceva_core::Unit;

/// The least |y| of a sample of the gated sMAPE: 0.02 N, the contact threshold, and as many mm.
///
/// No gate is defined for other units.
pub(crate) fn gate(unit: Unit) -> Option<f64> {
    match unit {
        Unit::Newton | Unit::Millimetre => Some(0.02),
        _ => None,
    }
}
