//! Facts about a lighting device before it is opened.

/// Facts that a driver declares about a lighting device.
///
/// ```
/// use taceva_core::LightingFacts;
/// let facts = LightingFacts::default().with_scenes(vec!["normal".to_owned(), "dark".to_owned()]);
/// assert_eq!(facts.scenes[0], "normal");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LightingFacts {
    /// Names of the lighting scenes. The first one is the scene of the calibration.
    pub scenes: Vec<String>,
}

impl LightingFacts {
    /// The same facts with the given [`scenes`](LightingFacts::scenes).
    #[must_use]
    pub fn with_scenes(mut self, scenes: Vec<String>) -> LightingFacts {
        self.scenes = scenes;
        self
    }
}
