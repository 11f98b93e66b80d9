//! Recordings in MCAP files.

mod chunks;
mod contents;
mod index;
mod json;
mod record;
mod table;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use self::contents::Contents;
use crate::error::TableError;
use crate::source::Source;

pub use self::table::McapTable;

/// A recording in an MCAP file: topics, each a table of its messages.
///
/// Opening reads the summary, or walks over the records of a file that has none. The sums of the data, the summary and of every chunk
/// that is read are checked, where the file has them; attachments are not looked at. Chunks may be compressed by LZ4 or Zstandard.
///
/// ```
/// use taceva_tables::Mcap;
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.mcap");
/// let recording = Mcap::open(path.as_ref())?;
/// let topics: Vec<_> = recording.topics().iter().map(|topic| (topic.name.as_str(), topic.count)).collect();
/// assert_eq!(topics, [("/ft/wrench", 3), ("/tactile/image_raw", 1)]);
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Mcap {
    inner: Arc<Inner>,
    topics: Vec<Topic>,
}

#[derive(Debug)]
struct Inner {
    source: Source,
    contents: Contents,
}

/// A topic of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Topic {
    /// Its name, as `/ft/wrench`.
    pub name: String,
    /// The name of the schema of its messages, as `geometry_msgs/msg/WrenchStamped`; empty where there is none.
    pub schema: String,
    /// How its messages are written, as `cdr`.
    pub encoding: String,
    /// How many messages there are.
    pub count: u64,
}

impl Mcap {
    /// The recording at `path`.
    ///
    /// # Errors
    /// [`TableError::Io`] if the file cannot be read, [`TableError::Damaged`] if it is no MCAP file, is cut short or has another sum than
    /// it states, [`TableError::TooLarge`] if its summary is larger than is accepted.
    pub fn open(path: &Path) -> Result<Mcap, TableError> {
        let source = Source::new(path)?;
        let contents = contents::read(&source)?;
        let mut topics: BTreeMap<&str, Topic> = BTreeMap::new();
        for (id, channel) in &contents.channels {
            let schema = contents.schemas.get(&channel.schema);
            let topic = topics.entry(&channel.topic).or_insert_with(|| Topic {
                name: channel.topic.clone(),
                schema: schema.map_or_else(String::new, |schema| schema.name.clone()),
                encoding: channel.encoding.clone(),
                count: 0,
            });
            let more = contents.counts.get(id).copied().unwrap_or(0);
            topic.count = topic.count.saturating_add(more);
        }
        let topics = topics.into_values().collect();
        let inner = Arc::new(Inner { source, contents });
        Ok(Mcap { inner, topics })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        self.inner.source.path()
    }

    /// The topics, by name.
    pub fn topics(&self) -> &[Topic] {
        &self.topics
    }

    /// The messages of the topic called `name`.
    ///
    /// # Errors
    /// [`TableError::Missing`] if there is no such topic, [`TableError::Unsupported`] if its messages are in another encoding than CDR of
    /// ROS 2 or JSON, or their schema leaves something out; [`TableError::Damaged`] if the file holds other messages than it states.
    pub fn table(&self, name: &str) -> Result<McapTable, TableError> {
        match self.topics.iter().find(|topic| topic.name == name) {
            Some(topic) => McapTable::new(&self.inner, topic.clone()),
            None => {
                let known = self.topics.iter().map(|topic| topic.name.clone()).collect();
                Err(self.inner.source.missing(name, known))
            }
        }
    }
}
