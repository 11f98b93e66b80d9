//! The members of a tar archive: ustar, POSIX (pax) and GNU names. Links, devices and holes are refused, and so is every name that leaves the
//! folder; of an archive a header of 512 bytes and one long name are in memory at a time.

use std::fs::File;
use std::io::{self, BufReader, Read};

use thiserror::Error;

use taceva_dataset::internal::check_relative;

const BLOCK: usize = 512;
/// The most bytes of a long name, or of the records of an extended header.
const NAME_BYTES: u64 = 64 << 10;
/// The most members of an archive.
pub(crate) const MEMBERS: u64 = 1 << 20;
/// The most members without a byte of their own: a small archive may hold any number of them.
pub(crate) const EMPTY_MEMBERS: u64 = 20_000;

/// What is wrong with an archive.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum TarError {
    #[error("{0}")]
    Read(#[from] io::Error),
    #[error("no tar: the checksum of the header at byte {0} is not what it states")]
    Sum(u64),
    #[error("cut short: it ends at byte {0}, without the two empty blocks of its end")]
    Cut(u64),
    #[error("`{name}` at byte {at} states {size} bytes, more than the archive has behind it")]
    Size { name: String, at: u64, size: u64 },
    #[error("the header at byte {0} has no number where one is expected")]
    Number(u64),
    #[error(
        "`{name}` is a link, which is not followed: write the archive with `tar --dereference`"
    )]
    Link { name: String },
    #[error("`{name}` has holes, which are not read: write the archive without `--sparse`")]
    Sparse { name: String },
    #[error("`{name}` is no file and no folder (type `{kind}`)")]
    Kind { name: String, kind: char },
    #[error("`{name}`: {problem}")]
    Name { name: String, problem: &'static str },
    #[error("a name of {0} bytes, more than the {NAME_BYTES} that are accepted")]
    LongName(u64),
    #[error("more than the {MEMBERS} members that are accepted")]
    Members,
    #[error(
        "more than the {EMPTY_MEMBERS} empty files and folders that are accepted: leave them out, or unpack the archive and import its folder"
    )]
    EmptyMembers,
    #[error("`{0}` stands twice in it")]
    Twice(String),
}

/// What an archive is read from: bytes in order, some of which are passed over.
pub(crate) trait Tape: Read {
    /// Passes over so many bytes; whether they are there.
    fn skip(&mut self, bytes: u64) -> io::Result<bool>;

    /// How many bytes there are in all, where that is known.
    fn length(&self) -> Option<u64>;
}

/// A file, in which what is passed over is not read.
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

/// A file of the archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Member {
    /// Relative, with `/`, without `.` in front.
    pub(crate) name: String,
    /// Where its bytes begin.
    pub(crate) at: u64,
    pub(crate) size: u64,
}

/// The members of an archive, one after the other.
pub(crate) struct Members<T> {
    tape: T,
    /// Where the tape stands.
    at: u64,
    /// What of the last member was not read, its filling included.
    left: u64,
    count: u64,
    /// Files and folders without a byte of their own.
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

    /// The tape, wherever it stands.
    pub(crate) fn into_tape(self) -> T {
        self.tape
    }

    /// The next file; folders are passed over.
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
            // What belongs to the next member, and is short.
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
                problem: "no text of Unicode",
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

    /// Copies the bytes of `member`, the last that was found, to `into`; an archive that ends before is an error.
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

    /// The next header; `None` at the end of the archive.
    fn header(&mut self) -> Result<Option<[u8; BLOCK]>, TarError> {
        let mut header = [0; BLOCK];
        let at = self.at;
        self.fill(&mut header)?;
        if header.iter().all(|byte| *byte == 0) {
            // Behind the first empty block stands a second; what follows is filling.
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

    /// So many bytes, which are few, and their filling.
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

/// What the records of an extended header say of the next member.
#[derive(Default)]
struct Records {
    path: Option<Vec<u8>>,
    size: Option<u64>,
}

/// `LENGTH KEY=VALUE\n`, one behind the other.
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

/// The name in the header itself.
fn own_name(header: &[u8; BLOCK]) -> Vec<u8> {
    let text = |field: &[u8]| {
        let end = field.iter().position(|byte| *byte == 0);
        field[..end.unwrap_or(field.len())].to_vec()
    };
    let name = text(&header[..100]);
    // GNU archives, whose mark ends in blanks, have other things where POSIX has the folder.
    let folder = match &header[257..263] == b"ustar\0" {
        true => text(&header[345..500]),
        false => Vec::new(),
    };
    match folder.is_empty() {
        true => name,
        false => [folder, b"/".to_vec(), name].concat(),
    }
}

/// A number of a header: octal digits, or from 2^33 on bytes behind a first one of 128.
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

/// A length with what fills its last block.
fn filled(size: u64) -> Option<u64> {
    size.checked_next_multiple_of(BLOCK as u64)
}
