//! Which cells of a row name its frame.

use super::map::FrameNames;
use super::resolve::RowTable;
use crate::error::DatasetError;

/// The cells that name a frame.
pub(super) enum FrameCells {
    Column(usize),
    /// Texts and columns in turn.
    Pattern(Vec<PatternPart>),
    Index(usize),
}

pub(super) enum PatternPart {
    Text(String),
    Cell(usize),
}

/// How a row names its frame.
pub(super) enum FrameName {
    File(String),
    Index(usize),
}

/// The path that texts and the cells between them make.
pub(super) fn filled<'c>(parts: &'c [PatternPart], cell: impl Fn(usize) -> &'c str) -> String {
    let texts = parts.iter().map(|part| match part {
        PatternPart::Text(text) => text.as_str(),
        PatternPart::Cell(column) => cell(*column),
    });
    texts.collect()
}

impl FrameCells {
    pub(super) fn find(names: &FrameNames, table: &RowTable) -> Result<FrameCells, DatasetError> {
        match names {
            FrameNames::Column(name) => Ok(FrameCells::Column(table.position(name)?)),
            FrameNames::Array(array) => Ok(FrameCells::Index(table.position(&array.index)?)),
            FrameNames::Pattern(pattern) => {
                let mut parts = Vec::new();
                let mut rest = pattern.as_str();
                while let Some((text, after)) = rest.split_once('{') {
                    let (name, after) =
                        after.split_once('}').ok_or_else(|| DatasetError::Path {
                            place: None,
                            written: pattern.clone(),
                            problem: "a `{` is never closed".to_owned(),
                        })?;
                    parts.push(PatternPart::Text(text.to_owned()));
                    parts.push(PatternPart::Cell(table.position(name)?));
                    rest = after;
                }
                parts.push(PatternPart::Text(rest.to_owned()));
                Ok(FrameCells::Pattern(parts))
            }
        }
    }
}
