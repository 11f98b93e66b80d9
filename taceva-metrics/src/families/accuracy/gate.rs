//! Gate of sMAPE: least magnitude of the truth for which a sample counts as in contact.

use taceva_core::Unit;

/// Gate of a unit: least magnitude of the truth of a sample in the gated sMAPE. The gate is 0.02 N, the contact threshold, or 0.02 mm.
///
/// `None` for other units.
pub(crate) fn gate(unit: Unit) -> Option<f64> {
    match unit {
        Unit::Newton | Unit::Millimetre => Some(0.02),
        _ => None,
    }
}
