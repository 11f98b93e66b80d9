//! ROS 1 recordings (`.bag`, version 2.0): <http://wiki.ros.org/Bags/Format/2.0>.

mod cut;
mod record;

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::sync::Arc;

use crate::bytes::Bytes;
use crate::codec::{Codec, unpack};
use crate::error::{Place, TableError, shown};
use crate::growth::Growth;
use crate::limits;
use crate::message::{Channel, Entry, Message, MessageReader, MessageStore};
use crate::source::Source;
use cut::{Walk, refusal};
use record::{Head, connection, op};

/// First line of a bag.
pub(crate) const MAGIC: [u8; 13] = *b"#ROSBAG V2.0\n";

/// ROS 1 bag.
#[derive(Debug)]
pub(crate) struct Rosbag1 {
    source: Source,
    channels: BTreeMap<u32, Channel>,
    /// For each connection: the offset of each chunk with its messages, and the offset of the message index of that chunk.
    indices: BTreeMap<u32, Vec<(u64, u64)>>,
    /// Messages of a truncated bag, which replace the indices; `None` for a complete bag.
    before_cut: Option<Walk>,
}

impl Rosbag1 {
    /// Opens the recording in `source`. Reads the heads of all records, but no chunk.
    ///
    /// # Errors
    /// [`TableError::Cut`] if the bag is truncated or was not closed; [`TableError::Damaged`] if its records differ from its stated counts.
    pub(crate) fn open(source: Source) -> Result<Rosbag1, TableError> {
        let mut records = Records::new(&source)?;
        let mut bag = Rosbag1 {
            channels: BTreeMap::new(),
            indices: BTreeMap::new(),
            before_cut: None,
            source: source.clone(),
        };
        let begin = MAGIC.len() as u64;
        let first = records.head(begin)?;
        let announced = first.number::<8>("index_pos").map(u64::from_le_bytes);
        let of_chunks = first.number::<4>("chunk_count").map(u32::from_le_bytes);
        let of_connections = first.number::<4>("conn_count").map(u32::from_le_bytes);
        let (Some(op::BAG), Some(index), Some(of_chunks), Some(of_connections)) =
            (first.op(), announced, of_chunks, of_connections)
        else {
            return Err(source.damaged(
                Place::byte(begin),
                "not a bag: the first record is not a bag header",
            ));
        };
        if index == 0 {
            let problem = "the recorder did not close the bag, which is cut short";
            return Err(refusal(&source, Place::byte(begin), problem.to_owned()));
        }
        if index > source.length() {
            let problem = format!(
                "the index should begin at byte {index}, but the file has {} bytes: the bag is cut short",
                source.length()
            );
            return Err(refusal(&source, Place::byte(begin), problem));
        }
        let (mut chunk, mut chunks) = (None, 0_u32);
        let mut described = 0_u64;
        let mut at = first.end;
        while at < source.length() {
            let head = records.head(at)?;
            match head.op() {
                Some(op::CHUNK) => {
                    chunk = Some(at);
                    chunks += 1;
                }
                Some(op::INDEX) => {
                    let connection = head.number::<4>("conn").map(u32::from_le_bytes);
                    let (Some(connection), Some(chunk)) = (connection, chunk) else {
                        return Err(source.damaged(
                            Place::byte(at),
                            "an index without a connection or before any chunk",
                        ));
                    };
                    bag.indices.entry(connection).or_default().push((chunk, at));
                }
                Some(op::CONNECTION) => {
                    described = described.saturating_add(head.end - at);
                    if described > limits::DESCRIPTION_BYTES {
                        return Err(
                            source.too_large(Place::byte(at), "more connections than are accepted")
                        );
                    }
                    let data = records.data(&head)?;
                    let read = connection(&head, &data);
                    let (number, channel) = read.ok_or_else(|| {
                        source.damaged(Place::byte(at), "a connection without a number or a type")
                    })?;
                    bag.channels.insert(number, channel);
                }
                // Chunk information is not needed. Bags of version 2.0 have no messages outside chunks.
                Some(op::CHUNK_INFO) => {}
                other => {
                    let other =
                        other.map_or_else(|| "none".to_owned(), |code| format!("{code:#04x}"));
                    let problem = format!(
                        "a record of code {other}, expected a chunk, an index or a connection"
                    );
                    return Err(source.damaged(Place::byte(at), problem));
                }
            }
            at = head.end;
        }
        if chunks != of_chunks || bag.channels.len() != of_connections as usize {
            let problem = format!(
                "{chunks} chunks and {} connections, but the bag header states {of_chunks} and {of_connections}: the bag is cut short or was changed",
                bag.channels.len()
            );
            return Err(refusal(&source, Place::byte(begin), problem));
        }
        bag.count(&mut records)?;
        Ok(bag)
    }

