//! Messages of one topic of a recording as a table: MCAP, rosbag2, ROS 1 bags.

use std::path::Path;
use std::sync::Arc;

use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_tables::{Cell, Recording, SampleForm, TableError, TopicTable};

use super::columns::{BeforeCut, ColumnSource, PictureColumn, PictureKind};
use super::pictures::{Ended, Picture, Pictures, Visit, guarded_visit};
use super::said;
use crate::error::ImportError;
use crate::frame_names::FrameNames;
use taceva_dataset::ChannelOrder;
use taceva_dataset::internal::guarded;

/// Message types of ROS 2, ROS 1 and Foxglove with a picture in the field `data`.
const PICTURES: [&str; 6] = [
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/CompressedImage",
    "sensor_msgs/Image",
    "sensor_msgs/CompressedImage",
    "foxglove.RawImage",
    "foxglove.CompressedImage",
];

/// Filename extensions of recordings of messages.
const ENDINGS: [&str; 3] = ["mcap", "db3", "bag"];

/// True for the filename extension of a recording of messages.
pub(crate) fn is_recording(ending: &str) -> bool {
    ENDINGS.contains(&ending)
}

/// Messages of a topic, in logging order.
#[derive(Debug)]
pub(super) struct MessageRows {
    table: Arc<TopicTable>,
    names: Vec<String>,
    /// Unread topics of the recording, each with the reason.
    unread: Vec<String>,
    before_cut: Option<BeforeCut>,
}

/// Pictures in one field of the messages.
#[derive(Debug)]
struct MessagePictures {
    table: Arc<TopicTable>,
    field: String,
}

/// Topics of a recording, for a draft.
pub(crate) struct Topics {
    pub(crate) names: Vec<String>,
    /// Readable part of the recording, if the recording was truncated.
    pub(crate) before_cut: Option<BeforeCut>,
}

impl Topics {
    /// Topics of the recording at `path`. A truncated recording has only the topics of its readable part.
    pub(crate) fn of(path: &Path) -> Result<Topics, String> {
        let recording = guarded(|| open(path, true)).and_then(|opened| opened)?;
        let topics = recording.topics().iter();
        Ok(Topics {
            names: topics.map(|topic| topic.name.clone()).collect(),
            before_cut: before_cut(&recording),
        })
    }
}

/// Opens the recording at `path`. A truncated recording is an error, unless `is_to_cut` permits reading only its complete records.
fn open(path: &Path, is_to_cut: bool) -> Result<Recording, String> {
    let opened = match is_to_cut {
        true => Recording::open_to_cut(path),
        false => Recording::open(path),
    };
    opened.map_err(|error| match &error {
        TableError::Cut { messages: 1.., .. } => format!(
            "{}; to import only these messages, write `cut = \"keep\"` beside `rows` in the table of the map",
            said(path, &error)
        ),
        _ => said(path, &error),
    })
}

/// Readable part of a truncated recording; `None` if the recording is complete.
fn before_cut(recording: &Recording) -> Option<BeforeCut> {
    let topics = recording.topics().iter();
    let messages = topics.map(|topic| topic.count).sum();
    let end = recording.cut_at()?;
    Some(BeforeCut { messages, end })
}

impl MessageRows {
    /// Opens the messages of `topic`, or of the only topic. A truncated recording is an error, unless `is_to_cut` permits reading its complete
    /// records.
    pub(super) fn open(
        path: &Path,
        topic: Option<&str>,
        is_to_cut: bool,
    ) -> Result<MessageRows, String> {
        let recording = open(path, is_to_cut)?;
        let topic = match (topic, recording.topics()) {
            (Some(topic), _) => topic.to_owned(),
            (None, [only]) => only.name.clone(),
            (None, several) => {
                let names: Vec<&str> = several.iter().map(|topic| topic.name.as_str()).collect();
                return Err(format!(
                    "the file holds several topics; name one by `rows`: {}",
                    names.join(", ")
                ));
            }
        };
        let table = recording
            .table(&topic)
            .map_err(|error| said(path, &error))?;
        let absent = table
            .absent_arrays()
            .map_err(|error| said(path, &error))?
            .into_iter()
            .map(|field| {
                format!(
                    "topic {topic}: `{field}` states the shape of an array, but the file was written without its numbers: write it with \
                     them (tacstack: `write_episode_mcap(…, embed_payloads=True)`)"
                )
            });
        Ok(MessageRows {
            names: table.names().map_err(|error| said(path, &error))?,
            unread: unread(&recording).into_iter().chain(absent).collect(),
            before_cut: before_cut(&recording),
            table: Arc::new(table),
        })
    }
}

/// Unread topics of `recording`, each with the reason.
fn unread(recording: &Recording) -> Vec<String> {
    let topics = recording.topics().iter();
    let unread = topics.filter_map(|topic| {
        let reason = recording.why_unread(&topic.name)?;
        Some(format!(
            "topic {} ({} messages): {reason}",
            topic.name, topic.count
        ))
    });
    unread.collect()
}

