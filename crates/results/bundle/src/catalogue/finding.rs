//! Findings in a catalogue.

use taceva_report::catalogue::CatalogueError;

/// Fault of a file of a catalogue.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct CatalogueFinding {
    /// Path in the catalogue: `entries/gelsight.toml`.
    pub path: String,
    /// Line at which the fault is; `None` for a fault of the whole file.
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

    /// Fault of the entry `text` at `path`.
    pub(super) fn of_entry(path: &str, text: &str, error: &CatalogueError) -> CatalogueFinding {
        let (line, problem) = match error {
            CatalogueError::Toml { source, .. } => {
                let start = source.span().map(|span| span.start);
                let before = start.and_then(|start| text.get(..start));
                let line = before.map(|before| before.matches('\n').count() + 1);
                (line, source.message().to_owned())
            }
            CatalogueError::Row {
                line,
                what,
                found,
                expected,
                ..
            } => (
                Some(*line),
                format!("{what} `{found}`: expected {expected}"),
            ),
            other => {
                let text = other.to_string();
                let problem = text.strip_prefix(&format!("{path}: ")).unwrap_or(&text);
                (None, problem.to_owned())
            }
        };
        CatalogueFinding {
            path: path.to_owned(),
            line,
            problem,
        }
    }
}
