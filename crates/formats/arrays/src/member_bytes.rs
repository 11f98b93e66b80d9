//! Deflated or stored bytes within a file: members of an archive, and variables of MATLAB.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use crc32fast::Hasher;

use crate::error::Problem;
use crate::inflate::{Inflater, Wrapping, inflated};
use crate::limits;
use crate::scalar::shown;
use crate::source::{ByteSource, FileBytes, bytes_of};

/// Number of bytes of a member that are processed at once to compute a checksum or to skip bytes.
const PIECE_BYTES: u64 = 1 << 20;
/// Number of inflated bytes at the beginning of a member, which nearly always contain its header. Listing arrays inflates only these bytes.
const BEGINNING_BYTES: u64 = 4 << 10;

/// Location of packed bytes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Packed {
    pub(crate) name: String,
    /// Container of the deflated bytes; `None` for bytes stored without compression.
    pub(crate) wrapping: Option<Wrapping>,
    /// Checksum of the unpacked bytes; `None` if the file states none.
    pub(crate) crc32: Option<u32>,
    pub(crate) at: u64,
    /// Size in the file, bytes.
    pub(crate) packed_bytes: u64,
    /// Inflated size, bytes.
    pub(crate) bytes: u64,
}

impl Packed {
    /// Rejects impossible sizes, and members that would exhaust memory or time.
    pub(crate) fn check_size(&self) -> Result<(), Problem> {
        let wrong = |expected: u64| {
            Problem::damaged(
                self.at,
                format!(
                    "`{}` of {} bytes, which claims to inflate to {} bytes",
                    shown(&self.name),
                    self.packed_bytes,
                    self.bytes
                ),
                format!("at most {expected}"),
            )
        };
        if self.wrapping.is_none() {
            return if self.bytes == self.packed_bytes {
                Ok(())
            } else {
                Err(wrong(self.packed_bytes))
            };
        }
        let most = self.packed_bytes.saturating_mul(limits::DEFLATE_RATIO);
        if self.bytes > most {
            return Err(wrong(most));
        }
        let usual = self.packed_bytes.saturating_mul(limits::USUAL_RATIO);
        if self.bytes > limits::INFLATED_BYTES && self.bytes > usual {
            return Err(Problem::too_large(
                format!(
                    "bytes of inflated `{}`, {} times its compressed size (above {} times, at most the limit is accepted; save it without \
                     compression)",
                    shown(&self.name),
                    self.bytes / self.packed_bytes.max(1),
                    limits::USUAL_RATIO
                ),
                self.bytes,
                limits::INFLATED_BYTES,
            ));
        }
        Ok(())
    }
}

/// Number of inflated bytes of a file that are already kept in memory.
#[derive(Debug, Default)]
pub(crate) struct Budget {
    held_bytes: u64,
}

impl Budget {
    /// Reserves `bytes` more bytes. Returns false if they exceed the limit.
    fn takes(&mut self, bytes: u64) -> bool {
        let is_held = bytes <= limits::HELD_BYTES.saturating_sub(self.held_bytes);
        self.held_bytes += if is_held { bytes } else { 0 };
        is_held
    }
}

/// Unpacked bytes of a member.
///
/// Stored bytes are read in place, after their checksum is verified. Deflated members are inflated as a whole and kept in memory if together they
/// take at most 64 MiB. A larger member is inflated up to the requested rows. A later request continues there, or restarts at the beginning for
/// earlier rows. Their checksum is verified when the last byte is reached.
#[derive(Debug)]
pub(crate) struct PackedBytes {
    file: Arc<FileBytes>,
    member: Packed,
    is_held: bool,
    /// True after the header was read. From then on, the checksum of the member covers all returned bytes and is verified at the end of the member.
    is_listed: AtomicBool,
    read: Mutex<Read>,
}

/// State of reading a member.
#[derive(Debug)]
enum Read {
    Nothing,
    /// Bytes stored without compression, whose checksum is verified.
    Checked,
    Whole(Arc<Vec<u8>>),
    Part(Box<Part>),
}

/// Progress of inflating a member.
#[derive(Debug)]
struct Part {
    inflater: Inflater,
    at: u64,
    sum: Hasher,
}

impl ByteSource for PackedBytes {
    fn length(&self) -> u64 {
        self.member.bytes
    }

    fn read_at(&self, at: u64, into: &mut [u8]) -> Result<(), Problem> {
        let is_beginning =
            !self.is_listed.load(Ordering::Relaxed) && at + into.len() as u64 <= BEGINNING_BYTES;
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if self.member.wrapping.is_none() {
            if matches!(*read, Read::Nothing) && !is_beginning {
                self.check_stored()?;
                *read = Read::Checked;
            }
            drop(read);
            return self.file.read_at(self.member.at + at, into);
        }
        if self.is_held && !is_beginning && !matches!(*read, Read::Whole(_)) {
            *read = Read::Whole(Arc::new(self.whole()?));
        }
        if let Read::Whole(whole) = &*read {
            let whole = Arc::clone(whole);
            drop(read);
            return whole.read_at(at, into);
        }
        let mut part = match std::mem::replace(&mut *read, Read::Nothing) {
            Read::Part(part) if part.at <= at => part,
            _ => Box::new(Part {
                inflater: Inflater::new(self.packed(), self.wrapping()),
                at: 0,
                sum: Hasher::new(),
            }),
        };
        self.pass(&mut part, at)?;
        self.fill(&mut part, into)?;
        *read = Read::Part(part);
        Ok(())
    }
}