    /// Opens the readable messages of the truncated bag in `source`.
    ///
    /// # Errors
    /// [`TableError::Damaged`] for a chunk that cannot be unpacked, [`TableError::TooLarge`] for too many messages.
    pub(crate) fn open_to_cut(source: Source) -> Result<Rosbag1, TableError> {
        let mut walk = Walk::of(&source, true)?;
        Ok(Rosbag1 {
            channels: std::mem::take(&mut walk.channels),
            indices: BTreeMap::new(),
            before_cut: Some(walk),
            source,
        })
    }

    /// Adds up the message counts that the message indices of each connection state.
    fn count(&mut self, records: &mut Records<'_>) -> Result<(), TableError> {
        for (connection, indices) in &self.indices {
            let Some(channel) = self.channels.get_mut(connection) else {
                let problem =
                    format!("messages of connection {connection}, which has no description");
                return Err(self.source.damaged(Place::default(), problem));
            };
            for (_, at) in indices {
                let count = records
                    .head(*at)?
                    .number::<4>("count")
                    .map(u32::from_le_bytes);
                channel.count = channel.count.saturating_add(u64::from(count.unwrap_or(0)));
            }
        }
        Ok(())
    }
}

impl MessageStore for Rosbag1 {
    fn source(&self) -> &Source {
        &self.source
    }

    fn channels(&self) -> &BTreeMap<u32, Channel> {
        &self.channels
    }

    fn cut_at(&self) -> Option<u64> {
        self.before_cut.as_ref().map(|walk| walk.end)
    }

    fn index(&self, channels: &BTreeSet<u32>) -> Result<Vec<Entry>, TableError> {
        if let Some(walk) = &self.before_cut {
            return Ok(walk.entries(channels));
        }
        let mut records = Records::new(&self.source)?;
        let mut entries: Vec<Entry> = Vec::new();
        for (_, indices) in self
            .indices
            .iter()
            .filter(|(number, _)| channels.contains(number))
        {
            for (chunk, at) in indices {
                let head = records.head(*at)?;
                let count = head.number::<4>("count").map(u32::from_le_bytes);
                let data = records.data(&head)?;
                let mut bytes = Bytes::new(&data);
                let wrong = || {
                    self.source.damaged(
                        Place::byte(*at),
                        "an index has another length than it announces",
                    )
                };
                if entries.len() + data.len() / 12 > limits::MESSAGES {
                    let problem = format!("more than {} messages of one topic", limits::MESSAGES);
                    return Err(self.source.too_large(Place::byte(*at), problem));
                }
                for _ in 0..count.unwrap_or(0) {
                    let (Some(seconds), Some(nanoseconds), Some(place)) =
                        (bytes.u32(), bytes.u32(), bytes.u32())
                    else {
                        return Err(wrong());
                    };
                    entries.push(Entry {
                        log_time: u64::from(seconds) * record::NANO + u64::from(nanoseconds),
                        chunk: Some(*chunk),
                        at: u64::from(place),
                    });
                }
                if !bytes.rest().is_empty() {
                    return Err(wrong());
                }
            }
        }
        entries.sort_unstable_by_key(|entry| (entry.log_time, entry.chunk, entry.at));
        Ok(entries)
    }

    fn reader(&self) -> Result<Box<dyn MessageReader + '_>, TableError> {
        Ok(Box::new(Records::new(&self.source)?))
    }
}

/// Reader of the records of a bag with its own cursor. Caches the last chunk.
struct Records<'a> {
    source: &'a Source,
    file: File,
    kept: Option<(u64, Arc<Vec<u8>>)>,
    growth: Growth,
}

