//! Journal of a recording. A record survives a power cut once its append has returned.
//!
//! A record is `length: u32 · kind: u8 · sequence: u64 · header check: 8 bytes · payload · chain: 32 bytes`, numbers little-endian. The header check
//! is the beginning of the SHA-256 of the preceding 13 bytes. This check verifies the length before use. The chain is the SHA-256 of the previous
//! chain, the header and the payload. The chain detects missing, changed or moved records.
//!
//! Each record is durable before the next begins, so only the last can be torn. A torn last record is cut when the journal is opened. Damage before later
//! records is an error, because the later records were acknowledged.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest as _, Sha256};
use taceva_files::parent_of;

use crate::error::DatasetError;
use crate::file::{make_names_durable, open_regular};
use crate::limits;

const HEADER: usize = 4 + 1 + 8 + 8;
const CHAIN: usize = 32;

/// Kind of a journal record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum RecordKind {
    /// Facts about the recording. Always the first record, and never a later record.
    Start = 1,
    /// Single sample.
    Sample = 2,
    /// Frame without contact.
    Reference = 3,
    /// All samples of one press.
    Press = 4,
    /// Frames of a stream that were stored together.
    Stream = 5,
}

impl RecordKind {
    fn from_byte(byte: u8) -> Option<RecordKind> {
        [
            RecordKind::Start,
            RecordKind::Sample,
            RecordKind::Reference,
            RecordKind::Press,
            RecordKind::Stream,
        ]
        .into_iter()
        .find(|kind| *kind as u8 == byte)
    }
}

/// Complete record of a journal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct JournalRecord {
    pub(crate) kind: RecordKind,
    pub(crate) payload: Vec<u8>,
}

/// Append-only file of records.
#[derive(Debug)]
pub(crate) struct Journal {
    file: File,
    path: PathBuf,
    chain: [u8; CHAIN],
    sequence: u64,
    has_failed: bool,
}

/// Records found when a journal was opened.
#[derive(Debug, Default)]
pub(crate) struct Recovered {
    pub(crate) records: Vec<JournalRecord>,
    /// Size of a torn last record that was cut, bytes; 0 if none.
    pub(crate) cut_bytes: u64,
}

impl Journal {
    /// Creates a journal with its first record, which is durable on return.
    pub(crate) fn create(path: &Path, start: &[u8]) -> Result<Journal, DatasetError> {
        let file = OpenOptions::new()
            .append(true)
            .create_new(true)
            .open(path)
            .map_err(DatasetError::io("create", path))?;
        let mut journal = Journal {
            file,
            path: path.to_owned(),
            chain: [0; CHAIN],
            sequence: 0,
            has_failed: false,
        };
        journal.append(RecordKind::Start, start)?;
        make_names_durable(parent_of(path))?;
        Ok(journal)
    }

    /// Opens a journal and cuts a torn tail.
    pub(crate) fn open(path: &Path) -> Result<(Journal, Recovered), DatasetError> {
        let (mut file, _) = open_regular(path, limits::TABLE_BYTES)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes)
            .map_err(DatasetError::io("read", path))?;
        let scanned = scan(&bytes).map_err(|(offset, problem)| DatasetError::Journal {
            path: path.to_owned(),
            offset: offset as u64,
            problem: problem.to_owned(),
        })?;
        let file = OpenOptions::new()
            .append(true)
            .open(path)
            .map_err(DatasetError::io("open", path))?;
        let cut_bytes = (bytes.len() - scanned.whole) as u64;
        if cut_bytes > 0 {
            file.set_len(scanned.whole as u64)
                .map_err(DatasetError::io("remove the incomplete end of", path))?;
        }
        // A killed process leaves records and a name that are not durable yet: sync before any append.
        file.sync_all()
            .map_err(DatasetError::io("make durable", path))?;
        make_names_durable(parent_of(path))?;
        let journal = Journal {
            file,
            path: path.to_owned(),
            chain: scanned.chain,
            sequence: scanned.records.len() as u64,
            has_failed: false,
        };
        let recovered = Recovered {
            records: scanned.records,
            cut_bytes,
        };
        Ok((journal, recovered))
    }

    /// Appends a record and returns its sequence number once it is durable.
    ///
    /// After a failed write, the state of the file is unknown until the journal is reopened. Every later append therefore fails too.
    pub(crate) fn append(&mut self, kind: RecordKind, payload: &[u8]) -> Result<u64, DatasetError> {
        if self.has_failed {
            let earlier = io::Error::other("an earlier write failed; reopen the recording");
            return Err(DatasetError::io("append to", &self.path)(earlier));
        }
        let length = u32::try_from(payload.len())
            .ok()
            .filter(|length| *length <= limits::RECORD_BYTES)
            .ok_or_else(|| {
                DatasetError::request(
                    &self.path,
                    format!(
                        "a record of {} bytes, expected at most {}",
                        payload.len(),
                        limits::RECORD_BYTES
                    ),
                )
            })?;
        let header = header(length, kind as u8, self.sequence);
        let chain = chained(&self.chain, &header, payload);
        let record = [&header[..], payload, &chain].concat();
        let written = self
            .file
            .write_all(&record)
            .and_then(|()| self.file.sync_data());
        if let Err(error) = written {
            self.has_failed = true;
            return Err(DatasetError::io("append to", &self.path)(error));
        }
        self.chain = chain;
        self.sequence += 1;
        Ok(self.sequence - 1)
    }
}

