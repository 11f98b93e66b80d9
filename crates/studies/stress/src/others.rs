//! Faults in addition to the faults of this crate.

use crate::foreign::PictureFault;
use crate::worn::WornFault;

/// Faults that this crate does not make. Callers build it as a literal; it has no further fields.
///
/// ```
/// let none = taceva_stress::OtherFaults::default();
/// assert!(none.worn.is_empty() && none.foreign.is_empty());
/// ```
#[derive(Clone, Copy, Default)]
pub struct OtherFaults<'a> {
    /// Faults of gels.
    pub worn: &'a [WornFault],
    /// Faults of pictures that plugins make.
    pub foreign: &'a [&'a dyn PictureFault],
}

impl OtherFaults<'_> {
    pub(crate) fn is_some(&self) -> bool {
        !self.worn.is_empty() || !self.foreign.is_empty()
    }
}
