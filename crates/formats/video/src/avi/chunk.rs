//! Chunks of RIFF files: four letters, a size, and content of that size, padded to an even number of bytes.

use std::fmt;

use crate::error::VideoError;
use crate::source::Source;

/// Four letters that identify a chunk or list.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct ChunkId(pub(super) [u8; 4]);

impl ChunkId {
    /// True for a picture of the stream `number`, compressed or not: `00dc`, `00db`.
    pub(super) fn is_picture_of(self, number: u8) -> bool {
        self.0[..2] == digits(number) && matches!(&self.0[2..], b"dc" | b"db")
    }

    /// True for an index of the stream `number` among its pictures: `ix00`.
    pub(super) fn is_index_of(self, number: u8) -> bool {
        &self.0[..2] == b"ix" && self.0[2..] == digits(number)
    }
}

fn digits(number: u8) -> [u8; 2] {
    [b'0' + number / 10, b'0' + number % 10]
}

impl fmt::Display for ChunkId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", self.0.escape_ascii())
    }
}

/// Location of a chunk.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    pub(super) id: ChunkId,
    /// Offset of the first letter in the file, bytes.
    pub(super) at: u64,
    /// Offset of the content in the file, bytes.
    pub(super) body: u64,
    /// Size of the content without padding, bytes.
    pub(super) size: u64,
}

impl fmt::Debug for ChunkId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Chunk {
    /// Four letters of the kind of a list; `None` for other chunks.
    pub(super) fn list_kind(&self, source: &Source) -> Result<Option<[u8; 4]>, VideoError> {
        if !matches!(&self.id.0, b"LIST" | b"RIFF") || self.size < 4 {
            return Ok(None);
        }
        let mut kind = [0; 4];
        source.read_into(self.body, &mut kind)?;
        Ok(Some(kind))
    }

    /// Iterates over the chunks of a list.
    pub(super) fn list<'a>(&self, source: &'a Source) -> Result<Chunks<'a>, VideoError> {
        if self.size < 4 {
            return Err(source.damaged(self.at, "the list has no type of four letters"));
        }
        // The end was checked when the chunk was found.
        Ok(Chunks::new(source, self.body + 4, self.body + self.size))
    }
}

/// Consecutive chunks in a part of a file.
pub(super) struct Chunks<'a> {
    source: &'a Source,
    at: u64,
    end: u64,
    /// Read buffer and its offset in the file. Many small chunks are read at once.
    window: Vec<u8>,
    window_at: u64,
}

/// Size of the read buffer, bytes.
const WINDOW_BYTES: u64 = 1 << 10;

impl<'a> Chunks<'a> {
    pub(super) fn new(source: &'a Source, at: u64, end: u64) -> Chunks<'a> {
        Chunks {
            source,
            at,
            end,
            window: Vec::new(),
            window_at: 0,
        }
    }

    /// Eight bytes of the header at the current offset.
    fn head(&mut self) -> Result<[u8; 8], VideoError> {
        let in_window = |chunks: &Chunks<'_>| -> Option<[u8; 8]> {
            let from = usize::try_from(chunks.at.checked_sub(chunks.window_at)?).ok()?;
            chunks.window.get(from..)?.first_chunk().copied()
        };
        if let Some(head) = in_window(self) {
            return Ok(head);
        }
        let left = self.end.min(self.source.length()).saturating_sub(self.at);
        let size = left.min(WINDOW_BYTES);
        self.window = self
            .source
            .read(self.at, size, "bytes of chunks", WINDOW_BYTES)?;
        self.window_at = self.at;
        in_window(self).ok_or_else(|| {
            self.source
                .damaged(self.at, "the file ends within a chunk's header")
        })
    }

    /// Next chunk; `None` if fewer than eight bytes are left.
    ///
    /// # Errors
    /// [`VideoError::Damaged`] for a chunk larger than its parent, or a chunk that does not begin with four letters.
    pub(super) fn next(&mut self) -> Result<Option<Chunk>, VideoError> {
        let left = self.end.saturating_sub(self.at);
        if left < 8 {
            return Ok(None);
        }
        let [a, b, c, d, size @ ..] = self.head()?;
        let (id, size) = (ChunkId([a, b, c, d]), u64::from(u32::from_le_bytes(size)));
        if !id.0.iter().all(|letter| (b' '..=b'~').contains(letter)) {
            let problem = format!("chunk id {id}, expected four letters");
            return Err(self.source.damaged(self.at, problem));
        }
        if size > left - 8 {
            let problem = format!("chunk {id} states {size} bytes, but {} are left", left - 8);
            return Err(self.source.damaged(self.at, problem));
        }
        let chunk = Chunk {
            id,
            at: self.at,
            body: self.at + 8,
            size,
        };
        self.at = chunk.body + size + size % 2;
        Ok(Some(chunk))
    }
}