impl PackedBytes {
    pub(crate) fn new(file: &Arc<FileBytes>, member: Packed, budget: &mut Budget) -> PackedBytes {
        let is_held = member.wrapping.is_some() && budget.takes(member.bytes);
        PackedBytes {
            file: Arc::clone(file),
            member,
            is_held,
            is_listed: AtomicBool::new(false),
            read: Mutex::new(Read::Nothing),
        }
    }

    /// Ends the reading of headers. Before this call, only the beginning of a member is read.
    pub(crate) fn end_listing(&self) {
        self.is_listed.store(true, Ordering::Relaxed);
    }

    fn wrapping(&self) -> Wrapping {
        self.member.wrapping.unwrap_or(Wrapping::Raw)
    }

    fn packed(&self) -> Range<u64> {
        self.member.at..self.member.at + self.member.packed_bytes
    }

    fn whole(&self) -> Result<Vec<u8>, Problem> {
        let packed = bytes_of(&*self.file, self.member.at, self.member.packed_bytes)?;
        let bytes = usize::try_from(self.member.bytes).unwrap_or(usize::MAX);
        let whole = inflated(&packed, bytes, self.wrapping())?;
        self.check(crc32fast::hash(&whole))?;
        Ok(whole)
    }

    /// Inflates and discards the bytes before `at`.
    fn pass(&self, part: &mut Part, at: u64) -> Result<(), Problem> {
        let size = usize::try_from(PIECE_BYTES.min(at - part.at)).unwrap_or(0);
        let mut passed = vec![0; size];
        while part.at < at {
            let size = usize::try_from(PIECE_BYTES.min(at - part.at)).unwrap_or(0);
            self.fill(part, &mut passed[..size])?;
        }
        Ok(())
    }

    fn fill(&self, part: &mut Part, into: &mut [u8]) -> Result<(), Problem> {
        let filled = part.inflater.read(&*self.file, into)?;
        part.at += filled as u64;
        part.sum.update(&into[..filled]);
        if filled < into.len() {
            return Err(Problem::damaged(
                self.packed().end,
                format!("the end of the deflated data after {} bytes", part.at),
                format!("{} bytes", self.member.bytes),
            ));
        }
        if part.at == self.member.bytes && !into.is_empty() {
            if part.inflater.read(&*self.file, &mut [0])? > 0 {
                return Err(Problem::damaged(
                    self.packed().end,
                    "more bytes than stated",
                    format!("{} bytes", self.member.bytes),
                ));
            }
            self.check(part.sum.clone().finalize())?;
        }
        Ok(())
    }

    fn check_stored(&self) -> Result<(), Problem> {
        let mut sum = Hasher::new();
        let mut at = 0;
        while at < self.member.bytes {
            let count = PIECE_BYTES.min(self.member.bytes - at);
            sum.update(&bytes_of(&*self.file, self.member.at + at, count)?);
            at += count;
        }
        self.check(sum.finalize())
    }

    fn check(&self, computed: u32) -> Result<(), Problem> {
        let Some(stated) = self.member.crc32.filter(|stated| *stated != computed) else {
            return Ok(());
        };
        Err(Problem::Checksum {
            what: format!("member `{}`", shown(&self.member.name)),
            stated,
            computed,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::archive::members;

    use super::*;

    fn member(is_held: bool, name: &str) -> PackedBytes {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../../tests/recordings/npz-deflated/run.npz");
        let file = FileBytes::open(&path).expect("there");
        let mut all = members(&file).expect("an archive").into_iter();
        PackedBytes {
            member: all.find(|member| member.name == name).expect("listed"),
            file: Arc::new(file),
            is_held,
            is_listed: AtomicBool::new(false),
            read: Mutex::new(Read::Nothing),
        }
    }

    #[test]
    fn what_is_inflated_in_pieces_equals_what_is_held() {
        let (held, pieces) = (member(true, "images.npy"), member(false, "images.npy"));
        let length = held.length();
        // Forwards, backwards, across the window, up to the end.
        for (at, count) in [
            (0, 128),
            (9_000, 70_000),
            (80_000, 10),
            (200, 5_000),
            (length - 3, 3),
            (1, 0),
            (5_000, 200_000),
        ] {
            let whole = bytes_of(&held, at, count).expect("there");
            assert_eq!(
                bytes_of(&pieces, at, count).expect("there"),
                whole,
                "{count} from {at}"
            );
        }
        assert!(bytes_of(&pieces, length, 1).is_err());
    }

    #[test]
    fn a_wrong_checksum_is_found_at_the_end_of_what_is_inflated_in_pieces() {
        for is_held in [true, false] {
            let mut changed = member(is_held, "images.npy");
            changed.member.crc32 = changed.member.crc32.map(|sum| sum ^ 1);
            let length = changed.length();
            let result = bytes_of(&changed, 128, length - 128);
            assert!(
                matches!(result, Err(Problem::Checksum { .. })),
                "{result:?}"
            );
            let mut longer = member(is_held, "images.npy");
            longer.member.bytes += 1;
            let result = bytes_of(&longer, 128, length - 127);
            assert!(matches!(result, Err(Problem::Damaged { .. })), "{result:?}");
            let mut shorter = member(is_held, "images.npy");
            shorter.member.bytes -= 1;
            let result = bytes_of(&shorter, 128, length - 129);
            assert!(matches!(result, Err(Problem::Damaged { .. })), "{result:?}");
        }
    }
}