fn header(length: u32, kind: u8, sequence: u64) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    header[..4].copy_from_slice(&length.to_le_bytes());
    header[4] = kind;
    header[5..13].copy_from_slice(&sequence.to_le_bytes());
    let check = Sha256::digest(&header[..13]);
    header[13..].copy_from_slice(&check[..8]);
    header
}

fn chained(before: &[u8; CHAIN], header: &[u8; HEADER], payload: &[u8]) -> [u8; CHAIN] {
    Sha256::new()
        .chain_update(before)
        .chain_update(header)
        .chain_update(payload)
        .finalize()
        .into()
}

/// Complete records of a journal, and their total size, bytes.
struct Scanned {
    records: Vec<JournalRecord>,
    chain: [u8; CHAIN],
    whole: usize,
}

fn scan(bytes: &[u8]) -> Result<Scanned, (usize, &'static str)> {
    let mut scanned = Scanned {
        records: Vec::new(),
        chain: [0; CHAIN],
        whole: 0,
    };
    while scanned.whole < bytes.len() {
        let at = scanned.whole;
        let sequence = scanned.records.len() as u64;
        let Some((header, length)) = header_at(bytes, at) else {
            return match has_record_behind(bytes, at + 1) {
                false => Ok(scanned),
                true => Err((at, "no header before a record")),
            };
        };
        if header[5..13] != sequence.to_le_bytes() {
            return Err((at, "a record out of sequence"));
        }
        let Some(kind) = RecordKind::from_byte(header[4]) else {
            return Err((at, "a record of an unknown kind"));
        };
        if (kind == RecordKind::Start) != (sequence == 0) {
            return Err((at, "a record of an unexpected kind"));
        }
        let payload_at = at + HEADER;
        let chain_at = payload_at + length;
        let end = chain_at + CHAIN;
        if end > bytes.len() {
            return Ok(scanned);
        }
        let payload = &bytes[payload_at..chain_at];
        let chain = chained(&scanned.chain, &header, payload);
        if chain != bytes[chain_at..end] {
            return if end == bytes.len() {
                Ok(scanned)
            } else {
                Err((at, "a damaged record before another record"))
            };
        }
        scanned.records.push(JournalRecord {
            kind,
            payload: payload.to_vec(),
        });
        scanned.chain = chain;
        scanned.whole = end;
    }
    Ok(scanned)
}

/// Header at offset `at` and the length of its payload, bytes; `None` if the header check does not match.
fn header_at(bytes: &[u8], at: usize) -> Option<([u8; HEADER], usize)> {
    let found: [u8; HEADER] = bytes.get(at..at + HEADER)?.try_into().ok()?;
    let length = u32::from_le_bytes(found[..4].try_into().ok()?);
    let sequence = u64::from_le_bytes(found[5..13].try_into().ok()?);
    let holds = length <= limits::RECORD_BYTES && header(length, found[4], sequence) == found;
    holds.then_some((found, length as usize))
}

