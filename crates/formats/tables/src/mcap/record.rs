//! MCAP records: a code, a length, and fields of little-endian numbers, texts and maps.

use std::collections::BTreeMap;

use crate::bytes::Bytes;
use crate::message::Schema;

/// First and last eight bytes of an MCAP file.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";
/// Size of the head of a record, which is its code and its length, bytes.
pub(super) const HEAD: u64 = 9;
/// Size of the footer record, bytes.
pub(super) const FOOTER: u64 = HEAD + 20;

/// Type codes of the supported MCAP records.
pub(super) mod code {
    pub(in crate::mcap) const FOOTER: u8 = 0x02;
    pub(in crate::mcap) const SCHEMA: u8 = 0x03;
    pub(in crate::mcap) const CHANNEL: u8 = 0x04;
    pub(in crate::mcap) const MESSAGE: u8 = 0x05;
    pub(in crate::mcap) const CHUNK: u8 = 0x06;
    pub(in crate::mcap) const MESSAGE_INDEX: u8 = 0x07;
    pub(in crate::mcap) const CHUNK_INDEX: u8 = 0x08;
    pub(in crate::mcap) const STATISTICS: u8 = 0x0b;
    pub(in crate::mcap) const DATA_END: u8 = 0x0f;
}

/// Channel of an MCAP file: the common properties of the messages that one writer sent on one topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Channel {
    pub(super) schema: u16,
    pub(super) topic: String,
    pub(super) encoding: String,
}

/// Fields of an MCAP message record that precede the content.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MessageHead {
    pub(super) channel: u16,
    pub(super) log_time: u64,
    pub(super) publish_time: u64,
}

/// Fields of an MCAP chunk record that precede the packed records.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ChunkHead {
    pub(super) unpacked: u64,
    pub(super) crc: u32,
    pub(super) codec: String,
    pub(super) packed: u64,
}

/// Location of a chunk and of its message indices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ChunkIndex {
    pub(super) at: u64,
    pub(super) length: u64,
    pub(super) indices: BTreeMap<u16, u64>,
}

impl ChunkIndex {
    /// Offset of the end of the chunk; `None` if it exceeds 64 bits.
    pub(super) fn end(&self) -> Option<u64> {
        self.at.checked_add(self.length)
    }
}

/// Statistics record: numbers of messages, schemas, channels and chunks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Statistics {
    pub(super) messages: u64,
    pub(super) schemas: u16,
    pub(super) channels: u32,
    pub(super) chunks: u32,
    pub(super) of_channel: BTreeMap<u16, u64>,
}

/// Takes the next record from `bytes`: its code and its fields. `None` if the record is truncated.
pub(super) fn next<'a>(bytes: &mut Bytes<'a>) -> Option<(u8, &'a [u8])> {
    let code = bytes.u8()?;
    let length = usize::try_from(bytes.u64()?).ok()?;
    Some((code, bytes.take(length)?))
}

pub(super) fn schema(fields: &[u8]) -> Option<(u16, Schema)> {
    let mut bytes = Bytes::new(fields);
    let id = bytes.u16()?;
    let (name, encoding) = (text(&mut bytes)?, text(&mut bytes)?);
    let length = usize::try_from(bytes.u32()?).ok()?;
    let text = bytes.take(length)?.to_vec();
    Some((
        id,
        Schema {
            name,
            encoding,
            text,
        },
    ))
}

pub(super) fn channel(fields: &[u8]) -> Option<(u16, Channel)> {
    let mut bytes = Bytes::new(fields);
    let (id, schema) = (bytes.u16()?, bytes.u16()?);
    let (topic, encoding) = (text(&mut bytes)?, text(&mut bytes)?);
    Some((
        id,
        Channel {
            schema,
            topic,
            encoding,
        },
    ))
}

/// Parses the fields of a message record to its head and its content.
pub(super) fn message(fields: &[u8]) -> Option<(MessageHead, &[u8])> {
    let mut bytes = Bytes::new(fields);
    let channel = bytes.u16()?;
    let _sequence = bytes.u32()?;
    let head = MessageHead {
        channel,
        log_time: bytes.u64()?,
        publish_time: bytes.u64()?,
    };
    Some((head, bytes.rest()))
}

/// Parses the head of a chunk record. Also returns the size of the head in bytes.
pub(super) fn chunk(fields: &[u8]) -> Option<(ChunkHead, usize)> {
    let mut bytes = Bytes::new(fields);
    let _times = (bytes.u64()?, bytes.u64()?);
    let head = ChunkHead {
        unpacked: bytes.u64()?,
        crc: bytes.u32()?,
        codec: text(&mut bytes)?,
        packed: bytes.u64()?,
    };
    Some((head, bytes.at()))
}

pub(super) fn chunk_index(fields: &[u8]) -> Option<ChunkIndex> {
    let mut bytes = Bytes::new(fields);
    let _times = (bytes.u64()?, bytes.u64()?);
    Some(ChunkIndex {
        at: bytes.u64()?,
        length: bytes.u64()?,
        indices: counts(&mut bytes)?,
    })
}

pub(super) fn statistics(fields: &[u8]) -> Option<Statistics> {
    let mut bytes = Bytes::new(fields);
    let (messages, schemas, channels) = (bytes.u64()?, bytes.u16()?, bytes.u32()?);
    let _attachments_and_metadata = (bytes.u32()?, bytes.u32()?);
    let chunks = bytes.u32()?;
    let _times = (bytes.u64()?, bytes.u64()?);
    Some(Statistics {
        messages,
        schemas,
        channels,
        chunks,
        of_channel: counts(&mut bytes)?,
    })
}

/// Parses the message index of one channel in a chunk: the channel, and the time and offset of each message.
pub(super) fn message_index(fields: &[u8]) -> Option<(u16, Vec<(u64, u64)>)> {
    let mut bytes = Bytes::new(fields);
    let channel = bytes.u16()?;
    let length = usize::try_from(bytes.u32()?).ok()?;
    let mut entries = Bytes::new(bytes.take(length)?);
    let mut places = Vec::with_capacity(length / 16);
    while !entries.rest().is_empty() {
        places.push((entries.u64()?, entries.u64()?));
    }
    Some((channel, places))
}

/// Parses the footer: the offset and the checksum of the summary, each 0 if missing.
pub(super) fn footer(fields: &[u8]) -> Option<(u64, u32)> {
    let mut bytes = Bytes::new(fields);
    let summary = bytes.u64()?;
    let _offsets = bytes.u64()?;
    Some((summary, bytes.u32()?))
}

fn counts(bytes: &mut Bytes<'_>) -> Option<BTreeMap<u16, u64>> {
    let length = usize::try_from(bytes.u32()?).ok()?;
    let mut entries = Bytes::new(bytes.take(length)?);
    let mut counts = BTreeMap::new();
    while !entries.rest().is_empty() {
        counts.insert(entries.u16()?, entries.u64()?);
    }
    Some(counts)
}

fn text(bytes: &mut Bytes<'_>) -> Option<String> {
    let length = usize::try_from(bytes.u32()?).ok()?;
    String::from_utf8(bytes.take(length)?.to_vec()).ok()
}
