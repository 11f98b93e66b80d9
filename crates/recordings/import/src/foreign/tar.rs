//! Reader of tar archives with ustar, POSIX (pax) and GNU names. Rejects links, devices, sparse files and names outside the folder. Needs memory for one header
//! of 512 bytes and one long name.

use std::fs::File;
use std::io::{self, BufReader, Read};

use thiserror::Error;

use taceva_dataset::internal::check_relative;

const BLOCK: usize = 512;
/// Maximum size of a long name, or of the records of an extended header, bytes.
const NAME_BYTES: u64 = 64 << 10;
/// Maximum number of members in an archive.
pub(crate) const MEMBERS: u64 = 1 << 20;
/// Maximum number of empty members. A small archive can contain very many of them.
pub(crate) const EMPTY_MEMBERS: u64 = 20_000;

/// Error in reading a tar archive.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum TarError {
    #[error("{0}")]
    Read(#[from] io::Error),
    #[error("not a tar archive: the header at byte {0} has a wrong checksum")]
    Sum(u64),
    #[error("cut short: it ends at byte {0}, without the two empty end blocks")]
    Cut(u64),
    #[error("`{name}` at byte {at} states {size} bytes, more than the archive has left")]
    Size { name: String, at: u64, size: u64 },
    #[error("the header at byte {0} has no number where a number is expected")]
    Number(u64),
    #[error(
        "`{name}` is a link, which is not followed: write the archive with `tar --dereference`"
    )]
    Link { name: String },
    #[error("`{name}` is a sparse file: write the archive without `--sparse`")]
    Sparse { name: String },
    #[error("`{name}` is neither a file nor a folder (type `{kind}`)")]
    Kind { name: String, kind: char },
    #[error("`{name}`: {problem}")]
    Name { name: String, problem: &'static str },
    #[error("a name of {0} bytes, expected at most {NAME_BYTES}")]
    LongName(u64),
    #[error("more than {MEMBERS} members: unpack the archive and import its folder")]
    Members,
    #[error(
        "more than {EMPTY_MEMBERS} empty files and folders: leave them out, or unpack the archive and import its folder"
    )]
    EmptyMembers,
    #[error("the archive holds `{0}` twice")]
    Twice(String),
}

/// Input of an archive: a byte sequence in which some bytes may be skipped.
pub(crate) trait Tape: Read {
    /// Skips `bytes` bytes. Returns false if the input has fewer bytes.
    fn skip(&mut self, bytes: u64) -> io::Result<bool>;

    /// Total length of the input, bytes; `None` if unknown.
    fn length(&self) -> Option<u64>;
}

/// File as the input of an archive. Skipped bytes are not read.
pub(crate) struct FileTape {
    pub(crate) file: BufReader<File>,
    pub(crate) length: u64,
}

impl Read for FileTape {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.file.read(into)
    }
}

impl Tape for FileTape {
    fn skip(&mut self, bytes: u64) -> io::Result<bool> {
        let Ok(bytes) = i64::try_from(bytes) else {
            return Ok(false);
        };
        self.file.seek_relative(bytes)?;
        Ok(true)
    }

    fn length(&self) -> Option<u64> {
        Some(self.length)
    }
}

/// File stored in the archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Member {
    /// Relative path with `/`, without a leading `.` component.
    pub(crate) name: String,
    /// Offset of the content in the archive, bytes.
    pub(crate) at: u64,
    pub(crate) size: u64,
}

/// Iterator over the members of an archive.
pub(crate) struct Members<T> {
    tape: T,
    /// Current offset, bytes.
    at: u64,
    /// Number of unread bytes of the last member, including padding.
    left: u64,
    count: u64,
    /// Number of empty files and folders found.
    empty: u64,
}

impl<T: Tape> Members<T> {
    pub(crate) fn new(tape: T) -> Members<T> {
        Members {
            tape,
            at: 0,
            left: 0,
            count: 0,
            empty: 0,
        }
    }

    /// Returns the tape at its current position.
    pub(crate) fn into_tape(self) -> T {
        self.tape
    }