impl MessageRows {
    /// Colour order that the message of the first picture states; `None` without such a statement.
    fn order_of(&self, field: &str) -> Option<ChannelOrder> {
        let mut order = None;
        let _ = self.table.visit_pictures(field, &[0], &mut |_, picture| {
            if let taceva_tables::Picture::Samples(samples) = picture {
                order = order_of(samples.form);
            }
            Ok::<(), taceva_tables::TableError>(())
        });
        order
    }
}

/// Colour order of pictures of the form `form`; `None` if the form states none.
fn order_of(form: SampleForm) -> Option<ChannelOrder> {
    match form {
        SampleForm::Mono8 | SampleForm::Mono16 => Some(ChannelOrder::Gray),
        SampleForm::Rgb8 => Some(ChannelOrder::Rgb),
        SampleForm::Bgr8 => Some(ChannelOrder::Bgr),
        _ => None,
    }
}

impl ColumnSource for MessageRows {
    fn rows(&self) -> usize {
        usize::try_from(self.table.rows()).unwrap_or(usize::MAX)
    }

    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    fn has(&self, name: &str) -> bool {
        self.names.iter().any(|known| known == name)
    }

    /// Reads all columns in one pass over the recording.
    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        let columns = self.table.columns(names);
        let columns = columns.map_err(|error| said(self.table.path(), &error))?;
        let texts = columns.iter().map(|cells| {
            let texts = cells.iter().map(|cell| cell.text().into_owned());
            texts.collect()
        });
        Ok(texts.collect())
    }

    /// True if every cell is an integer, a null, or a list of these. A schema in the file determines the types of cells.
    fn holds_integers(&self, name: &str) -> bool {
        let columns = self.table.columns(&[name]);
        columns.is_ok_and(|columns| columns.iter().flatten().all(is_integer))
    }

    fn unread(&self) -> Vec<String> {
        self.unread.clone()
    }

    fn before_cut(&self) -> Option<BeforeCut> {
        self.before_cut
    }

    fn picture_columns(&self) -> Vec<PictureColumn> {
        let is_picture = PICTURES.contains(&self.table.topic().schema.as_str());
        let data = is_picture.then(|| PictureColumn {
            name: "data".to_owned(),
            kind: PictureKind::Encoded,
            order: self.order_of("data"),
        });
        data.into_iter().collect()
    }

    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        let FrameNames::Bytes(field) = names else {
            return Err(
                "pictures in messages: name their field by `bytes`, usually `data`".to_owned(),
            );
        };
        if !self.has(field) {
            let there = self.names.join(", ");
            return Err(format!(
                "no field `{field}` for the frames; the fields are {there}"
            ));
        }
        Ok(Arc::new(MessagePictures {
            table: Arc::clone(&self.table),
            field: field.clone(),
        }))
    }
}

impl Pictures for MessagePictures {
    fn path(&self) -> &Path {
        self.table.path()
    }

    fn count(&self) -> u64 {
        self.table.rows()
    }

    fn visit(
        &self,
        sorted: &[u64],
        order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), ImportError> {
        guarded_visit(self.path(), || {
            self.table
                .visit_pictures(&self.field, sorted, &mut |row, picture| {
                    let picture = kept(picture, order);
                    let picture = picture.map_err(|problem| {
                        Ended::Picture(ImportError::image(
                            self.path(),
                            format!("message {row}: {problem}"),
                        ))
                    })?;
                    each(row, picture).map_err(Ended::Picture)
                })
        })
    }
}

/// True for an integer, a null, or a list of these.
fn is_integer(cell: &Cell) -> bool {
    match cell {
        Cell::Integer(_) | Cell::Null => true,
        Cell::List(cells) => cells.iter().all(is_integer),
        _ => false,
    }
}

/// Picture as stored: encoded bytes are unchanged, samples are in the colour order of the map.
fn kept(picture: taceva_tables::Picture, order: ChannelOrder) -> Result<Picture, String> {
    let samples = match picture {
        taceva_tables::Picture::Encoded(bytes) => return Ok(Picture::Encoded(bytes)),
        taceva_tables::Picture::Samples(samples) => samples,
        other => {
            return Err(format!("unknown kind of picture: {other:?}"));
        }
    };
    let (format, stored) = match samples.form {
        SampleForm::Mono8 => (PixelFormat::Gray8, ChannelOrder::Gray),
        SampleForm::Mono16 => (PixelFormat::Gray16, ChannelOrder::Gray),
        SampleForm::Rgb8 => (PixelFormat::Rgb8, ChannelOrder::Rgb),
        SampleForm::Bgr8 => (PixelFormat::Rgb8, ChannelOrder::Bgr),
        other => return Err(format!("pixels of type {other:?} are not supported")),
    };
    if stored != order {
        return Err(format!(
            "the message states the colours `{}`, the map `{}`: correct `channel_order`",
            stored.name(),
            order.name()
        ));
    }
    let info = FrameInfo {
        width: samples.width,
        height: samples.height,
        format,
    };
    let frame = Frame::new(info, samples.bytes).map_err(|error| error.to_string())?;
    Ok(Picture::Pixels(frame))
}
