//! Recordings in MCAP files.

mod chunks;
mod contents;
mod index;
mod record;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use self::chunks::Chunks;
use self::contents::Contents;
use self::record::code;
use crate::bytes::Bytes;
use crate::error::{Place, TableError};
use crate::message::{Channel, Entry, Message, MessageReader, MessageStore};
use crate::source::Source;

/// First and last eight bytes of an MCAP file.
pub(crate) use self::record::MAGIC;

/// MCAP file, with its contents from its summary, or from all its records if the summary is missing.
#[derive(Debug)]
pub(crate) struct McapFile {
    source: Source,
    contents: Contents,
    channels: BTreeMap<u32, Channel>,
    /// Offset of the end of the complete records, if the file was truncated.
    cut_at: Option<u64>,
}

impl McapFile {
    /// Opens the recording of `source`.
    ///
    /// # Errors
    /// [`TableError::Damaged`] if the file is not an MCAP file or has a wrong checksum; [`TableError::Cut`] if the file is truncated or was not
    /// closed; [`TableError::TooLarge`] if its summary exceeds the limit.
    pub(crate) fn open(source: Source) -> Result<McapFile, TableError> {
        let contents = contents::read(&source)?;
        Ok(McapFile::of(source, contents, None))
    }

    /// Opens the complete chunks and messages of the truncated recording in `source`.
    ///
    /// # Errors
    /// [`TableError::Damaged`] for a chunk with a wrong checksum.
    pub(crate) fn open_to_cut(source: Source) -> Result<McapFile, TableError> {
        let (contents, end) = contents::walk_to_cut(&source)?;
        Ok(McapFile::of(source, contents, Some(end)))
    }

    fn of(source: Source, contents: Contents, cut_at: Option<u64>) -> McapFile {
        let schemas: BTreeMap<u16, Arc<_>> = contents
            .schemas
            .iter()
            .map(|(id, schema)| (*id, Arc::new(schema.clone())))
            .collect();
        let channels = contents.channels.iter().map(|(id, channel)| {
            let described = Channel {
                topic: channel.topic.clone(),
                encoding: channel.encoding.clone(),
                schema: schemas.get(&channel.schema).map(Arc::clone),
                count: contents.counts.get(id).copied().unwrap_or(0),
            };
            (u32::from(*id), described)
        });
        McapFile {
            channels: channels.collect(),
            source,
            contents,
            cut_at,
        }
    }
}

impl MessageStore for McapFile {
    fn source(&self) -> &Source {
        &self.source
    }

    fn channels(&self) -> &BTreeMap<u32, Channel> {
        &self.channels
    }

    fn cut_at(&self) -> Option<u64> {
        self.cut_at
    }

    fn index(&self, channels: &BTreeSet<u32>) -> Result<Vec<Entry>, TableError> {
        let channels = channels.iter().filter_map(|id| u16::try_from(*id).ok());
        index::index(&self.source, &self.contents, &channels.collect())
    }

    fn reader(&self) -> Result<Box<dyn MessageReader + '_>, TableError> {
        Ok(Box::new(Records {
            source: &self.source,
            chunks: Chunks::new(&self.source)?,
        }))
    }
}

/// Reader of the messages of an MCAP file, with its own cursor.
struct Records<'a> {
    source: &'a Source,
    chunks: Chunks<'a>,
}

impl MessageReader for Records<'_> {
    fn message(&mut self, entry: &Entry) -> Result<Message, TableError> {
        let damaged = |problem: &str| {
            let place = Place::byte(entry.chunk.unwrap_or(entry.at));
            let problem = match entry.chunk {
                Some(_) => format!("message at byte {} of the chunk: {problem}", entry.at),
                None => problem.to_owned(),
            };
            self.source.damaged(place, problem)
        };
        let (held, begin) = match entry.chunk {
            Some(chunk) => {
                let held = self.chunks.unpacked(chunk)?;
                let at = usize::try_from(entry.at)
                    .ok()
                    .filter(|at| *at <= held.len());
                let at = at.ok_or_else(|| damaged("its index does not point to a message"))?;
                let mut bytes = Bytes::new(held.get(at..).unwrap_or_default());
                let found = record::next(&mut bytes);
                let Some((code::MESSAGE, fields)) = found else {
                    return Err(damaged("its index does not point to a message"));
                };
                let end = at + bytes.at();
                let fields = end - fields.len()..end;
                (held, fields)
            }
            None => {
                let fields = self.chunks.fields(entry.at, code::MESSAGE, u64::MAX)?;
                let all = 0..fields.len();
                (Arc::new(fields), all)
            }
        };
        let fields = held.get(begin.clone()).unwrap_or_default();
        let (head, body) = record::message(fields).ok_or_else(|| damaged("it is cut short"))?;
        let range = begin.end - body.len()..begin.end;
        let channel = u32::from(head.channel);
        Ok(Message::new(
            channel,
            head.log_time,
            head.publish_time,
            held,
            range,
        ))
    }
}
