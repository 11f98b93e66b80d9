//! Mistake in a manifest, with its position.

use std::fmt;
use std::ops::Range;

use taceva_core::nearest;

use crate::text::shown;

/// Mistake in a manifest or a `[[provides]]` table: its position and the expected value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ManifestError {
    place: Option<(usize, usize)>,
    problem: String,
}

impl ManifestError {
    /// Creates an error without a position.
    pub(crate) fn whole(problem: impl Into<String>) -> ManifestError {
        ManifestError {
            place: None,
            problem: problem.into(),
        }
    }

    /// Creates an error at a byte range of `text`.
    pub(crate) fn at(text: &str, span: &Range<usize>, problem: impl Into<String>) -> ManifestError {
        let before = text.get(..span.start).unwrap_or(text);
        let line = 1 + before.matches('\n').count();
        let begin = before.rfind('\n').map_or(0, |newline| newline + 1);
        let column = 1 + before[begin..].chars().count();
        ManifestError {
            place: Some((line, column)),
            problem: problem.into(),
        }
    }

    /// Converts an error of the TOML parser.
    pub(crate) fn of_parser(text: &str, error: &toml::de::Error) -> ManifestError {
        let problem = explained(error.message());
        match error.span() {
            Some(span) => ManifestError::at(text, &span, problem),
            None => ManifestError::whole(problem),
        }
    }

    /// Line of the mistake, counted from 1; `None` if it has no position.
    pub fn line(&self) -> Option<usize> {
        self.place.map(|(line, _)| line)
    }
}

impl fmt::Display for ManifestError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.place {
            write!(f, "line {line}, column {column}: ")?;
        }
        f.write_str(&self.problem)
    }
}

impl std::error::Error for ManifestError {}

/// Rewrites the parser's message and suggests the nearest key.
fn explained(message: &str) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match quoted.as_slice() {
        [wrong, known @ ..] if message.starts_with("unknown field") => {
            let guess = match nearest(wrong, known.iter().copied()) {
                Some(nearest) => format!(", did you mean `{nearest}`?"),
                None => ";".to_owned(),
            };
            let known = known.join(", ");
            format!("`{}`: unknown key{guess} known here: {known}", shown(wrong))
        }
        [missing] if message.starts_with("missing field") => {
            format!("the key `{missing}` is missing")
        }
        _ => shown(&message.trim_end().replace('\n', "; ")),
    }
}
