//! Faults of worn gels and of plugins, in addition to the faults of this crate.

use crate::foreign::PictureFault;
use crate::worn::WornFault;

/// Faults that this crate does not make. Callers build this struct as a literal; it gets no further field.
///
/// ```
/// let none = taceva_stress::OtherFaults::default();
/// assert!(none.worn.is_empty() && none.foreign.is_empty());
/// ```
#[derive(Clone, Copy, Default)]
pub struct OtherFaults<'a> {
    /// Faults of a worn gel, each a recording on that gel.
    pub worn: &'a [WornFault],
    /// Faults of pictures that plugins make.
    pub foreign: &'a [&'a dyn PictureFault],
}

impl OtherFaults<'_> {
    pub(crate) fn is_some(&self) -> bool {
        !self.worn.is_empty() || !self.foreign.is_empty()
    }
}
