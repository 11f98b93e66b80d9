//! Messages of a stream, and locations of the buffers of a record batch.

use std::fs::File;

use crate::codec::Codec;
use crate::error::{Place, TableError};
use crate::flatbuffer::Table;
use crate::limits;
use crate::source::Source;

/// Type number of a schema message. `RECORDS` is that of a record batch.
pub(super) const SCHEMA: u8 = 1;
pub(super) const RECORDS: u8 = 3;
/// Marker before the length of a message, since Arrow 0.15.
const CONTINUED: u32 = u32::MAX;

/// Message of an Arrow stream: its metadata, and the location of its body.
pub(super) struct Message {
    /// Offset of the message in the file, bytes.
    pub(super) at: u64,
    pub(super) kind: u8,
    metadata: Vec<u8>,
    body: u64,
    body_bytes: u64,
}

impl Message {
    /// Reads the message at `at` and advances `at` past it. Returns `None` at the marker that ends the stream.
    pub(super) fn next(
        source: &Source,
        file: &mut File,
        at: &mut u64,
    ) -> Result<Option<Message>, TableError> {
        let begin = *at;
        if begin >= source.length() {
            let problem =
                "the Arrow stream has no end marker: it is cut short, or its writer was not closed";
            return Err(source.damaged(Place::byte(begin), problem));
        }
        let mut word = |at: u64| {
            let word = source.bytes(file, at, 4, 4)?;
            Ok::<u32, TableError>(word.first_chunk().copied().map_or(0, u32::from_le_bytes))
        };
        let (length, start) = match word(begin)? {
            CONTINUED => (word(begin + 4)?, begin + 8),
            length => (length, begin + 4),
        };
        if length == 0 {
            return Ok(None);
        }
        let length = u64::from(length);
        let metadata = source.bytes(file, start, length, limits::DESCRIPTION_BYTES)?;
        let read = Table::root(&metadata).and_then(|message| {
            let bytes = message.long(3).unwrap_or(0);
            Some((message.byte(1)?, u64::try_from(bytes).ok()?))
        });
        let Some((kind, body_bytes)) = read else {
            let problem = "not an Arrow message";
            return Err(source.damaged(Place::byte(begin), problem));
        };
        let body = start + length;
        let end = body.checked_add(body_bytes);
        let Some(end) = end.filter(|end| *end <= source.length()) else {
            let problem = format!(
                "a batch of {body_bytes} bytes, but the file ends {} bytes after its beginning",
                source.length() - body
            );
            return Err(source.damaged(Place::byte(begin), problem));
        };
        *at = end;
        Ok(Some(Message {
            at: begin,
            kind,
            metadata,
            body,
            body_bytes,
        }))
    }

    pub(super) fn header(&self) -> Result<Table<'_>, String> {
        let header = Table::root(&self.metadata).and_then(|message| message.table(2));
        header.ok_or_else(|| "a message without its header".to_owned())
    }
}

/// Record batch: rows stored column by column.
#[derive(Debug)]
pub(super) struct Batch {
    /// Number of the first row in the table.
    pub(super) first: u64,
    pub(super) rows: u64,
    /// Offset in the file and length of each buffer, bytes.
    pub(super) buffers: Vec<Buffer>,
    pub(super) codec: Option<Codec>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Buffer {
    pub(super) at: u64,
    pub(super) bytes: u64,
}

impl Batch {
    /// Parses the record batch in a message. Each batch of the schema has `buffers` buffers.
    pub(super) fn new(message: &Message, first: u64, buffers: usize) -> Result<Batch, String> {
        let header = message.header()?;
        let rows =
            u64::try_from(header.long(0).unwrap_or(0)).map_err(|_| "a negative number of rows")?;
        let written = header.elements(2, 16).unwrap_or_default();
        let written = written.chunks_exact(16).map(|buffer| {
            let number = |at: usize| buffer[at..].first_chunk().copied().map(u64::from_le_bytes);
            let (offset, bytes) = number(0).zip(number(8)).unwrap_or_default();
            let end = offset.checked_add(bytes);
            match end.is_some_and(|end| end <= message.body_bytes) {
                true => Ok(Buffer {
                    at: message.body + offset,
                    bytes,
                }),
                false => Err(format!(
                    "a buffer has {bytes} bytes from byte {offset}, but the body has {}",
                    message.body_bytes
                )),
            }
        });
        let written = written.collect::<Result<Vec<Buffer>, String>>()?;
        if written.len() != buffers {
            return Err(format!(
                "{} buffers, but its schema needs {buffers}",
                written.len()
            ));
        }
        let codec = match header.table(3).map(|packed| packed.byte(0).unwrap_or(0)) {
            None => None,
            Some(0) => Some(Codec::Lz4Frame),
            Some(1) => Some(Codec::Zstd),
            Some(other) => return Err(format!("the compression is {other}, expected 0 or 1")),
        };
        Ok(Batch {
            first,
            rows,
            buffers: written,
            codec,
        })
    }
}
