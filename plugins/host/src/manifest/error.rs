//! What is wrong with a manifest, and where.

use std::fmt;
use std::ops::Range;

use taceva_core::nearest;

use crate::text::shown;

/// Text that is no manifest, or no `[[provides]]` table: where it stands, and what would be accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ManifestError {
    place: Option<(usize, usize)>,
    problem: String,
}

impl ManifestError {
    /// A problem that is of no line.
    pub(crate) fn whole(problem: impl Into<String>) -> ManifestError {
        ManifestError {
            place: None,
            problem: problem.into(),
        }
    }

    /// A problem at bytes of `text`.
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

    /// What the parser found.
    pub(crate) fn of_parser(text: &str, error: &toml::de::Error) -> ManifestError {
        let problem = explained(error.message());
        match error.span() {
            Some(span) => ManifestError::at(text, &span, problem),
            None => ManifestError::whole(problem),
        }
    }

    /// The line, from 1, where one is to blame.
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

/// The parser's message with the nearest key.
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
