//! The messages of one topic as rows.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use super::chunks::Chunks;
use super::contents::Contents;
use super::index::{Entry, index};
use super::json;
use super::record::{self, MessageHead, code};
use super::{Inner, Topic};
use crate::bytes::Bytes;
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::limits;
use crate::ros::{self, Fields, Picture, PictureField, RosSchema};
use crate::rows::check_sorted;

/// The messages of one topic, in the order in which they were logged; at the same time, as they lie in the file.
///
/// Columns are the fields of the messages by their dotted names (`wrench.force.x`, `position[2]`), and when each message was logged
/// and published: `log_time` and `publish_time` in seconds, `log_time.ns` and `publish_time.ns` as whole nanoseconds. A field that is a
/// time is one number too: `header.stamp` in seconds, `header.stamp.ns` in nanoseconds, with `sec` and `nanosec` inside.
///
/// ```
/// use taceva_tables::{Cell, Mcap};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.mcap");
/// let force = Mcap::open(path.as_ref())?.table("/ft/wrench")?;
/// assert_eq!(force.rows(), 3);
/// let columns = force.columns(&["header.stamp.ns", "wrench.force.z"])?;
/// assert_eq!(columns[0][1], Cell::Integer(1_700_000_000_500_000_000));
/// assert_eq!(columns[1], [Cell::Number(2.0), Cell::Number(3.5), Cell::Number(1.25)]);
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Clone, Debug)]
pub struct McapTable {
    inner: Arc<Inner>,
    topic: Topic,
    channels: BTreeSet<u16>,
    language: Language,
    entries: Arc<Vec<Entry>>,
}

/// What messages are written in.
#[derive(Clone, Debug)]
enum Language {
    Ros(Arc<RosSchema>),
    Json,
}

impl McapTable {
    pub(super) fn new(inner: &Arc<Inner>, topic: Topic) -> Result<McapTable, TableError> {
        let contents = &inner.contents;
        let channels: BTreeSet<u16> = contents
            .channels
            .iter()
            .filter(|(_, channel)| channel.topic == topic.name)
            .map(|(id, _)| *id)
            .collect();
        let language = language(inner, &topic, contents, &channels)?;
        let entries = index(&inner.source, contents, &channels)?;
        Ok(McapTable {
            inner: Arc::clone(inner),
            topic,
            channels,
            language,
            entries: Arc::new(entries),
        })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        self.inner.source.path()
    }

    /// The topic.
    pub fn topic(&self) -> &Topic {
        &self.topic
    }

    /// How many messages there are.
    pub fn rows(&self) -> u64 {
        self.entries.len() as u64
    }

    /// The columns: times, then fields in the order of the schema, lists by one name each. Of JSON those of the first message.
    ///
    /// # Errors
    /// [`TableError::Unsupported`] if the schema has more fields than are accepted; of JSON as [`columns`](Self::columns).
    pub fn names(&self) -> Result<Vec<String>, TableError> {
        let mut names: Vec<String> = TIMES.iter().map(|(name, _)| (*name).to_owned()).collect();
        match &self.language {
            Language::Ros(schema) => {
                let fields = ros::names(schema);
                names.extend(fields.map_err(|problem| self.unsupported(problem))?);
            }
            Language::Json => {
                if let Some(first) = self.entries.first() {
                    let mut chunks = Chunks::new(&self.inner.source)?;
                    self.message(&mut chunks, first, |_, message| {
                        let cell = json::cell(message)?;
                        json::add_names(&cell, "", &mut names);
                        Ok(())
                    })?;
                }
            }
        }
        Ok(names)
    }

