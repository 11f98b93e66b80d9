//! Where the frames are, as it is written.

use serde::Deserialize;
use toml::Spanned;

use super::check::{Check, ColumnName};
use super::{ArrayFrames, ArrayLayout, FrameMap, FrameNames, OWN_ROW, PixelRange, VideoFrames};
use taceva_dataset::{ChannelOrder, DatasetError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenFrame {
    column: Option<ColumnName>,
    pattern: Option<String>,
    array: Option<WrittenArray>,
    bytes: Option<ColumnName>,
    video: Option<String>,
    index: Option<ColumnName>,
    layout: Option<ArrayLayout>,
    range: Option<[f64; 2]>,
    bits: Option<u8>,
    folder: Option<String>,
    channel_order: ChannelOrder,
    reference: WrittenReference,
}

/// A path, or the column that names one a row.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "the path of a picture, { column = … } that names one a row, or \"unknown\""
)]
enum WrittenReference {
    Path(String),
    Column(WrittenReferenceColumn),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenReferenceColumn {
    column: ColumnName,
}

/// An array: its name in the file of the table (of map version 1: its file), or the file too.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "the name of an array, or { file = …, path = … }"
)]
enum WrittenArray {
    Name(String),
    InFile(WrittenArrayFile),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenArrayFile {
    file: String,
    path: Option<String>,
}

impl WrittenFrame {
    pub(super) fn has_reference_column(&self) -> bool {
        matches!(self.reference, WrittenReference::Column(_))
    }

    /// The name of an array, where it is given as a text.
    pub(super) fn array_name(&self) -> Option<&str> {
        match &self.array {
            Some(WrittenArray::Name(name)) => Some(name),
            _ => None,
        }
    }
}

impl Check<'_> {
    pub(super) fn frame(&self, written: Spanned<WrittenFrame>) -> Result<FrameMap, DatasetError> {
        let offset = written.span().start;
        let written = written.into_inner();
        let range = self.range(written.range, written.bits, offset)?;
        let has_index = written.index.is_some();
        let index = written
            .index
            .map_or_else(|| OWN_ROW.to_owned(), ColumnName::into_name);
        if written.array.is_none()
            && (written.layout.is_some() || written.video.is_none() && range.is_some())
        {
            return Err(self.at(offset, "`layout` is for an `array`, `range` and `bits` for one or for a depth map as `video`"));
        }
        let given = (
            written.column,
            written.pattern,
            written.array,
            written.bytes,
            written.video,
        );
        let names = match given {
            (Some(column), None, None, None, None) if !has_index => {
                FrameNames::Column(column.into_name())
            }
            (None, Some(pattern), None, None, None) if !has_index => {
                self.relative(&pattern, offset)?;
                FrameNames::Pattern(pattern)
            }
            (None, None, Some(array), None, None) => {
                let (file, path) = match array {
                    WrittenArray::Name(path) => (None, Some(path)),
                    WrittenArray::InFile(array) => (Some(array.file), array.path),
                };
                file.iter()
                    .try_for_each(|file| self.relative(file, offset))?;
                FrameNames::Array(ArrayFrames {
                    file,
                    path,
                    index,
                    layout: written.layout,
                    range,
                })
            }
            (None, None, None, Some(column), None) if !has_index => {
                FrameNames::Bytes(column.into_name())
            }
            (None, None, None, None, Some(file)) => {
                self.relative(&file, offset)?;
                FrameNames::Video(VideoFrames { file, index, range })
            }
            _ => {
                return Err(self.at(
                    offset,
                    "frames are in files named by `column` or `pattern`, in an `array` or a `video` (with the column of the position as `index`), or as \
                     `bytes` in the table: expected one of the five",
                ));
            }
        };
        let (reference, reference_column) = match written.reference {
            WrittenReference::Path(path) if path == "unknown" => (None, None),
            WrittenReference::Path(path) => (Some(path), None),
            WrittenReference::Column(named) => (None, Some(named.column.into_name())),
        };
        for path in reference.iter().chain(&written.folder) {
            self.relative(path, offset)?;
        }
        Ok(FrameMap {
            names,
            folder: written.folder,
            channel_order: written.channel_order,
            reference,
            reference_column,
        })
    }

    fn range(
        &self,
        ends: Option<[f64; 2]>,
        bits: Option<u8>,
        offset: usize,
    ) -> Result<Option<PixelRange>, DatasetError> {
        let range = match (ends, bits) {
            (None, None) => return Ok(None),
            (Some(ends), Some(bits)) => PixelRange::new(ends, bits),
            _ => None,
        };
        range.map(Some).ok_or_else(|| {
            self.at(
                offset,
                "`range` is the number of black and that of full, `bits` 8 or 16: such as range = [0, 1] and bits = 8",
            )
        })
    }
}
