//! Indices of AVI files, checked against the chunks.

use super::chunk::{Chunk, ChunkId};
use crate::error::VideoError;
use crate::limits;
use crate::packets::Packet;
use crate::source::Source;

/// Entries of the OpenDML indices that a file stores among its pictures, in file order.
#[derive(Debug, Default)]
pub(super) struct Index {
    entries: Vec<(u64, Packet)>,
}

impl Index {
    /// Adds an OpenDML index.
    pub(super) fn add(&mut self, source: &Source, chunk: &Chunk) -> Result<(), VideoError> {
        let wrong = |problem: String| broken(source, chunk.at, problem);
        let bytes = read_index(source, chunk)?;
        let Some((head, entries)) = bytes.split_at_checked(24) else {
            return Err(wrong(format!("{} bytes, expected 24 or more", bytes.len())));
        };
        // Layout: two integers for each entry. The second is a size.
        if head[..2] != [2, 0] || head[3] != 1 {
            return Err(wrong("unknown layout".to_owned()));
        }
        let count = number(&head[4..8]);
        let base = number(&head[12..16]) | number(&head[16..20]) << 32;
        let listed = entries
            .chunks_exact(8)
            .take(usize::try_from(count).unwrap_or(usize::MAX));
        if listed.len() as u64 != count {
            return Err(wrong(format!("{count} entries do not fit into the index")));
        }
        for (at, entry) in (chunk.body + 24..).step_by(8).zip(listed) {
            let offset = base.checked_add(number(&entry[..4]));
            let offset =
                offset.ok_or_else(|| wrong("the offset of an entry overflows".to_owned()))?;
            // The highest bit marks a frame that is not a key frame.
            let size = number(&entry[4..]) & 0x7fff_ffff;
            self.entries.push((at, Packet { offset, size }));
        }
        Ok(())
    }

    /// Checks the entries, if any, against the packets that were found.
    pub(super) fn check(&self, source: &Source, packets: &[Packet]) -> Result<(), VideoError> {
        if self.entries.is_empty() {
            return Ok(());
        }
        for ((at, listed), found) in self.entries.iter().zip(packets) {
            check_entry(source, *at, *listed, *found)?;
        }
        let last = self.entries.last().map_or(0, |(at, _)| *at);
        check_count(source, last, self.entries.len(), packets.len())
    }
}

/// Checks the index at the end of a RIFF part against the `packets` of stream `stream` in that part. The list of packets begins at offset `base`.
pub(super) fn check_idx1(
    source: &Source,
    chunk: &Chunk,
    base: u64,
    stream: u8,
    packets: &[Packet],
) -> Result<(), VideoError> {
    let bytes = read_index(source, chunk)?;
    let mut offsets_from = None;
    let mut found = packets.iter();
    let mut listed = 0;
    for (at, entry) in (chunk.body..).step_by(16).zip(bytes.chunks_exact(16)) {
        let id = ChunkId([entry[0], entry[1], entry[2], entry[3]]);
        if !id.is_picture_of(stream) {
            continue;
        }
        listed += 1;
        let Some(found) = found.next() else {
            continue;
        };
        let offset = number(&entry[8..12]);
        // Some writers count offsets of chunks from the list, others from the beginning of the file.
        let from = *offsets_from.get_or_insert_with(|| match found.offset.checked_sub(8) {
            Some(chunk_at) if chunk_at == offset => 0,
            _ => base,
        });
        let packet = Packet {
            offset: from + offset + 8,
            size: number(&entry[12..16]),
        };
        check_entry(source, at, packet, *found)?;
    }
    check_count(source, chunk.at, listed, packets.len())
}

fn check_entry(source: &Source, at: u64, listed: Packet, found: Packet) -> Result<(), VideoError> {
    if listed == found {
        return Ok(());
    }
    let problem = format!(
        "the index lists {} bytes at {}, but the file has {} bytes at {}",
        listed.size, listed.offset, found.size, found.offset
    );
    Err(broken(source, at, problem))
}

fn check_count(source: &Source, at: u64, listed: usize, found: usize) -> Result<(), VideoError> {
    if listed == found {
        return Ok(());
    }
    Err(broken(
        source,
        at,
        format!("the index lists {listed} frames, but the file has {found}"),
    ))
}

fn read_index(source: &Source, chunk: &Chunk) -> Result<Vec<u8>, VideoError> {
    source.read(
        chunk.body,
        chunk.size,
        "bytes of an index",
        limits::INDEX_BYTES,
    )
}

fn broken(source: &Source, offset: u64, problem: String) -> VideoError {
    VideoError::Index {
        path: source.path().to_owned(),
        offset,
        problem,
    }
}

/// Little-endian integer of up to four bytes.
fn number(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .rev()
        .fold(0, |number, byte| number << 8 | u64::from(*byte))
}
