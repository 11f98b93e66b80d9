//! Recordings of messages by topic: MCAP files, rosbag2 databases, ROS 1 bags.

mod embedded_array;
mod json;
mod language;
mod table;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use crate::error::{Place, TableError};
use crate::mcap::{self, McapFile};
use crate::message::MessageStore;
use crate::rosbag1::{self, Rosbag1};
use crate::rosbag2::Rosbag2;
use crate::source::Source;
use crate::sqlite;

pub use self::table::TopicTable;

/// Recording of messages by topic. Each topic is a table of its messages.
///
/// The first bytes determine the format: an MCAP file, a rosbag2 database (`.db3`) or a ROS 1 bag (`.bag`). Opening reads the summary, or all records if the
/// summary is missing. Checksums are verified if present; attachments are ignored. Chunks may be compressed with LZ4 or Zstandard, messages of rosbag2 with
/// Zstandard.
///
/// ```
/// use taceva_tables::Recording;
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.mcap");
/// let recording = Recording::open(path.as_ref())?;
/// let topics: Vec<_> = recording.topics().iter().map(|topic| (topic.name.as_str(), topic.count)).collect();
/// assert_eq!(topics, [("/ft/wrench", 3), ("/tactile/image_raw", 1)]);
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Recording {
    store: Arc<dyn MessageStore>,
    topics: Vec<Topic>,
}

/// Topic of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Topic {
    /// Name, such as `/ft/wrench`.
    pub name: String,
    /// Name of the message schema, such as `geometry_msgs/msg/WrenchStamped`; empty without a schema.
    pub schema: String,
    /// Encoding of the messages, such as `cdr`.
    pub encoding: String,
    /// Number of messages.
    pub count: u64,
}

impl Recording {
    /// Opens the recording at `path`.
    ///
    /// # Errors
    /// [`TableError::Io`] if the file cannot be read; [`TableError::Damaged`] if the file is not a recording or has a wrong checksum.
    /// [`TableError::Cut`] if the recording is truncated or was not closed. [`TableError::Unsupported`] if the recording has a later version, is
    /// compressed as a whole, or has messages in a separate log. [`TableError::TooLarge`] if its summary exceeds the limit.
    pub fn open(path: &Path) -> Result<Recording, TableError> {
        Ok(Recording::of_store(store(Source::new(path)?, false)?))
    }

