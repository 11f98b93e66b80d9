//! Properties of a changer, known before it is opened.

/// Properties of a changer, a device that brings specimens or sensor units into place.
///
/// ```
/// use taceva_core::ChangerFacts;
/// let facts = ChangerFacts::default().with_holds(vec!["sphere of radius 4 mm".to_owned()]);
/// assert_eq!(facts.holds[0], "sphere of radius 4 mm");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ChangerFacts {
    /// Names of the specimens or sensor units that the changer can bring. Empty if the arguments of the driver list the names.
    pub holds: Vec<String>,
}

impl ChangerFacts {
    /// Sets [`holds`](ChangerFacts::holds).
    #[must_use]
    pub fn with_holds(mut self, holds: Vec<String>) -> ChangerFacts {
        self.holds = holds;
        self
    }
}
