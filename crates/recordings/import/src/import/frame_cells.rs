//! Which cells of a row name its frame.

use super::map::FrameNames;
use super::resolve::ResolvedTable;
use taceva_dataset::DatasetError;

/// The cells that name a frame.
pub(super) enum FrameCells {
    Column(usize),
    /// A path made of texts and the cells of columns, in order.
    Pattern(Vec<PatternPart>),
    /// The column of the position in another file, or without one in that of the table.
    Within {
        file: Option<Vec<PatternPart>>,
        index: usize,
    },
    /// The clip of each row and the frame in it, as the table itself says.
    Clips(Vec<(String, u64)>),
    /// Each row of the table has its own.
    OfRow,
}

pub(super) enum PatternPart {
    Text(String),
    Cell(usize),
}

/// How a row names its frame.
pub(super) enum FrameName {
    File(String),
    /// The position in a file, or without one in that of the table.
    Within(Option<String>, u64),
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
    pub(super) fn find(
        names: &FrameNames,
        table: &ResolvedTable,
    ) -> Result<FrameCells, DatasetError> {
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

/// The texts and columns of a pattern.
fn parts(pattern: &str, table: &ResolvedTable) -> Result<Vec<PatternPart>, DatasetError> {
    let mut parts = Vec::new();
    let mut rest = pattern;
    while let Some((text, after)) = rest.split_once('{') {
        let (name, after) = after.split_once('}').ok_or_else(|| DatasetError::Path {
            place: None,
            written: pattern.to_owned(),
            problem: "a `{` is never closed".to_owned(),
        })?;
        parts.push(PatternPart::Text(text.to_owned()));
        parts.push(PatternPart::Cell(table.position(name)?));
        rest = after;
    }
    parts.push(PatternPart::Text(rest.to_owned()));
    Ok(parts)
}