    /// Opens the recording at `path` like [`open`](Self::open), but reads the complete messages of a recording that was truncated or not closed.
    ///
    /// Messages of an incomplete chunk are read only from an uncompressed chunk of a ROS 1 bag. Complete recordings are read by their index.
    ///
    /// # Errors
    /// Errors of [`open`](Self::open); [`TableError::Cut`] only if no message is complete.
    ///
    /// ```
    /// use taceva_tables::{Recording, TableError};
    /// # let whole = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.mcap");
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("cut.mcap");
    /// let bytes = std::fs::read(whole)?;
    /// std::fs::write(&path, &bytes[..bytes.len() - 40])?;
    /// assert!(matches!(Recording::open(&path), Err(TableError::Cut { messages: 4, .. })));
    /// let recording = Recording::open_to_cut(&path)?;
    /// assert!(recording.cut_at().is_some());
    /// assert_eq!(recording.table("/ft/wrench")?.rows(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn open_to_cut(path: &Path) -> Result<Recording, TableError> {
        Ok(Recording::of_store(store(Source::new(path)?, true)?))
    }

    fn of_store(store: Arc<dyn MessageStore>) -> Recording {
        let mut topics: BTreeMap<&str, Topic> = BTreeMap::new();
        for channel in store.channels().values() {
            let schema = channel.schema.as_ref();
            let topic = topics.entry(&channel.topic).or_insert_with(|| Topic {
                name: channel.topic.clone(),
                schema: schema.map_or_else(String::new, |schema| schema.name.clone()),
                encoding: channel.encoding.clone(),
                count: 0,
            });
            topic.count = topic.count.saturating_add(channel.count);
        }
        let topics = topics.into_values().collect();
        Recording { store, topics }
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        self.store.source().path()
    }

    /// Offset of the end of the complete records of a truncated recording, bytes; `None` for a complete recording.
    pub fn cut_at(&self) -> Option<u64> {
        self.store.cut_at()
    }

    /// Topics of the recording, sorted by name.
    pub fn topics(&self) -> &[Topic] {
        &self.topics
    }

    /// Table of the messages of the topic `name`.
    ///
    /// # Errors
    /// [`TableError::Missing`] if the topic does not exist. [`TableError::Unsupported`] for an incomplete schema or an unsupported encoding (not ROS 1 or 2,
    /// JSON or Foxglove pictures). [`TableError::Damaged`] if the messages in the file differ from the index.
    pub fn table(&self, name: &str) -> Result<TopicTable, TableError> {
        match self.topics.iter().find(|topic| topic.name == name) {
            Some(topic) => TopicTable::new(&self.store, topic.clone()),
            None => {
                let known = self.topics.iter().map(|topic| topic.name.clone()).collect();
                Err(self.store.source().missing(name, known))
            }
        }
    }

    /// Reason why the messages of the topic `name` cannot be read; `None` if their type is supported. Does not read messages.
    pub fn why_unread(&self, name: &str) -> Option<String> {
        let topic = self.topics.iter().find(|topic| topic.name == name)?;
        language::of_topic(&*self.store, topic).err()
    }
}

/// Opens a recording by `open`. With `is_to_cut`, opens the readable part of a truncated file by `to_cut` if it has a complete message.
fn opened<S: MessageStore + 'static>(
    source: Source,
    is_to_cut: bool,
    open: fn(Source) -> Result<S, TableError>,
    to_cut: fn(Source) -> Result<S, TableError>,
) -> Result<Arc<dyn MessageStore>, TableError> {
    let store = match open(source.clone()) {
        Err(TableError::Cut { messages: 1.., .. }) if is_to_cut => to_cut(source)?,
        other => other?,
    };
    Ok(Arc::new(store))
}

/// Opens the reader of the format that the first bytes indicate. With `is_to_cut`, the complete messages of a truncated file are read.
fn store(source: Source, is_to_cut: bool) -> Result<Arc<dyn MessageStore>, TableError> {
    const ZSTANDARD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
    let mut file = source.open()?;
    let begin = source.bytes(&mut file, 0, source.length().min(16), 16)?;
    let begins = |mark: &[u8]| begin.starts_with(mark);
    if begins(&sqlite::MAGIC) {
        return opened(source, is_to_cut, Rosbag2::open, Rosbag2::open_to_cut);
    }
    if begins(&rosbag1::MAGIC) {
        return opened(source, is_to_cut, Rosbag1::open, Rosbag1::open_to_cut);
    }
    if begins(b"#ROSBAG V") && rosbag1::MAGIC.starts_with(&begin) {
        return Err(source.damaged(
            Place::byte(0),
            "a ROS 1 bag that is cut short in its first line",
        ));
    }
    if begins(b"#ROSBAG V") {
        let problem =
            "a bag of another version than 2.0: convert it with `rosbag fix FILE OUT.bag` of ROS 1";
        return Err(source.unsupported(Place::byte(0), problem));
    }
    if begins(&ZSTANDARD) {
        let problem =
            "the whole file is compressed by Zstandard: decompress it with `zstd -d FILE`";
        return Err(source.unsupported(Place::byte(0), problem));
    }
    if !begins(&mcap::MAGIC) {
        let problem = "not a recording, expected a file of MCAP or SQLite, or a ROS 1 bag";
        return Err(source.damaged(Place::byte(0), problem));
    }
    opened(source, is_to_cut, McapFile::open, McapFile::open_to_cut)
}