/// True if a valid record header follows anywhere after `from`. The bytes before that header are then damaged, not a torn last record.
fn has_record_behind(bytes: &[u8], from: usize) -> bool {
    (from..bytes.len()).any(|at| {
        // Cheap tests first: the check is a SHA-256.
        bytes.get(at + 3) == Some(&0)
            && bytes
                .get(at + 4)
                .is_some_and(|kind| RecordKind::from_byte(*kind).is_some())
            && header_at(bytes, at).is_some()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn journal(payloads: &[&[u8]]) -> (tempfile::TempDir, PathBuf, Vec<u8>) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("journal");
        let mut journal = Journal::create(&path, b"facts").expect("created");
        for (number, payload) in payloads.iter().enumerate() {
            let sequence = journal.append(RecordKind::Sample, payload);
            assert_eq!(sequence.expect("appended"), number as u64 + 1);
        }
        let bytes = std::fs::read(&path).expect("read");
        (folder, path, bytes)
    }

    fn reopened(path: &Path, bytes: &[u8]) -> Result<Recovered, DatasetError> {
        std::fs::write(path, bytes).expect("written");
        Journal::open(path).map(|(_, recovered)| recovered)
    }

    #[test]
    fn a_journal_cut_at_any_byte_of_its_last_record_keeps_all_before() {
        let (_folder, path, bytes) = journal(&[b"one", b"two", b"three"]);
        let last = bytes.len() - (HEADER + 5 + CHAIN);
        for end in last..bytes.len() {
            let recovered = reopened(&path, &bytes[..end]).expect("a torn tail");
            assert_eq!(recovered.records.len(), 3, "cut at {end}");
            assert_eq!(recovered.cut_bytes, (end - last) as u64);
            assert_eq!(std::fs::read(&path).expect("read"), bytes[..last]);
        }
        assert_eq!(reopened(&path, &bytes).expect("whole").records.len(), 4);
    }

    #[test]
    fn a_tail_of_zeros_is_torn() {
        let (_folder, path, bytes) = journal(&[b"one"]);
        for zeros in [1, 20, 21, 60, 4096] {
            let extended = [&bytes[..], &vec![0; zeros]].concat();
            let recovered = reopened(&path, &extended).expect("torn");
            assert_eq!(
                (recovered.records.len(), recovered.cut_bytes),
                (2, zeros as u64)
            );
        }
    }

    #[test]
    fn any_flipped_bit_before_the_last_record_stops() {
        let (_folder, path, bytes) = journal(&[b"one", b"two", b"three"]);
        let last = bytes.len() - (HEADER + 5 + CHAIN);
        for at in 0..last {
            for bit in [0, 3, 7] {
                let mut damaged = bytes.clone();
                damaged[at] ^= 1 << bit;
                let result = reopened(&path, &damaged);
                assert!(
                    matches!(result, Err(DatasetError::Journal { .. })),
                    "byte {at}, bit {bit}: {result:?}"
                );
            }
        }
    }

    #[test]
    fn a_missing_middle_record_stops() {
        let (_folder, path, bytes) = journal(&[b"one", b"two", b"three"]);
        let first = HEADER + 5 + CHAIN;
        let second = first + HEADER + 3 + CHAIN;
        let missing = [&bytes[..first], &bytes[second..]].concat();
        assert!(matches!(
            reopened(&path, &missing),
            Err(DatasetError::Journal { .. })
        ));
    }

    #[test]
    fn appending_goes_on_after_a_torn_tail() {
        let (_folder, path, bytes) = journal(&[b"one", b"two"]);
        std::fs::write(&path, &bytes[..bytes.len() - 1]).expect("written");
        let (mut journal, _) = Journal::open(&path).expect("opens");
        assert_eq!(
            journal
                .append(RecordKind::Sample, b"new")
                .expect("appended"),
            2
        );
        drop(journal);
        let (_, recovered) = Journal::open(&path).expect("opens");
        assert_eq!(recovered.records[2].payload, b"new");
        assert_eq!(recovered.cut_bytes, 0);
    }

    #[test]
    fn a_journal_without_a_whole_first_record_is_empty() {
        let (_folder, path, bytes) = journal(&[]);
        for end in 0..bytes.len() {
            let recovered = reopened(&path, &bytes[..end]).expect("torn");
            assert!(recovered.records.is_empty());
        }
    }
}
