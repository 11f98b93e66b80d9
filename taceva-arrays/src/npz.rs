//! `.npz`: a zip archive whose members are arrays of NumPy.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use crc32fast::Hasher;

use crate::archive::{Member, members};
use crate::error::Problem;
use crate::inflate::{Inflater, Wrapping, inflated};
use crate::limits;
use crate::npy::NpyArray;
use crate::scalar::shown;
use crate::source::{ByteSource, FileBytes, bytes_of};
use crate::store::{Arrays, Store};
use crate::values::ArrayData;

/// Checksums are formed, and bytes that nobody asked for passed, in pieces of so many bytes.
const PIECE_BYTES: u64 = 1 << 20;
/// What the headers of arrays lie within, nearly always: nothing but this is inflated to list them.
const BEGINNING_BYTES: u64 = 4 << 10;

/// The arrays of an archive.
#[derive(Debug)]
pub(crate) struct Npz {
    arrays: Vec<NpyArray>,
    /// For each array that is listed, which member and which field of it.
    listed: Vec<(usize, usize)>,
    refused: Vec<(String, Problem)>,
}

impl Npz {
    pub(crate) fn open(file: FileBytes) -> Result<Npz, Problem> {
        let file = Arc::new(file);
        let mut names = BTreeSet::new();
        let mut held_bytes = 0_u64;
        let (mut arrays, mut refused) = (Vec::new(), Vec::new());
        for member in members(&*file)? {
            // Others are notes of whoever wrote the archive.
            let Some(name) = member.name.strip_suffix(".npy").map(str::to_owned) else {
                continue;
            };
            if !names.insert(name.clone()) {
                return Err(Problem::damaged(
                    member.at,
                    format!("a second member `{}`", shown(&name)),
                    "each name once",
                ));
            }
            let is_held = member.is_deflated
                && held_bytes + member.bytes.min(limits::HELD_BYTES) <= limits::HELD_BYTES;
            held_bytes += if is_held { member.bytes } else { 0 };
            let source = MemberBytes {
                file: Arc::clone(&file),
                member,
                is_held,
                read: Mutex::new(Read::Nothing),
            };
            let array = NpyArray::open(&name, Arc::new(source));
            match array {
                Ok(array) => arrays.push(array),
                Err(reason @ (Problem::Unsupported { .. } | Problem::Global { .. })) => {
                    refused.push((name, reason))
                }
                Err(problem) => {
                    return Err(problem.within(&format!("member `{}.npy`", shown(&name))));
                }
            }
        }
        let fields = arrays.iter().enumerate().flat_map(|(array, fields)| {
            let count = fields.arrays().len();
            (0..count).map(move |field| (array, field))
        });
        let listed = fields.collect();
        Ok(Npz {
            arrays,
            listed,
            refused,
        })
    }
}

impl Store for Npz {
    fn arrays(&self) -> Arrays {
        self.arrays.iter().flat_map(Store::arrays).collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let (array, field) = self.listed[index];
        self.arrays[array].read(field, rows)
    }
}

/// The bytes of a member as they were before they were packed.
///
/// What is stored is read in place, once its checksum was compared. What is deflated is inflated as a whole and held where all such
/// members take 64 MiB at most; of larger ones it is inflated from where the last rows ended, and from the beginning for rows before
/// them: their checksum is compared whenever the last byte is reached.
#[derive(Debug)]
struct MemberBytes {
    file: Arc<FileBytes>,
    member: Member,
    is_held: bool,
    read: Mutex<Read>,
}

/// What was read of a member so far.
#[derive(Debug)]
enum Read {
    Nothing,
    /// Stored, and its checksum agrees.
    Checked,
    Whole(Arc<Vec<u8>>),
    Part(Box<Part>),
}

/// How far a member was inflated.
#[derive(Debug)]
struct Part {
    inflater: Inflater,
    at: u64,
    sum: Hasher,
}

impl ByteSource for MemberBytes {
    fn length(&self) -> u64 {
        self.member.bytes
    }

    fn read_at(&self, at: u64, into: &mut [u8]) -> Result<(), Problem> {
        let is_beginning = at + into.len() as u64 <= BEGINNING_BYTES;
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if !self.member.is_deflated {
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
                inflater: Inflater::new(self.packed(), Wrapping::Raw),
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

impl MemberBytes {
    fn packed(&self) -> Range<u64> {
        self.member.at..self.member.at + self.member.packed_bytes
    }

    fn whole(&self) -> Result<Vec<u8>, Problem> {
        let packed = bytes_of(&*self.file, self.member.at, self.member.packed_bytes)?;
        let bytes = usize::try_from(self.member.bytes).unwrap_or(usize::MAX);
        let whole = inflated(&packed, bytes, Wrapping::Raw)?;
        self.check(crc32fast::hash(&whole))?;
        Ok(whole)
    }

    /// Inflates what lies before `at`.
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
                format!("the end of what is deflated, after {} bytes", part.at),
                format!("{} bytes", self.member.bytes),
            ));
        }
        if part.at == self.member.bytes && !into.is_empty() {
            if part.inflater.read(&*self.file, &mut [0])? > 0 {
                return Err(Problem::damaged(
                    self.packed().end,
                    "more bytes than are stated",
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
        if computed == self.member.crc32 {
            return Ok(());
        }
        Err(Problem::Checksum {
            what: format!("member `{}`", shown(&self.member.name)),
            stated: self.member.crc32,
            computed,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn member(is_held: bool, name: &str) -> MemberBytes {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/npz-deflated/run.npz");
        let file = FileBytes::open(&path).expect("there");
        let mut all = members(&file).expect("an archive").into_iter();
        MemberBytes {
            member: all.find(|member| member.name == name).expect("listed"),
            file: Arc::new(file),
            is_held,
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
            changed.member.crc32 ^= 1;
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
