//! Findings in a catalogue.

use taceva_report::catalogue::CatalogueError;

/// Fault of a file of a catalogue.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct CatalogueFinding {
    /// Path in the catalogue: `entries/gelsight.toml`.
    pub path: String,
    /// Line of the fault; `None` for a fault of the whole file.
    pub line: Option<usize>,
    /// Value found, value expected, and the remedy.
    pub problem: String,
}

impl CatalogueFinding {
    pub(super) fn new(path: &str, problem: impl Into<String>) -> CatalogueFinding {
        CatalogueFinding {
            path: path.to_owned(),
            line: None,
            problem: problem.into(),
        }
    }

    /// Fault of the entry at `path`.
    pub(super) fn of_entry(path: &str, error: &CatalogueError) -> CatalogueFinding {
        let message = error.to_string();
        let (line, problem) = match error {
            CatalogueError::Toml { line, .. } | CatalogueError::Row { line, .. } => (
                Some(*line),
                message.strip_prefix(&format!("{path}:{line}: ")),
            ),
            _ => (None, message.strip_prefix(&format!("{path}: "))),
        };
        CatalogueFinding {
            path: path.to_owned(),
            line,
            problem: problem.unwrap_or(&message).to_owned(),
        }
    }
}
