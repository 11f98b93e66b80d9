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

/// Channel: the common properties of the messages that one writer sent on one topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Channel {
    pub(crate) topic: String,
    pub(crate) encoding: String,
    pub(crate) schema: Option<Arc<Schema>>,
    /// Number of messages.
    pub(crate) count: u64,
}

/// Time and location of a message. `chunk` is the offset of its chunk or the number of its page, `None` for the file itself. `at` is an offset, or
/// the number of a cell in a page.
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
    /// Creates a message of `channel`. Its content is the byte range `range` of `held`, which messages share.
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

    /// Locations of all messages of `channels`, sorted by time, then by position in the file.
    fn index(&self, channels: &BTreeSet<u32>) -> Result<Vec<Entry>, TableError>;

    /// Opens a reader of messages with its own cursor.
    fn reader(&self) -> Result<Box<dyn MessageReader + '_>, TableError>;
}

/// Reader of the messages of an open file, with its own cursor.
pub(crate) trait MessageReader {
    /// Reads the message at `entry`.
    fn message(&mut self, entry: &Entry) -> Result<Message, TableError>;
}
