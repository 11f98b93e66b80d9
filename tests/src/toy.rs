//! Small programs that write files, to test the search for states after a power cut. Some have planted bugs, which the search must find.

use std::fmt;

/// Method by which a toy program makes its bytes durable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// Overwrites the old file. Wrong, because a cut may leave content that is neither the old nor the new.
    Overwrite,
    /// Writes a second file and renames it. Wrong, because the name may be durable before the bytes.
    Rename,
    /// Like `Rename`, but first syncs the bytes. Wrong, because the name is not durable when success is printed.
    RenameSynced,
    /// Like `RenameSynced`, but also syncs the folder. Correct.
    RenameSyncedFolder,
    /// Appends records with length and checksum. Each record is durable before success is printed. Correct.
    Journal,
    /// Like `Journal`, but prints success before the record is durable. Wrong.
    JournalUnsynced,
    /// Appends payloads without length and checksum. Wrong, because a torn payload looks like data.
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

    /// True if the data of a printed success always survives a power cut.
    pub fn is_right(self) -> bool {
        matches!(self, Protocol::RenameSyncedFolder | Protocol::Journal)
    }

    /// True for a journal; other protocols replace one file.
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

/// Name of the file that is replaced.
pub const HEADER: &str = "header";
/// Name of the file to which records are appended.
pub const JOURNAL: &str = "journal";
/// Number of records in a journal.
pub const RECORDS: usize = 6;

/// Old content of the header.
pub fn old_header() -> Vec<u8> {
    b"old".repeat(1_000)
}

/// New content of the header.
pub fn new_header() -> Vec<u8> {
    b"new!".repeat(2_000)
}

/// Payload of record `number`, from 0.
pub fn payload(number: usize) -> Vec<u8> {
    let letter = b"ABCDEF"[number % RECORDS];
    vec![letter; 5_000 + 777 * number]
}

/// Payload after its length and checksum.
pub fn framed(payload: &[u8]) -> Vec<u8> {
    let length = (payload.len() as u64).to_le_bytes();
    [&length[..], &check(payload).to_le_bytes(), payload].concat()
}

/// Number of records in a journal, from its start.
///
/// # Errors
/// Description of the fault, if data that was never written counts as a record.
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

/// Checksum FNV-1a, 64 bits.
fn check(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
