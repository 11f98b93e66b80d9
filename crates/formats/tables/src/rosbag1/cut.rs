//! Complete messages of a bag that was truncated or not closed.

use std::collections::{BTreeMap, BTreeSet};

use super::record::{self, connection, op};
use super::{MAGIC, Records};
use crate::error::{Place, TableError};
use crate::limits;
use crate::message::{Channel, Entry};
use crate::source::Source;

/// Messages of a bag, found by reading its records without its index.
#[derive(Debug)]
pub(super) struct Walk {
    pub(super) channels: BTreeMap<u32, Channel>,
    entries: BTreeMap<u32, Vec<Entry>>,
    /// True if the location of each message is stored; false if messages are only counted.
    is_located: bool,
    messages: u64,
    /// Offset of the end of the complete records.
    pub(super) end: u64,
}

/// Error for a bag that is truncated at `place`, with the number of readable messages.
pub(super) fn refusal(source: &Source, place: Place, problem: String) -> TableError {
    match Walk::of(source, false) {
        Ok(walk) => TableError::Cut {
            path: source.path().to_owned(),
            place,
            problem,
            messages: walk.messages,
            remedy: "recover them with `rosbag reindex FILE`",
        },
        Err(error) => error,
    }
}

impl Walk {
    /// Reads the messages of all complete chunks. Also reads an uncompressed last chunk that is truncated, or whose length was never written.
    pub(super) fn of(source: &Source, is_located: bool) -> Result<Walk, TableError> {
        let mut records = Records::new(source)?;
        let mut walk = Walk {
            channels: BTreeMap::new(),
            entries: BTreeMap::new(),
            is_located,
            messages: 0,
            end: MAGIC.len() as u64,
        };
        while let Ok(Ok(head)) = records.head_within(walk.end) {
            let at = walk.end;
            match head.op() {
                Some(op::CHUNK) if head.end > head.data_at => {
                    let chunk = records.unpacked(at)?;
                    walk.add(source, Some(at), &chunk)?;
                }
                Some(op::MESSAGE | op::CONNECTION) => {
                    let record = records.whole(at, &head)?;
                    walk.add(source, None, &record)?;
                }
                Some(_) => {}
                // Zeros that a file system leaves after the last stored bytes.
                None => break,
            }
            walk.end = head.end;
        }
        if let Some(chunk) = cut_chunk(&mut records, walk.end) {
            walk.add(source, Some(walk.end), &chunk)?;
        }
        Ok(walk)
    }

    /// Adds the complete messages of `records`, which are the records of the chunk at the offset `chunk`, or one record outside chunks.
    fn add(
        &mut self,
        source: &Source,
        chunk: Option<u64>,
        records: &[u8],
    ) -> Result<(), TableError> {
        let mut at = 0;
        while let Some((head, data)) = record::within(records, at) {
            let number = head.number::<4>("conn").map(u32::from_le_bytes);
            match (head.op(), number) {
                (Some(op::CONNECTION), _) => {
                    let data = records.get(data.clone()).unwrap_or_default();
                    if let Some((number, channel)) = connection(&head, data) {
                        self.channels.entry(number).or_insert(channel);
                    }
                }
                (Some(op::MESSAGE), Some(number)) => {
                    if let (Some(channel), Some(log_time)) =
                        (self.channels.get_mut(&number), head.time_ns())
                    {
                        channel.count += 1;
                        self.messages += 1;
                        if self.is_located {
                            let at = chunk.map_or(self.end, |_| at as u64);
                            let entry = Entry {
                                log_time,
                                chunk,
                                at,
                            };
                            self.entries.entry(number).or_default().push(entry);
                        }
                    }
                }
                _ => {}
            }
            at = data.end;
        }
        let is_too_many = self.is_located && self.messages > limits::MESSAGES as u64;
        match is_too_many || self.channels.len() > limits::NAMES {
            false => Ok(()),
            true => {
                let problem = format!("more than {} messages before the cut", limits::MESSAGES);
                Err(source.too_large(Place::byte(self.end), problem))
            }
        }
    }

    /// Locations of the messages of `channels`, sorted by time.
    pub(super) fn entries(&self, channels: &BTreeSet<u32>) -> Vec<Entry> {
        let own = self.entries.iter();
        let own = own.filter(|(number, _)| channels.contains(number));
        let mut entries: Vec<Entry> = own.flat_map(|(_, entries)| entries).copied().collect();
        entries.sort_unstable_by_key(|entry| {
            (entry.log_time, entry.chunk.unwrap_or(entry.at), entry.at)
        });
        entries
    }
}

/// Bytes of the truncated chunk at the offset `at`; `None` if the chunk is compressed.
pub(super) fn cut_chunk(records: &mut Records<'_>, at: u64) -> Option<Vec<u8>> {
    let length = records.source.length();
    let four = |records: &mut Records<'_>, at: u64| {
        let bytes = records.source.bytes(&mut records.file, at, 4, 4).ok()?;
        Some(u64::from(u32::from_le_bytes(bytes.try_into().ok()?)))
    };
    let fields_at = at + 4;
    let fields = four(records, at)?;
    let data_at = fields_at + fields + 4;
    four(records, fields_at + fields)?;
    let most = limits::DESCRIPTION_BYTES;
    let fields = records
        .source
        .bytes(&mut records.file, fields_at, fields, most)
        .ok()?;
    let head = record::Head::new(fields, data_at, length)?;
    let is_plain = head.text("compression").as_deref() == Some("none");
    (head.op() == Some(op::CHUNK) && is_plain).then(|| records.data(&head).ok())?
}
