//! What a wrong word may have been meant to be.

use std::fmt;

/// The nearest of some known words, where one is near; otherwise all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Suggestion {
    nearest: Option<String>,
    known: Vec<String>,
}

impl Suggestion {
    /// What `word` may have been meant to be.
    pub fn of<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Suggestion {
        let known: Vec<String> = known.into_iter().map(str::to_owned).collect();
        let nearest = taceva_core::nearest(word, known.iter().map(String::as_str));
        let nearest = nearest.map(str::to_owned);
        Suggestion { nearest, known }
    }

    /// The nearest word, if one is near.
    pub fn nearest(&self) -> Option<&str> {
        self.nearest.as_deref()
    }
}

impl fmt::Display for Suggestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.nearest {
            Some(nearest) => write!(f, "did you mean `{nearest}`?"),
            None if self.known.is_empty() => f.write_str("none is accepted here"),
            None => write!(f, "expected one of {}", self.known.join(", ")),
        }
    }
}
