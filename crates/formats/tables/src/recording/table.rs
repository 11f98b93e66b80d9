//! Table of the messages of one topic, one row per message.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use super::Topic;
use super::json;
use super::language::{self, Language, Reader};
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::limits;
use crate::message::{Entry, Message, MessageReader, MessageStore};
use crate::ros::{self, Picture};
use crate::rows::check_sorted;
use crate::source::Source;

/// Messages of one topic, sorted by log time, then by position in the file.
///
/// Columns are the fields of the messages by dotted name (`wrench.force.x`, `position[2]`), and the times of each message.
/// `log_time` and `publish_time` are in seconds, `log_time.ns` and `publish_time.ns` in whole nanoseconds. A time field is also one
/// number: `header.stamp` in seconds and `header.stamp.ns` in nanoseconds. Its members are `sec` and `nanosec`.
///
/// ```
/// use taceva_tables::{Cell, Recording};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.mcap");
/// let force = Recording::open(path.as_ref())?.table("/ft/wrench")?;
/// assert_eq!(force.rows(), 3);
/// let columns = force.columns(&["header.stamp.ns", "wrench.force.z"])?;
/// assert_eq!(columns[0][1], Cell::Integer(1_700_000_000_500_000_000));
/// assert_eq!(columns[1], [Cell::Number(2.0), Cell::Number(3.5), Cell::Number(1.25)]);
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TopicTable {
    store: Arc<dyn MessageStore>,
    topic: Topic,
    channels: BTreeSet<u32>,
    language: Language,
    entries: Arc<Vec<Entry>>,
}

impl TopicTable {
    pub(super) fn new(
        store: &Arc<dyn MessageStore>,
        topic: Topic,
    ) -> Result<TopicTable, TableError> {
        let language = language::of_topic(&**store, &topic);
        let language = language.map_err(|problem| {
            let place = Place::of(&topic.name);
            store.source().unsupported(place, problem)
        })?;
        let channels = language::channels(&**store, &topic);
        let entries = store.index(&channels)?;
        Ok(TopicTable {
            store: Arc::clone(store),
            topic,
            channels,
            language,
            entries: Arc::new(entries),
        })
    }

    fn source(&self) -> &Source {
        self.store.source()
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        self.source().path()
    }

    /// Topic of the messages.
    pub fn topic(&self) -> &Topic {
        &self.topic
    }

    /// Number of messages.
    pub fn rows(&self) -> u64 {
        self.entries.len() as u64
    }

    /// Names of the columns: the times, then the fields in the order of the schema. A list is one column. Of JSON messages, the first determines the
    /// fields.
    ///
    /// # Errors
    /// [`TableError::Unsupported`] if the schema has too many fields. For JSON, errors of [`columns`](Self::columns).
    pub fn names(&self) -> Result<Vec<String>, TableError> {
        let mut names: Vec<String> = TIMES.iter().map(|(name, _)| (*name).to_owned()).collect();
        let fields = language::names(&self.language);
        names.extend(fields.map_err(|problem| self.unsupported(problem))?);
        if let (Language::Json, Some(first)) = (&self.language, self.entries.first()) {
            let mut reader = self.store.reader()?;
            self.message(&mut *reader, first, |message| {
                let cell = json::cell(message.bytes())?;
                json::add_names(&cell, "", &mut names);
                Ok(())
            })?;
        }
        Ok(names)
    }

    /// Fields of the first JSON message that state the shape of an array but contain no numbers.
    ///
    /// # Errors
    /// Errors of [`names`](Self::names).
    ///
    /// ```no_run
    /// # fn of(table: &taceva_tables::TopicTable) -> Result<(), taceva_tables::TableError> {
    /// for field in table.absent_arrays()? {
    ///     println!("{field}: a summary alone");
    /// }
    /// # Ok(())
    /// # }
    /// ```
    pub fn absent_arrays(&self) -> Result<Vec<String>, TableError> {
        let mut names = Vec::new();
        if let (Language::Json, Some(first)) = (&self.language, self.entries.first()) {
            let mut reader = self.store.reader()?;
            self.message(&mut *reader, first, |message| {
                json::add_absent_arrays(&json::cell(message.bytes())?, "", &mut names);
                Ok(())
            })?;
        }
        Ok(names)
    }