impl<'a> Records<'a> {
    fn new(source: &'a Source) -> Result<Records<'a>, TableError> {
        Ok(Records {
            source,
            file: source.open()?,
            kept: None,
            growth: Growth::default(),
        })
    }

    /// Reads the head of the record at the offset `at`. The data of the record must end within the file.
    fn head(&mut self, at: u64) -> Result<Head, TableError> {
        match self.head_within(at)? {
            Ok(head) => Ok(head),
            Err(problem) => {
                let problem = format!("{problem}: the bag is cut short here");
                Err(refusal(self.source, Place::byte(at), problem))
            }
        }
    }

    /// Reads the head of the record at the offset `at`. Returns an error message if the file ends before the record.
    fn head_within(&mut self, at: u64) -> Result<Result<Head, String>, TableError> {
        let mut four = |at: u64| {
            let bytes = self.source.bytes(&mut self.file, at, 4, 4).ok()?;
            Bytes::new(&bytes).u32().map(u64::from)
        };
        let Some(length) = four(at) else {
            return Ok(Err("a record of less than 4 bytes".to_owned()));
        };
        let begin = at + 4;
        let Some(data) = four(begin + length) else {
            return Ok(Err(format!(
                "a record header of {length} bytes, beyond the end of the file"
            )));
        };
        let fields = self
            .source
            .bytes(&mut self.file, begin, length, limits::DESCRIPTION_BYTES)?;
        let data_at = begin + length + 4;
        if data_at + data > self.source.length() {
            return Ok(Err(format!(
                "a record of {data} bytes, beyond the end of the file"
            )));
        }
        let head = Head::new(fields, data_at, data_at + data);
        head.map(Ok).ok_or_else(|| {
            self.source
                .damaged(Place::byte(at), "a header is shorter than its fields")
        })
    }

    /// Reads the data of the record with this head.
    fn data(&mut self, head: &Head) -> Result<Vec<u8>, TableError> {
        let length = head.end - head.data_at;
        self.source
            .bytes(&mut self.file, head.data_at, length, limits::PAGE_BYTES)
    }

    /// Reads the whole record at the offset `at`, from its head `head` to the end of its data.
    fn whole(&mut self, at: u64, head: &Head) -> Result<Vec<u8>, TableError> {
        let length = head.end - at;
        self.source
            .bytes(&mut self.file, at, length, limits::PAGE_BYTES)
    }

    /// Unpacked records of the chunk at the offset `at`. A truncated uncompressed chunk gives the records before the end of the file.
    fn unpacked(&mut self, at: u64) -> Result<Arc<Vec<u8>>, TableError> {
        if let Some((kept, bytes)) = &self.kept
            && *kept == at
        {
            return Ok(Arc::clone(bytes));
        }
        self.kept = None;
        if self.head_within(at)?.is_err()
            && let Some(bytes) = cut::cut_chunk(self, at)
        {
            let bytes = Arc::new(bytes);
            self.kept = Some((at, Arc::clone(&bytes)));
            return Ok(bytes);
        }
        let head = self.head(at)?;
        let place = || Place::byte(at).in_name("chunk");
        let size = head.number::<4>("size").map(u32::from_le_bytes);
        let (Some(op::CHUNK), Some(size)) = (head.op(), size) else {
            return Err(self
                .source
                .damaged(place(), "no chunk, or a chunk without a size"));
        };
        if u64::from(size) > limits::PAGE_BYTES {
            let problem = format!(
                "{size} decompressed bytes, at most {} are accepted",
                limits::PAGE_BYTES
            );
            return Err(self.source.too_large(place(), problem));
        }
        let codec = match head.text("compression").as_deref() {
            Some("none") => Codec::Plain,
            Some("lz4") => Codec::Lz4Frame,
            Some("bz2") => Codec::Bzip2,
            other => {
                let problem = format!(
                    "compressed by `{}`, expected none, lz4 or bz2: decompress it with `rosbag decompress FILE`, or without ROS with \
                     `rosbags-convert --src FILE --dst OUT`",
                    shown(other.unwrap_or_default())
                );
                return Err(self.source.unsupported(place(), problem));
            }
        };
        let packed = self.data(&head)?;
        let grown = self.growth.take(packed.len() as u64, u64::from(size));
        grown.map_err(|problem| self.source.too_large(place(), problem))?;
        let unpacked = unpack(codec, &packed, size as usize);
        let bytes = Arc::new(unpacked.map_err(|problem| self.source.damaged(place(), problem))?);
        self.kept = Some((at, Arc::clone(&bytes)));
        Ok(bytes)
    }
}

impl MessageReader for Records<'_> {
    fn message(&mut self, entry: &Entry) -> Result<Message, TableError> {
        let (held, at) = match entry.chunk {
            Some(chunk) => (self.unpacked(chunk)?, entry.at),
            None => {
                let head = self.head(entry.at)?;
                (Arc::new(self.whole(entry.at, &head)?), 0)
            }
        };
        let damaged = |problem: &str| {
            let problem = format!("message at byte {} of the chunk: {problem}", entry.at);
            let place = Place::byte(entry.chunk.unwrap_or(entry.at));
            self.source.damaged(place.in_name("chunk"), problem)
        };
        let at = usize::try_from(at).unwrap_or(usize::MAX);
        let found = record::within(&held, at);
        let (head, range) =
            found.ok_or_else(|| damaged("its index leads to an incomplete record"))?;
        let connection = head.number::<4>("conn").map(u32::from_le_bytes);
        let (Some(op::MESSAGE), Some(channel), Some(log_time)) =
            (head.op(), connection, head.time_ns())
        else {
            return Err(damaged("its index leads to no message"));
        };
        Ok(Message::new(channel, log_time, log_time, held, range))
    }
}
