//! Suggestions for unknown words.

use std::fmt;

/// The most similar known word, or all known words if none is similar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Suggestion {
    nearest: Option<String>,
    known: Vec<String>,
}

impl Suggestion {
    /// Suggests known words for `word`.
    pub fn of<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Suggestion {
        let known: Vec<String> = known.into_iter().map(str::to_owned).collect();
        let nearest = taceva_core::nearest(word, known.iter().map(String::as_str));
        let nearest = nearest.map(str::to_owned);
        Suggestion { nearest, known }
    }

    /// Suggests only `word`.
    pub(crate) fn meaning(word: &str) -> Suggestion {
        Suggestion {
            nearest: Some(word.to_owned()),
            known: vec![word.to_owned()],
        }
    }

    /// Most similar word; `None` if no word is similar.
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
