//! Messages of a recording by topic, in any file format.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::error::TableError;
use crate::source::Source;

/// Schema of the messages of a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Schema {
    pub(crate) name: String,
    pub(crate) encoding: String,
    pub(crate) text: Vec<u8>,
}

/// Common properties of the messages that one writer sent on one topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Channel {
    pub(crate) topic: String,
    pub(crate) encoding: String,
    pub(crate) schema: Option<Arc<Schema>>,
    /// Number of messages.
    pub(crate) count: u64,
}

/// Location of a message: its time, its chunk or page (`None` if directly in the file), and the byte range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    pub(crate) log_time: u64,
    pub(crate) chunk: Option<u64>,
    pub(crate) at: u64,
}

/// Message: channel, log and publish times in ns, and content.
#[derive(Clone, Debug)]
pub(crate) struct Message {
    pub(crate) channel: u32,
    pub(crate) log_time: u64,
    pub(crate) publish_time: u64,
    held: Arc<Vec<u8>>,
    range: Range<usize>,
}

impl Message {
    /// Message of `channel` whose content is the range `range` of the shared bytes `held`.
    pub(crate) fn new(
        channel: u32,
        log_time: u64,
        publish_time: u64,
        held: Arc<Vec<u8>>,
        range: Range<usize>,
    ) -> Message {
        Message {
            channel,
            log_time,
            publish_time,
            held,
            range,
        }
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        self.held.get(self.range.clone()).unwrap_or_default()
    }
}

/// File format that stores messages.
pub(crate) trait MessageStore: fmt::Debug + Send + Sync {
    fn source(&self) -> &Source;

    /// Channels, by number.
    fn channels(&self) -> &BTreeMap<u32, Channel>;

    /// Offset of the end of the complete records of a truncated file; `None` for a complete file.
    fn cut_at(&self) -> Option<u64>;

    /// All messages of `channels`, sorted by time, then by position in the file.
    fn index(&self, channels: &BTreeSet<u32>) -> Result<Vec<Entry>, TableError>;

    /// Opens a reader of messages with its own cursor.
    fn reader(&self) -> Result<Box<dyn MessageReader + '_>, TableError>;
}

/// Reader of messages with its own cursor.
pub(crate) trait MessageReader {
    /// Reads the message at `entry`.
    fn message(&mut self, entry: &Entry) -> Result<Message, TableError>;
}
