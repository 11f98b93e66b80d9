//! Decompressor of chunks of Blosc 1.
//!
//! A chunk consists of blocks. A block is one stream, or one stream for each byte of an element. Each stream is compressed by another codec.

use super::shuffle::{unshuffled_bits, unshuffled_bytes};
use super::{lz4, zlib, zstd};
use crate::error::Problem;

const HEADER_BYTES: usize = 16;
/// Maximum size of an element, bytes, with one stream per byte. `LEAST_ELEMENTS` is the minimum number of elements of such a block.
const MOST_STREAMS: usize = 16;
const LEAST_ELEMENTS: usize = 128;

const IS_BYTE_SHUFFLED: u8 = 1;
const IS_STORED: u8 = 2;
const IS_BIT_SHUFFLED: u8 = 4;
const IS_ONE_STREAM: u8 = 16;

/// Unpacks a Blosc chunk.
pub(crate) fn blosc(packed: &[u8], most: usize) -> Result<Vec<u8>, Problem> {
    let damaged =
        |at: usize, found: String, expected: &str| Problem::damaged(at as u64, found, expected);
    let header = packed
        .get(..HEADER_BYTES)
        .ok_or_else(|| damaged(packed.len(), "the end".to_owned(), "a Blosc header"))?;
    let number = |at: usize| number(packed, at).unwrap_or(0);
    let (version, flags, element) = (header[0], header[2], usize::from(header[3]));
    let (bytes, block_bytes, packed_bytes) = (number(4), number(8), number(12));
    if version != 2 {
        return Err(damaged(
            0,
            format!("Blosc version {version}"),
            "version 2 (Blosc 1)",
        ));
    }
    if bytes > most || packed_bytes != packed.len() {
        return Err(damaged(
            4,
            format!("a Blosc chunk of {packed_bytes} bytes that unpacks to {bytes} bytes"),
            &format!("{} bytes that unpack to at most {most}", packed.len()),
        ));
    }
    if flags & IS_STORED != 0 {
        let stored = packed.get(HEADER_BYTES..HEADER_BYTES + bytes);
        return stored.map(<[u8]>::to_vec).ok_or_else(|| {
            damaged(
                packed.len(),
                "the end".to_owned(),
                &format!("{bytes} stored bytes"),
            )
        });
    }
    if bytes == 0 {
        return Ok(Vec::new());
    }
    if block_bytes == 0 || element == 0 {
        return Err(damaged(
            3,
            format!("blocks of {block_bytes} bytes, elements of {element}"),
            "at least 1",
        ));
    }
    let chunk = Chunk {
        packed,
        flags,
        element,
    };
    let mut whole = vec![0; bytes];
    for (block, into) in whole.chunks_mut(block_bytes).enumerate() {
        let start = number(HEADER_BYTES + 4 * block);
        let is_split = flags & IS_ONE_STREAM == 0
            && into.len() == block_bytes
            && element <= MOST_STREAMS
            && block_bytes / element >= LEAST_ELEMENTS;
        chunk.block(start, if is_split { element } else { 1 }, into)?;
    }
    Ok(whole)
}

struct Chunk<'a> {
    packed: &'a [u8],
    flags: u8,
    element: usize,
}

impl Chunk<'_> {
    fn block(&self, start: usize, streams: usize, into: &mut [u8]) -> Result<(), Problem> {
        let mut at = start;
        let stream_bytes = into.len() / streams;
        for stream in into.chunks_exact_mut(stream_bytes) {
            let cut = || Problem::damaged(at as u64, "the end", "a Blosc stream");
            let length = number(self.packed, at).ok_or_else(cut)?;
            let end = at
                .checked_add(4)
                .and_then(|at| at.checked_add(length))
                .ok_or_else(cut)?;
            let packed = self.packed.get(at + 4..end).ok_or_else(cut)?;
            if length == stream_bytes {
                stream.copy_from_slice(packed);
            } else {
                self.stream(packed, stream)
                    .map_err(|problem| problem.within(&format!("the stream at byte {at}")))?;
            }
            at = end;
        }
        if self.flags & IS_BYTE_SHUFFLED != 0 && self.element > 1 {
            unshuffled_bytes(into, self.element);
        } else if self.flags & IS_BIT_SHUFFLED != 0 && into.len() >= self.element {
            unshuffled_bits(into, self.element);
        }
        Ok(())
    }

    fn stream(&self, packed: &[u8], into: &mut [u8]) -> Result<(), Problem> {
        let whole = match self.flags >> 5 {
            1 => return lz4(packed, into),
            3 => zlib(packed, into.len())?,
            4 => zstd(packed, into.len())?,
            other => {
                let name = ["blosclz", "", "snappy"]
                    .get(usize::from(other))
                    .copied()
                    .unwrap_or("an unknown codec");
                return Err(Problem::unsupported(
                    format!("chunks compressed by Blosc with {name}"),
                    "write it with lz4 or zstd: `Blosc(cname='zstd')`",
                ));
            }
        };
        if whole.len() != into.len() {
            return Err(Problem::damaged(
                0,
                format!("{} bytes in a stream", whole.len()),
                format!("{}", into.len()),
            ));
        }
        into.copy_from_slice(&whole);
        Ok(())
    }
}

/// Little-endian number of 32 bits at offset `at`; `None` beyond the end.
fn number(bytes: &[u8], at: usize) -> Option<usize> {
    let bytes = bytes.get(at..at.checked_add(4)?)?;
    usize::try_from(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])).ok()
}
