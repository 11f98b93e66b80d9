//! Small writers, some of them wrong on purpose: the search for states of a power cut must find their faults.

use std::fmt;

/// One way to make bytes stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// Writes over the old file. Wrong: a cut leaves neither old nor new.
    Overwrite,
    /// Writes a file beside it and renames. Wrong: the name may be durable before the bytes.
    Rename,
    /// Makes the bytes durable before. Wrong: the name is not, when success is claimed.
    RenameSynced,
    /// Makes the folder durable, too. Right.
    RenameSyncedFolder,
    /// Appends records with length and check, each durable before it is claimed. Right.
    Journal,
    /// The same, claiming each record before it is durable. Wrong.
    JournalUnsynced,
    /// Appends bare payloads. Wrong: a torn one looks like data.
    JournalUnframed,
}

impl Protocol {
    /// Every protocol.
    pub const ALL: [Protocol; 7] = [
        Protocol::Overwrite,
        Protocol::Rename,
        Protocol::RenameSynced,
        Protocol::RenameSyncedFolder,
        Protocol::Journal,
        Protocol::JournalUnsynced,
        Protocol::JournalUnframed,
    ];

    /// Whether it keeps its promise.
    pub fn is_right(self) -> bool {
        matches!(self, Protocol::RenameSyncedFolder | Protocol::Journal)
    }

    /// Whether it is a journal; the others replace one file.
    pub fn is_journal(self) -> bool {
        matches!(
            self,
            Protocol::Journal | Protocol::JournalUnsynced | Protocol::JournalUnframed
        )
    }
}

impl fmt::Display for Protocol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

/// The file that is replaced.
pub const HEADER: &str = "header";
/// The file that is appended to.
pub const JOURNAL: &str = "journal";
/// Records of a journal.
pub const RECORDS: usize = 6;

/// What stood in the header.
pub fn old_header() -> Vec<u8> {
    b"old".repeat(1_000)
}

/// What shall stand in it.
pub fn new_header() -> Vec<u8> {
    b"new!".repeat(2_000)
}

/// The payload of record `number`, from 0.
pub fn payload(number: usize) -> Vec<u8> {
    let letter = b"ABCDEF"[number % RECORDS];
    vec![letter; 5_000 + 777 * number]
}

/// The payload behind its length and check.
pub fn framed(payload: &[u8]) -> Vec<u8> {
    let length = (payload.len() as u64).to_le_bytes();
    [&length[..], &check(payload).to_le_bytes(), payload].concat()
}

/// How many records a journal holds, from its beginning.
///
/// # Errors
/// What is wrong, if something is taken for a record that was never written.
pub fn recovered(protocol: Protocol, bytes: &[u8]) -> Result<usize, String> {
    let mut rest = bytes;
    for number in 0..RECORDS {
        let expected = payload(number);
        let record = match protocol {
            Protocol::JournalUnframed => expected,
            _ => framed(&expected),
        };
        match rest.strip_prefix(record.as_slice()) {
            Some(behind) => rest = behind,
            None if protocol == Protocol::JournalUnframed && !rest.is_empty() => {
                return Err(format!(
                    "a torn tail of {} bytes taken for data",
                    rest.len()
                ));
            }
            None => return Ok(number),
        }
    }
    Ok(RECORDS)
}

/// FNV-1a, 64 bits.
fn check(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