    /// Returns the next file. Folders are skipped.
    pub(crate) fn next(&mut self) -> Result<Option<Member>, TarError> {
        let mut long_name = None;
        let mut long_size = None;
        loop {
            self.pass(self.left)?;
            self.left = 0;
            let header_at = self.at;
            let Some(header) = self.header()? else {
                return Ok(None);
            };
            self.count += 1;
            if self.count > MEMBERS {
                return Err(TarError::Members);
            }
            let stated = number(&header[124..136]).ok_or(TarError::Number(header_at))?;
            let kind = header[156];
            // Short records that belong to the next member.
            if matches!(kind, b'L' | b'x' | b'g' | b'K') {
                if stated > NAME_BYTES {
                    return Err(TarError::LongName(stated));
                }
                let text = self.short(stated)?;
                match kind {
                    b'L' => {
                        let end = text.iter().position(|byte| *byte == 0);
                        long_name = Some(text[..end.unwrap_or(text.len())].to_vec());
                    }
                    b'x' => {
                        let own = records(&text, header_at)?;
                        long_name = own.path.or(long_name);
                        long_size = own.size.or(long_size);
                    }
                    _ => {}
                }
                continue;
            }
            let size = long_size.take().unwrap_or(stated);
            let name = long_name.take().unwrap_or_else(|| own_name(&header));
            let name = String::from_utf8(name).map_err(|error| TarError::Name {
                name: String::from_utf8_lossy(error.as_bytes()).into_owned(),
                problem: "not Unicode text",
            })?;
            self.empty += u64::from(size == 0 || kind == b'5');
            if self.empty > EMPTY_MEMBERS {
                return Err(TarError::EmptyMembers);
            }
            match kind {
                b'0' | 0 | b'7' => {}
                b'5' => {
                    self.left = filled(size).ok_or(TarError::Number(header_at))?;
                    continue;
                }
                b'1' | b'2' => return Err(TarError::Link { name }),
                b'S' => return Err(TarError::Sparse { name }),
                kind => {
                    return Err(TarError::Kind {
                        name,
                        kind: char::from(kind),
                    });
                }
            }
            self.left = filled(size).ok_or(TarError::Number(header_at))?;
            let end = self.at.checked_add(size);
            if self
                .tape
                .length()
                .is_some_and(|length| end.is_none_or(|end| end > length))
            {
                return Err(TarError::Size {
                    name,
                    at: header_at,
                    size,
                });
            }
            check_relative(&name).map_err(|problem| TarError::Name {
                name: name.clone(),
                problem,
            })?;
            let parts = name.split('/').filter(|part| !matches!(*part, "" | "."));
            let name = parts.collect::<Vec<_>>().join("/");
            return Ok(Some(Member {
                name,
                at: self.at,
                size,
            }));
        }
    }

    /// Copies the content of `member`, which must be the last returned member, to `into`. Fails if the archive ends early.
    pub(crate) fn copy(
        &mut self,
        member: &Member,
        into: &mut dyn io::Write,
    ) -> Result<(), TarError> {
        let copied = io::copy(&mut (&mut self.tape).take(member.size), into)?;
        self.at += copied;
        self.left = self.left.saturating_sub(copied);
        match copied == member.size {
            true => Ok(()),
            false => Err(TarError::Cut(self.at)),
        }
    }

    /// Returns the next header; `None` at the end of the archive.
    fn header(&mut self) -> Result<Option<[u8; BLOCK]>, TarError> {
        let mut header = [0; BLOCK];
        let at = self.at;
        self.fill(&mut header)?;
        if header.iter().all(|byte| *byte == 0) {
            // A second empty block follows the first; the rest is padding.
            self.fill(&mut header)?;
            return match header.iter().all(|byte| *byte == 0) {
                true => Ok(None),
                false => Err(TarError::Sum(at)),
            };
        }
        let stated = number(&header[148..156]).ok_or(TarError::Sum(at))?;
        let blanked = header.iter().enumerate().map(|(place, byte)| match place {
            148..156 => u64::from(b' '),
            _ => u64::from(*byte),
        });
        match blanked.sum::<u64>() == stated {
            true => Ok(Some(header)),
            false => Err(TarError::Sum(at)),
        }
    }