    /// What is in the columns called `names`, a column each, row by row. The file is read once, whatever their number.
    ///
    /// # Errors
    /// [`TableError::Missing`] if there is no such field, [`TableError::TooLarge`] if the cells take more than 320 MiB of memory,
    /// [`TableError::Damaged`] if a chunk or a message does not read.
    pub fn columns(&self, names: &[&str]) -> Result<Vec<Vec<Cell>>, TableError> {
        let is_time = |name: &&str| TIMES.iter().any(|(time, _)| time == name);
        let of_message: Vec<&str> = names
            .iter()
            .copied()
            .filter(|name| !is_time(name))
            .collect();
        let read = self.reader(&of_message)?;
        let too_large = || {
            let problem = format!(
                "more than {} bytes in memory; ask for fewer fields",
                limits::COLUMN_BYTES
            );
            self.inner
                .source
                .too_large(Place::of(&self.topic.name), problem)
        };
        let least = (names.len() as u64)
            .saturating_mul(self.rows())
            .saturating_mul(size_of::<Cell>() as u64);
        if least > limits::COLUMN_BYTES {
            return Err(too_large());
        }
        let mut columns = vec![vec![Cell::Null; self.entries.len()]; names.len()];
        let mut bytes = 0_u64;
        // In the order of the file, so that every chunk is unpacked once.
        let mut order: Vec<usize> = (0..self.entries.len()).collect();
        order.sort_by_key(|row| {
            (
                self.entries[*row].chunk.unwrap_or(self.entries[*row].at),
                self.entries[*row].at,
            )
        });
        let mut chunks = Chunks::new(&self.inner.source)?;
        for row in order {
            self.message(&mut chunks, &self.entries[row], |head, message| {
                let mut cells = match of_message.is_empty() {
                    true => Vec::new(),
                    false => read(message)?,
                }
                .into_iter();
                for (column, name) in columns.iter_mut().zip(names) {
                    let cell = match TIMES.iter().find(|(time, _)| time == name) {
                        Some((_, time)) => Some(time(&head)),
                        None => cells.next(),
                    };
                    let cell = cell.unwrap_or(Cell::Null);
                    bytes = bytes.saturating_add(cell.bytes());
                    column[row] = cell;
                }
                Ok(())
            })?;
            if bytes > limits::COLUMN_BYTES {
                return Err(too_large());
            }
        }
        Ok(columns)
    }

    /// What is in the column called `name`, row by row: [`columns`](Self::columns) of one.
    ///
    /// # Errors
    /// As [`columns`](Self::columns).
    pub fn column(&self, name: &str) -> Result<Vec<Cell>, TableError> {
        Ok(self.columns(&[name])?.pop().unwrap_or_default())
    }

    /// Hands the pictures in the field called `name`, such as `data` of `sensor_msgs/Image` and `sensor_msgs/CompressedImage`, of the rows
    /// `sorted` to `each`, with the row. Two chunks are in memory at a time.
    ///
    /// `sorted` must ascend; a row that stands in it twice is handed over twice.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] if the field holds no bytes, or if `sorted` does not ascend or names a row that is not there;
    /// [`TableError::Damaged`] if a chunk or a message does not read, or a picture is of a kind that is not read; whatever `each`
    /// returns.
    pub fn visit_pictures<E: From<TableError>>(
        &self,
        name: &str,
        sorted: &[u64],
        each: &mut dyn FnMut(u64, Picture) -> Result<(), E>,
    ) -> Result<(), E> {
        let source = &self.inner.source;
        let Language::Ros(schema) = &self.language else {
            return Err(source
                .mismatch(name, "messages of JSON hold no pictures that are read")
                .into());
        };
        let field =
            PictureField::new(schema, name).map_err(|problem| source.mismatch(name, problem))?;
        check_sorted(source, name, sorted, self.rows())?;
        let mut chunks = Chunks::new(source)?;
        for row in sorted {
            let entry = usize::try_from(*row)
                .ok()
                .and_then(|row| self.entries.get(row));
            let Some(entry) = entry else {
                return Err(source.mismatch(name, format!("no row {row}")).into());
            };
            let picture =
                self.message(&mut chunks, entry, |_, message| field.read(schema, message))?;
            each(*row, picture)?;
        }
        Ok(())
    }

