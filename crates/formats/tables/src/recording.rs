//! Recordings of messages by topic: MCAP files, rosbag2 databases, ROS 1 bags.

mod embedded_array;
mod json;
mod language;
mod table;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use crate::error::{Place, TableError};
use crate::message::MessageStore;
use crate::source::Source;
use crate::{mcap, rosbag1, rosbag2, sqlite};

pub use self::table::TopicTable;

/// Recording of messages. Each topic is a table of its messages.
///
/// The first bytes determine the format: an MCAP file, a rosbag2 database (`.db3`) or a ROS 1 bag (`.bag`). Opening reads the summary.
/// If there is no summary, it reads the records. Checksums are verified if present; attachments are ignored. Chunks may be compressed
/// by LZ4 or Zstandard, messages of rosbag2 by Zstandard.
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
    /// Name of the message schema, such as `geometry_msgs/msg/WrenchStamped`; empty if there is none.
    pub schema: String,
    /// Encoding of the messages, such as `cdr`.
    pub encoding: String,
    /// Number of messages.
    pub count: u64,
}

impl Recording {
    /// Recording at `path`.
    ///
    /// # Errors
    /// [`TableError::Io`] if the file cannot be read. [`TableError::Damaged`] if it is not a recording, is truncated or has a wrong checksum.
    /// [`TableError::Unsupported`] if it is of a later version, compressed as a whole, or has messages in a separate log.
    /// [`TableError::TooLarge`] if its summary exceeds the limit.
    pub fn open(path: &Path) -> Result<Recording, TableError> {
        let store = store(Source::new(path)?)?;
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
        Ok(Recording { store, topics })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        self.store.source().path()
    }

    /// The topics, by name.
    pub fn topics(&self) -> &[Topic] {
        &self.topics
    }

    /// Messages of the topic `name`.
    ///
    /// # Errors
    /// [`TableError::Missing`] if there is no such topic. [`TableError::Unsupported`] for an incomplete schema or an unsupported encoding
    /// (not ROS 1 or 2, JSON or Foxglove pictures). [`TableError::Damaged`] if the messages in the file differ from its index.
    pub fn table(&self, name: &str) -> Result<TopicTable, TableError> {
        match self.topics.iter().find(|topic| topic.name == name) {
            Some(topic) => TopicTable::new(&self.store, topic.clone()),
            None => {
                let known = self.topics.iter().map(|topic| topic.name.clone()).collect();
                Err(self.store.source().missing(name, known))
            }
        }
    }

    /// Reason why the messages of the topic `name` cannot be read; `None` if they can. Reads no message.
    pub fn why_unread(&self, name: &str) -> Option<String> {
        let topic = self.topics.iter().find(|topic| topic.name == name)?;
        language::of_topic(&*self.store, topic).err()
    }
}

/// Opens the reader for the format of the first bytes.
fn store(source: Source) -> Result<Arc<dyn MessageStore>, TableError> {
    const ZSTANDARD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
    let mut file = source.open()?;
    let begin = source.bytes(&mut file, 0, source.length().min(16), 16)?;
    let begins = |mark: &[u8]| begin.starts_with(mark);
    if begins(&sqlite::MAGIC) {
        return Ok(Arc::new(rosbag2::Rosbag2::open(source)?));
    }
    if begins(&rosbag1::MAGIC) {
        return Ok(Arc::new(rosbag1::Rosbag1::open(source)?));
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
        let problem = "not a recording: it begins like neither MCAP nor SQLite nor a ROS 1 bag";
        return Err(source.damaged(Place::byte(0), problem));
    }
    Ok(Arc::new(mcap::McapFile::open(source)?))
}
