//! Gate of sMAPE: least magnitude of truth of a sample in contact.

use taceva_core::Unit;

/// Gate of a unit, the least |y| of a sample in the gated sMAPE: 0.02 N, the contact threshold, or 0.02 mm.
///
/// `None` for other units.
pub(crate) fn gate(unit: Unit) -> Option<f64> {
    match unit {
        Unit::Newton | Unit::Millimetre => Some(0.02),
        _ => None,
    }
}
