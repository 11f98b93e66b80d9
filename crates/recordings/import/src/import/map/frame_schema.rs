//! Schema of the frame sources in a map: one section, or a list of named sections.

use std::fmt;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use toml::Spanned;

use super::check::{Check, ColumnName};
use super::{
    ArrayFrames, ArrayLayout, FrameMap, FrameNames, OWN_ROW, PixelRange, VideoFrames,
    reference_attribute,
};
use taceva_dataset::internal::is_attribute_name;
use taceva_dataset::{ChannelOrder, DatasetError};

/// Frames of a row: a single frame, or a frame for each of several views.
pub(super) enum WrittenFrames {
    One(Box<WrittenFrame>),
    Views(Vec<Spanned<WrittenFrame>>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenFrame {
    name: Option<Spanned<String>>,
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

/// Frame without contact: a path, a column that names a path for each row, or the number of a frame.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "the path of a picture, { column = … } that names a picture for each row, { frame = … } of the clip or array, or \"unknown\""
)]
enum WrittenReference {
    Path(String),
    Column(WrittenReferenceColumn),
    Frame(WrittenReferenceFrame),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenReferenceFrame {
    frame: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenReferenceColumn {
    column: ColumnName,
}

/// Array: the name of an array in the file of the table, or a separate file with an array. In map version 1, the name is the file name.
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

impl<'de> Deserialize<'de> for WrittenFrames {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<WrittenFrames, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = WrittenFrames;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table, or a list of tables with a `name` each")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<WrittenFrames, A::Error> {
                let one = WrittenFrame::deserialize(MapAccessDeserializer::new(map))?;
                Ok(WrittenFrames::One(Box::new(one)))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<WrittenFrames, A::Error> {
                let views = Vec::deserialize(SeqAccessDeserializer::new(list))?;
                Ok(WrittenFrames::Views(views))
            }
        }

        deserializer.deserialize_any(Either)
    }
}

impl WrittenFrames {
    fn each(&self) -> Vec<&WrittenFrame> {
        match self {
            WrittenFrames::One(frame) => vec![frame],
            WrittenFrames::Views(views) => views.iter().map(Spanned::get_ref).collect(),
        }
    }

    /// True if the frames without contact of a view may become the attribute `name`.
    pub(super) fn has_reference_attribute(&self, name: &str) -> bool {
        self.each().into_iter().any(|frame| {
            let view = frame.name.as_ref().map(|name| name.get_ref().as_str());
            matches!(frame.reference, WrittenReference::Column(_))
                && reference_attribute(view) == name
        })
    }

    /// Name of the array, if the map states only its name.
    pub(super) fn array_name(&self) -> Option<&str> {
        self.each()
            .into_iter()
            .find_map(|frame| match &frame.array {
                Some(WrittenArray::Name(name)) => Some(name.as_str()),
                _ => None,
            })
    }
}

impl Check<'_> {
    /// Checks the frames of each view.
    pub(super) fn frames(
        &self,
        written: Spanned<WrittenFrames>,
    ) -> Result<Vec<FrameMap>, DatasetError> {
        let start = written.span().start;
        let views = match written.into_inner() {
            WrittenFrames::One(frame) => {
                if let Some(name) = &frame.name {
                    return Err(self.at(
                        name.span().start,
                        "`name` is for several pictures of a row: write [[frame]] for each, or remove `name` if a row has one picture",
                    ));
                }
                return Ok(vec![self.frame(*frame, start)?]);
            }
            WrittenFrames::Views(views) => views,
        };
        let mut frames: Vec<FrameMap> = Vec::new();
        let is_one = views.len() < 2;
        for view in views {
            let start = view.span().start;
            let view = view.into_inner();
            if is_one {
                return Err(self.at(
                    start,
                    "a list of one picture: write [frame], without a `name`",
                ));
            }
            let name = view
                .name
                .as_ref()
                .ok_or_else(|| self.at(start, "each [[frame]] needs a `name`, such as \"left\""))?;
            let text = name.get_ref();
            if !is_attribute_name(text) {
                return Err(self.at(
                    name.span().start,
                    &format!(
                        "`{text}` is not a valid name of a view: expected a letter, then letters, digits or `_`"
                    ),
                ));
            }
            if frames.iter().any(|known| known.view.as_ref() == Some(text)) {
                return Err(self.at(
                    name.span().start,
                    &format!("two views are called `{text}`: give each its own `name`"),
                ));
            }
            frames.push(self.frame(view, start)?);
        }
        Ok(frames)
    }

    fn frame(&self, written: WrittenFrame, offset: usize) -> Result<FrameMap, DatasetError> {
        let range = self.range(written.range, written.bits, offset)?;
        let has_index = written.index.is_some();
        let index = written
            .index
            .map_or_else(|| OWN_ROW.to_owned(), ColumnName::into_name);
        if written.array.is_none()
            && (written.layout.is_some() || written.video.is_none() && range.is_some())
        {
            return Err(self.at(offset, "`layout` needs an `array`; `range` and `bits` need an `array` or a depth map as `video`"));
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
                    "expected one key for the frames: `column` or `pattern` for files, `array` or `video` (with the column of the \
                     position as `index`), or `bytes` for a column of the table",
                ));
            }
        };
        let (mut reference, mut reference_column, mut reference_frame) = (None, None, None);
        match written.reference {
            WrittenReference::Path(path) if path == "unknown" => {}
            WrittenReference::Path(path) => reference = Some(path),
            WrittenReference::Column(named) => {
                reference_column = Some(named.column.into_name());
            }
            WrittenReference::Frame(_)
                if matches!(names, FrameNames::Column(_) | FrameNames::Pattern(_)) =>
            {
                return Err(self.at(
                    offset,
                    "`reference = { frame = … }` is for an `array`, `bytes` or a `video`: write the path of the picture",
                ));
            }
            WrittenReference::Frame(named) => reference_frame = Some(named.frame),
        }
        for path in reference.iter().chain(&written.folder) {
            self.relative(path, offset)?;
        }
        Ok(FrameMap {
            view: written.name.map(Spanned::into_inner),
            names,
            folder: written.folder,
            channel_order: written.channel_order,
            reference,
            reference_column,
            reference_frame,
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
                "invalid `range` or `bits`, expected the values of black and of full, and 8 or 16, such as range = [0, 1] and bits = 8",
            )
        })
    }
}
