//! Text of a scene or a rig file. Parsing is strict, and errors name the line.

mod error;
mod setting;

use serde::de::DeserializeOwned;
use taceva_core::{nearest, shown};

pub use error::{SceneError, SceneProblem};
pub use setting::Setting;

/// Greatest length of a scene, in bytes.
pub const GREATEST_SCENE: usize = 1 << 20;

/// Text of a scene or rig file, and its name for errors.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Text {
    source_name: String,
    text: String,
}

impl Text {
    pub(crate) fn new(source_name: &str, text: &str) -> Result<Text, SceneError> {
        let whole = Text {
            source_name: source_name.to_owned(),
            text: text.to_owned(),
        };
        if text.len() > GREATEST_SCENE {
            let problem = SceneProblem::Size {
                bytes: text.len(),
                greatest: GREATEST_SCENE,
            };
            return Err(whole.error(None, problem));
        }
        Ok(whole)
    }

    /// Name of the text for errors.
    pub(crate) fn source_name(&self) -> &str {
        &self.source_name
    }

    /// Whole text.
    pub(crate) fn whole(&self) -> &str {
        &self.text
    }

    /// Parses the text as a `T`.
    pub(crate) fn read<T: DeserializeOwned>(&self) -> Result<T, SceneError> {
        toml::from_str(&self.text).map_err(|error| {
            let at = error.span().map(|span| span.start);
            self.error(at, explained(error.message()))
        })
    }

    /// Error for `problem` at the line of the byte offset `at`.
    pub(crate) fn error(&self, at: Option<usize>, problem: SceneProblem) -> SceneError {
        SceneError {
            source_name: self.source_name.clone(),
            line: at.map(|at| self.line(at)),
            problem: Box::new(problem),
        }
    }

    /// Error for `name`, which is not in `known`, with the most similar known name. `what` is the kind of the item.
    pub(crate) fn unknown_name(
        &self,
        at: Option<usize>,
        what: &'static str,
        name: &str,
        known: Vec<&str>,
    ) -> SceneError {
        let problem = SceneProblem::UnknownName {
            what,
            name: shown(name).to_string(),
            nearest: nearest(name, known.iter().copied()).map(str::to_owned),
            known: known.join(", "),
        };
        self.error(at, problem)
    }

    /// Name of the text, with the number of the line at the byte offset `at`.
    pub(crate) fn place(&self, at: Option<usize>) -> String {
        let name = shown(&self.source_name);
        at.map_or_else(
            || name.to_string(),
            |at| format!("{name}, line {}", self.line(at)),
        )
    }

    fn line(&self, at: usize) -> u64 {
        let before = self.text.bytes().take(at);
        1 + before.filter(|byte| *byte == b'\n').count() as u64
    }
}

/// Converts a message of the TOML parser to a problem, and escapes control characters.
fn explained(message: &str) -> SceneProblem {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match quoted.as_slice() {
        [wrong, known @ ..] if message.starts_with("unknown field") => SceneProblem::UnknownKey {
            key: shown(wrong).to_string(),
            nearest: nearest(wrong, known.iter().copied()).map(str::to_owned),
            known: known.join(", "),
        },
        [missing] if message.starts_with("missing field") => {
            SceneProblem::MissingKey(shown(*missing).to_string())
        }
        _ => SceneProblem::Syntax(shown(&message.trim_end().replace('\n', "; ")).to_string()),
    }
}
