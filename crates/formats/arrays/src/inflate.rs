//! Decompression of deflated bytes, in pieces or as a whole.

use miniz_oxide::inflate::TINFLStatus;
use miniz_oxide::inflate::core::{DecompressorOxide, decompress, inflate_flags};

use crate::error::Problem;
use crate::source::{ByteSource, bytes_of};

/// Number of deflated bytes read at once.
const INPUT_BYTES: u64 = 256 << 10;
/// Size of the output window, bytes. Must be a power of two of at least 32 KiB.
const WINDOW_BYTES: usize = 256 << 10;

/// Container of deflated bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wrapping {
    /// No container.
    Raw,
    /// Header and checksum of zlib. The checksum is verified.
    Zlib,
}

impl Wrapping {
    fn flags(self) -> u32 {
        match self {
            Wrapping::Raw => 0,
            Wrapping::Zlib => inflate_flags::TINFL_FLAG_PARSE_ZLIB_HEADER,
        }
    }
}

/// Inflates all of `packed` to exactly `bytes` bytes. The caller has checked `bytes` against a limit.
pub(crate) fn inflated(
    packed: &[u8],
    bytes: usize,
    wrapping: Wrapping,
) -> Result<Vec<u8>, Problem> {
    let (whole, used) = inflated_at_most(packed, bytes, wrapping)?;
    match whole.len() {
        made if made == bytes => Ok(whole),
        made => Err(Problem::damaged(
            used as u64,
            format!("the end of the deflated data after {made} bytes"),
            format!("{bytes} bytes"),
        )),
    }
}

/// Inflates a stream of unknown inflated length. Fails if this length exceeds `most` bytes. Also returns the number of consumed packed bytes.
pub(crate) fn inflated_at_most(
    packed: &[u8],
    most: usize,
    wrapping: Wrapping,
) -> Result<(Vec<u8>, usize), Problem> {
    let mut whole = vec![0; most];
    let flags = wrapping.flags() | inflate_flags::TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF;
    let (status, used, made) =
        decompress(&mut DecompressorOxide::new(), packed, &mut whole, 0, flags);
    if status != TINFLStatus::Done {
        return Err(broken(used as u64, status));
    }
    whole.truncate(made);
    Ok((whole, used))
}

/// Problem for bytes that the decoder rejects, at offset `at` of the deflated bytes.
fn broken(at: u64, status: TINFLStatus) -> Problem {
    let (found, expected) = match status {
        TINFLStatus::HasMoreOutput => ("more bytes than stated", "the end of the deflated data"),
        TINFLStatus::Adler32Mismatch => (
            "a checksum that does not match the inflated data",
            "intact bytes",
        ),
        TINFLStatus::FailedCannotMakeProgress | TINFLStatus::NeedsMoreInput => {
            ("the end", "more deflated bytes")
        }
        _ => ("invalid deflated data", "deflated bytes"),
    };
    Problem::damaged(at, found, expected)
}

/// Incremental inflater. Inflates from the first byte up to the requested byte.
pub(crate) struct Inflater {
    state: Box<DecompressorOxide>,
    wrapping: Wrapping,
    /// Range of the deflated bytes in the source.
    from: std::ops::Range<u64>,
    /// Offset of the next deflated byte to read.
    next: u64,
    input: Vec<u8>,
    used: usize,
    window: Vec<u8>,
    /// Range of unread bytes in the window.
    ready: std::ops::Range<usize>,
    is_done: bool,
}

impl Inflater {
    pub(crate) fn new(from: std::ops::Range<u64>, wrapping: Wrapping) -> Inflater {
        Inflater {
            state: Box::new(DecompressorOxide::new()),
            wrapping,
            next: from.start,
            from,
            input: Vec::new(),
            used: 0,
            window: vec![0; WINDOW_BYTES],
            ready: 0..0,
            is_done: false,
        }
    }

    /// Fills `into` with the next inflated bytes. Returns fewer bytes only at the end of the stream.
    pub(crate) fn read(
        &mut self,
        source: &dyn ByteSource,
        into: &mut [u8],
    ) -> Result<usize, Problem> {
        let mut filled = 0;
        while filled < into.len() {
            if self.ready.is_empty() && !self.step(source)? {
                break;
            }
            let count = self.ready.len().min(into.len() - filled);
            let from = self.ready.start..self.ready.start + count;
            into[filled..filled + count].copy_from_slice(&self.window[from]);
            self.ready.start += count;
            filled += count;
        }
        Ok(filled)
    }

    /// Inflates until the window contains bytes. Returns false at the end of the stream.
    fn step(&mut self, source: &dyn ByteSource) -> Result<bool, Problem> {
        while !self.is_done {
            if self.used == self.input.len() && self.next < self.from.end {
                let count = INPUT_BYTES.min(self.from.end - self.next);
                self.input = bytes_of(source, self.next, count)?;
                self.next += count;
                self.used = 0;
            }
            let is_more = self.next < self.from.end;
            let flags = self.wrapping.flags()
                | if is_more {
                    inflate_flags::TINFL_FLAG_HAS_MORE_INPUT
                } else {
                    0
                };
            let start = if self.ready.end == WINDOW_BYTES {
                0
            } else {
                self.ready.end
            };
            let (status, used, made) = decompress(
                &mut self.state,
                &self.input[self.used..],
                &mut self.window,
                start,
                flags,
            );
            self.used += used;
            self.ready = start..start + made;
            match status {
                TINFLStatus::Done => self.is_done = true,
                TINFLStatus::HasMoreOutput => {}
                TINFLStatus::NeedsMoreInput if is_more => {}
                status => {
                    let at = self.next - (self.input.len() - self.used) as u64;
                    return Err(broken(at, status));
                }
            }
            if made > 0 {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

impl std::fmt::Debug for Inflater {
    fn fmt(&self, into: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(into, "Inflater({:?} of {:?})", self.next, self.from)
    }
}
