//! Cells of a row that name its frame.

use std::borrow::Cow;

use super::map::FrameNames;
use super::pattern_column::{NumberForm, PatternColumn};
use super::resolve::ResolvedTable;
use crate::error::ImportError;

/// Cells that name the frame of a row.
pub(super) enum FrameCells {
    Column(usize),
    /// Path composed of texts and of the cells of columns, in order.
    Pattern(Vec<PatternPart>),
    /// Position of the column that contains the number of the frame in another file; `file` is `None` for the file of the table.
    Within {
        file: Option<Vec<PatternPart>>,
        index: usize,
    },
    /// Clip and frame number of each row, as stated by a LeRobot table.
    Clips(Vec<(String, u64)>),
    /// One frame for each row: the row number is the frame number.
    OfRow,
}

pub(super) enum PatternPart {
    Text(String),
    Cell(usize, NumberForm),
}

impl PatternPart {
    /// True if this part is a cell, and that cell is empty.
    pub(super) fn is_empty<'c>(&self, cell: impl Fn(usize) -> &'c str) -> bool {
        match self {
            PatternPart::Text(_) => false,
            PatternPart::Cell(column, _) => cell(*column).is_empty(),
        }
    }
}

/// Name of a row's frame.
pub(super) enum FrameName {
    File(String),
    /// Frame at this position in a file; `None` for the file of the table.
    Within(Option<String>, u64),
}

/// Path that `parts` form: their texts and cells, joined.
pub(super) fn filled<'c>(parts: &'c [PatternPart], cell: impl Fn(usize) -> &'c str) -> String {
    let texts = parts.iter().map(|part| match part {
        PatternPart::Text(text) => Cow::Borrowed(text.as_str()),
        PatternPart::Cell(column, form) => Cow::Owned(form.write(cell(*column))),
    });
    texts.collect()
}

impl FrameCells {
    pub(super) fn find(
        names: &FrameNames,
        table: &ResolvedTable,
    ) -> Result<FrameCells, ImportError> {
        Ok(match names {
            FrameNames::Column(name) => FrameCells::Column(table.position(name)?),
            FrameNames::Pattern(pattern) => FrameCells::Pattern(parts(pattern, table)?),
            FrameNames::Bytes(_) => FrameCells::OfRow,
            FrameNames::Array(array) => FrameCells::Within {
                file: array
                    .file
                    .as_ref()
                    .map(|file| parts(file, table))
                    .transpose()?,
                index: table.position(&array.index)?,
            },
            FrameNames::Video(video) => FrameCells::Within {
                file: Some(parts(&video.file, table)?),
                index: table.position(&video.index)?,
            },
        })
    }
}

/// Parses a pattern into texts and columns.
fn parts(pattern: &str, table: &ResolvedTable) -> Result<Vec<PatternPart>, ImportError> {
    let mut parts = Vec::new();
    let mut rest = pattern;
    while let Some((text, after)) = rest.split_once('{') {
        let (column, after) = after
            .split_once('}')
            .ok_or_else(|| ImportError::path(pattern, "a `{` is never closed"))?;
        parts.push(PatternPart::Text(text.to_owned()));
        let column = PatternColumn::parse(column, |name| table.find(name).is_some());
        parts.push(PatternPart::Cell(table.position(column.name)?, column.form));
        rest = after;
    }
    parts.push(PatternPart::Text(rest.to_owned()));
    Ok(parts)
}