    /// Cells of the columns `names`, column by column. The file is read once for all columns.
    ///
    /// # Errors
    /// [`TableError::Missing`] if a field does not exist. [`TableError::TooLarge`] if the cells exceed 96 to 320 MiB of memory, depending on the file size.
    /// [`TableError::Damaged`] if a chunk or a message cannot be parsed.
    pub fn columns(&self, names: &[&str]) -> Result<Vec<Vec<Cell>>, TableError> {
        let is_time = |name: &&str| TIMES.iter().any(|(time, _)| time == name);
        let of_message: Vec<&str> = names
            .iter()
            .copied()
            .filter(|name| !is_time(name))
            .collect();
        let read = self.reader(&of_message)?;
        let most = limits::column_bytes(self.source().length());
        let too_large = || {
            let problem = format!("more than {most} bytes in memory; read fewer fields");
            self.source()
                .too_large(Place::of(&self.topic.name), problem)
        };
        let least = (names.len() as u64)
            .saturating_mul(self.rows())
            .saturating_mul(size_of::<Cell>() as u64);
        if least > most {
            return Err(too_large());
        }
        let mut columns = vec![vec![Cell::Null; self.entries.len()]; names.len()];
        let mut bytes = 0_u64;
        // In the order of the file: every chunk is unpacked once.
        let mut order: Vec<usize> = (0..self.entries.len()).collect();
        order.sort_by_key(|row| {
            (
                self.entries[*row].chunk.unwrap_or(self.entries[*row].at),
                self.entries[*row].at,
            )
        });
        let mut reader = self.store.reader()?;
        for row in order {
            self.message(&mut *reader, &self.entries[row], |message| {
                let mut cells = match of_message.is_empty() {
                    true => Vec::new(),
                    false => read(message.bytes())?,
                }
                .into_iter();
                for (column, name) in columns.iter_mut().zip(names) {
                    let cell = match TIMES.iter().find(|(time, _)| time == name) {
                        Some((_, time)) => Some(time(message)),
                        None => cells.next(),
                    };
                    let cell = cell.unwrap_or(Cell::Null);
                    bytes = bytes.saturating_add(cell.bytes());
                    column[row] = cell;
                }
                Ok(())
            })?;
            if bytes > most {
                return Err(too_large());
            }
        }
        Ok(columns)
    }

    /// Cells of the column `name`. See [`columns`](Self::columns).
    ///
    /// # Errors
    /// Errors of [`columns`](Self::columns).
    pub fn column(&self, name: &str) -> Result<Vec<Cell>, TableError> {
        Ok(self.columns(&[name])?.pop().unwrap_or_default())
    }

    /// Calls `each` with each row of `sorted` and the picture in the field `name`, such as `data` of `sensor_msgs/Image` and
    /// `sensor_msgs/CompressedImage`. Keeps at most two chunks in memory.
    ///
    /// `sorted` must be ascending. A row listed twice is passed twice.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] if the field has no bytes, or if `sorted` is not ascending or contains a row that does not exist. [`TableError::Damaged`] if a
    /// chunk or message cannot be parsed, or a picture is of an unsupported kind. Errors of `each`.
    pub fn visit_pictures<E: From<TableError>>(
        &self,
        name: &str,
        sorted: &[u64],
        each: &mut dyn FnMut(u64, Picture) -> Result<(), E>,
    ) -> Result<(), E> {
        let source = self.source();
        let read = self.language.pictures(name);
        let read = read.map_err(|problem| source.mismatch(name, problem))?;
        check_sorted(source, name, sorted, self.rows())?;
        let mut reader = self.store.reader()?;
        for row in sorted {
            let entry = usize::try_from(*row)
                .ok()
                .and_then(|row| self.entries.get(row));
            let Some(entry) = entry else {
                return Err(source.mismatch(name, format!("no row {row}")).into());
            };
            let picture = self.message(&mut *reader, entry, |message| read(message.bytes()))?;
            each(*row, picture)?;
        }
        Ok(())
    }

    /// Reader of the fields `names`.
    fn reader<'a>(&'a self, names: &[&'a str]) -> Result<Reader<'a>, TableError> {
        match self.language.reader(names) {
            Ok(reader) => Ok(reader),
            Err(name) => Err(self.source().missing(name, self.names()?)),
        }
    }

    /// Calls `read` with the message at the location `entry`.
    fn message<T>(
        &self,
        reader: &mut dyn MessageReader,
        entry: &Entry,
        read: impl FnOnce(&Message) -> Result<T, String>,
    ) -> Result<T, TableError> {
        let damaged = |problem: String| {
            let place = Place::byte(entry.chunk.unwrap_or(entry.at)).in_name(&self.topic.name);
            let problem = match entry.chunk {
                Some(_) => format!("message at byte {} of the chunk: {problem}", entry.at),
                None => problem,
            };
            self.source().damaged(place, problem)
        };
        let message = reader.message(entry)?;
        if !self.channels.contains(&message.channel) || message.log_time != entry.log_time {
            return Err(damaged("its index leads to another message".to_owned()));
        }
        read(&message).map_err(damaged)
    }

    fn unsupported(&self, problem: String) -> TableError {
        let place = Place::of(&self.topic.name);
        self.source().unsupported(place, problem)
    }
}

/// Function that returns the value of a time column for a message.
type OfHead = fn(&Message) -> Cell;

/// Time columns of every topic.
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