    fn fill(&mut self, into: &mut [u8]) -> Result<(), TarError> {
        match self.tape.read_exact(into) {
            Ok(()) => {
                self.at += into.len() as u64;
                Ok(())
            }
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                Err(TarError::Cut(self.at))
            }
            Err(error) => Err(error.into()),
        }
    }

    /// Reads `size` bytes and their padding into memory. `size` must be small.
    fn short(&mut self, size: u64) -> Result<Vec<u8>, TarError> {
        let length = filled(size).unwrap_or(0);
        let mut text = vec![0; usize::try_from(length).unwrap_or(0)];
        self.fill(&mut text)?;
        text.truncate(usize::try_from(size).unwrap_or(0));
        Ok(text)
    }

    fn pass(&mut self, bytes: u64) -> Result<(), TarError> {
        self.at = self.at.checked_add(bytes).ok_or(TarError::Cut(self.at))?;
        let is_beyond = self.tape.length().is_some_and(|length| self.at > length);
        match !is_beyond && (bytes == 0 || self.tape.skip(bytes)?) {
            true => Ok(()),
            false => Err(TarError::Cut(self.at - bytes)),
        }
    }
}

/// Records of an extended header for the next member.
#[derive(Default)]
struct Records {
    path: Option<Vec<u8>>,
    size: Option<u64>,
}

/// Parses consecutive records `LENGTH KEY=VALUE\n`.
fn records(mut text: &[u8], at: u64) -> Result<Records, TarError> {
    let mut found = Records::default();
    while !text.is_empty() && text[0] != 0 {
        let blank = text.iter().position(|byte| *byte == b' ');
        let length = blank.and_then(|blank| {
            let length: usize = std::str::from_utf8(&text[..blank]).ok()?.parse().ok()?;
            (length > blank + 1 && length <= text.len()).then_some((blank, length))
        });
        let (blank, length) = length.ok_or(TarError::Number(at))?;
        let record = text[blank + 1..length].strip_suffix(b"\n");
        let record = record.ok_or(TarError::Number(at))?;
        let equals = record.iter().position(|byte| *byte == b'=');
        let (key, value) = record.split_at(equals.ok_or(TarError::Number(at))?);
        let value = &value[1..];
        match key {
            b"path" => found.path = Some(value.to_vec()),
            b"size" => {
                let size = std::str::from_utf8(value)
                    .ok()
                    .and_then(|text| text.parse().ok());
                found.size = Some(size.ok_or(TarError::Number(at))?);
            }
            key if key.starts_with(b"GNU.sparse") => {
                return Err(TarError::Sparse {
                    name: String::from_utf8_lossy(found.path.as_deref().unwrap_or_default())
                        .into_owned(),
                });
            }
            _ => {}
        }
        text = &text[length..];
    }
    Ok(found)
}

/// Name of a member in its own header block, without extended headers.
fn own_name(header: &[u8; BLOCK]) -> Vec<u8> {
    let text = |field: &[u8]| {
        let end = field.iter().position(|byte| *byte == 0);
        field[..end.unwrap_or(field.len())].to_vec()
    };
    let name = text(&header[..100]);
    // GNU archives, whose magic ends in blanks, store other fields in the place of the POSIX prefix.
    let folder = match &header[257..263] == b"ustar\0" {
        true => text(&header[345..500]),
        false => Vec::new(),
    };
    match folder.is_empty() {
        true => name,
        false => [folder, b"/".to_vec(), name].concat(),
    }
}

/// Number in a header: octal digits, or base 256 after a byte of 128 for numbers from 2^33.
fn number(field: &[u8]) -> Option<u64> {
    if field[0] == 0x80 {
        let (high, low) = field[1..].split_at(field.len().checked_sub(9)?);
        let low: [u8; 8] = low.try_into().ok()?;
        return high
            .iter()
            .all(|byte| *byte == 0)
            .then(|| u64::from_be_bytes(low));
    }
    let text = std::str::from_utf8(field).ok()?;
    let text = text.trim_matches([' ', '\0']);
    match text.is_empty() {
        true => Some(0),
        false => u64::from_str_radix(text, 8).ok(),
    }
}

/// `size` padded to whole blocks, bytes; `None` on overflow.
fn filled(size: u64) -> Option<u64> {
    size.checked_next_multiple_of(BLOCK as u64)
}