    /// What reads the fields called `names` out of a message.
    #[expect(
        clippy::type_complexity,
        reason = "a closure over one of two languages"
    )]
    fn reader(
        &self,
        names: &[&str],
    ) -> Result<Box<dyn Fn(&[u8]) -> Result<Vec<Cell>, String> + '_>, TableError> {
        match &self.language {
            Language::Ros(schema) => {
                let fields = match Fields::new(schema, names) {
                    Ok(fields) => fields,
                    Err(name) => return Err(self.inner.source.missing(name, self.names()?)),
                };
                Ok(Box::new(move |message| fields.read(schema, message)))
            }
            Language::Json => {
                let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
                Ok(Box::new(move |message| {
                    let cell = json::cell(message)?;
                    let found = |name: &String| cell.at(name).cloned().unwrap_or(Cell::Null);
                    Ok(names.iter().map(found).collect())
                }))
            }
        }
    }

    /// Hands the message at `entry` to `read`.
    fn message<T>(
        &self,
        chunks: &mut Chunks<'_>,
        entry: &Entry,
        read: impl FnOnce(MessageHead, &[u8]) -> Result<T, String>,
    ) -> Result<T, TableError> {
        let source = &self.inner.source;
        let damaged = |problem: String| {
            let place = Place::byte(entry.chunk.unwrap_or(entry.at)).in_name(&self.topic.name);
            let problem = match entry.chunk {
                Some(_) => format!("message at byte {} of the chunk: {problem}", entry.at),
                None => problem,
            };
            source.damaged(place, problem)
        };
        let (held, loose);
        let fields = match entry.chunk {
            Some(chunk) => {
                held = chunks.unpacked(chunk)?;
                let record = usize::try_from(entry.at).ok().and_then(|at| held.get(at..));
                let mut bytes = Bytes::new(record.unwrap_or_default());
                match record::next(&mut bytes) {
                    Some((code::MESSAGE, fields)) => fields,
                    _ => return Err(damaged("its index leads to no message".to_owned())),
                }
            }
            None => {
                loose = chunks.fields(entry.at, code::MESSAGE, u64::MAX)?;
                &loose[..]
            }
        };
        let (head, message) =
            record::message(fields).ok_or_else(|| damaged("it is cut short".to_owned()))?;
        if !self.channels.contains(&head.channel) || head.log_time != entry.log_time {
            return Err(damaged("its index leads to another message".to_owned()));
        }
        read(head, message).map_err(damaged)
    }

    fn unsupported(&self, problem: String) -> TableError {
        self.inner
            .source
            .unsupported(Place::of(&self.topic.name), problem)
    }
}

/// A column that a message's head gives.
type OfHead = fn(&MessageHead) -> Cell;

/// The columns that every topic has.
const TIMES: [(&str, OfHead); 4] = [
    ("log_time", |head| seconds(head.log_time)),
    ("log_time.ns", |head| Cell::Integer(head.log_time.into())),
    ("publish_time", |head| seconds(head.publish_time)),
    ("publish_time.ns", |head| {
        Cell::Integer(head.publish_time.into())
    }),
];

fn seconds(nanoseconds: u64) -> Cell {
    const NANO: u64 = 1_000_000_000;
    Cell::Number(ros::seconds(
        (nanoseconds / NANO).into(),
        (nanoseconds % NANO).into(),
    ))
}

/// What the messages of `channels` are written in: one language, by one schema.
fn language(
    inner: &Inner,
    topic: &Topic,
    contents: &Contents,
    channels: &BTreeSet<u16>,
) -> Result<Language, TableError> {
    let unsupported = |problem: String| inner.source.unsupported(Place::of(&topic.name), problem);
    let mut schemas = channels
        .iter()
        .filter_map(|channel| contents.channels.get(channel))
        .map(|channel| (&channel.encoding, contents.schemas.get(&channel.schema)));
    let Some((encoding, schema)) = schemas.next() else {
        return Err(unsupported("no channel has this topic".to_owned()));
    };
    if schemas.any(|other| other != (encoding, schema)) {
        return Err(unsupported(
            "its channels have different schemas".to_owned(),
        ));
    }
    match (encoding.as_str(), schema) {
        ("json", _) => Ok(Language::Json),
        ("cdr", Some(schema)) if schema.encoding == "ros2msg" => {
            let text = std::str::from_utf8(&schema.text)
                .map_err(|_| unsupported("its schema is no text".to_owned()))?;
            let parsed = RosSchema::parse(&schema.name, text);
            let parsed = parsed.map_err(|problem| {
                unsupported(format!("the schema of {}: {problem}", topic.schema))
            })?;
            Ok(Language::Ros(Arc::new(parsed)))
        }
        (encoding, schema) => {
            let schema = schema.map_or("none", |schema| schema.encoding.as_str());
            Err(unsupported(format!(
                "messages in `{}` by a schema in `{}`, expected `cdr` by `ros2msg`, or `json`",
                crate::error::shown(encoding),
                crate::error::shown(schema)
            )))
        }
    }
}
