//! Facts about a changer before it is opened.

/// Facts about a changer.
///
/// ```
/// use taceva_core::ChangerFacts;
/// let facts = ChangerFacts::default().with_holds(vec!["sphere of radius 4 mm".to_owned()]);
/// assert_eq!(facts.holds[0], "sphere of radius 4 mm");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ChangerFacts {
    /// Names of the changer's items; empty if its arguments list the items.
    pub holds: Vec<String>,
}

impl ChangerFacts {
    /// The same facts with another [`holds`](ChangerFacts::holds).
    #[must_use]
    pub fn with_holds(mut self, holds: Vec<String>) -> ChangerFacts {
        self.holds = holds;
        self
    }
}
