//! Packs: files with consecutive frames of a recording, each frame at a known offset.
//!
//! Each entry of a pack is a complete image file, readable with its offset and length. The picture is the frame, or its difference to the first frame
//! of the pack if the difference is smaller. Static parts of the pictures are thus stored once. Differences below zero wrap around. A pack only
//! grows. Bytes after the last frame in the journal were never acknowledged, and are cut when the recording is resumed.

use std::fmt;
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::error::DatasetError;
use crate::file::{make_names_durable, refuse_link};
use crate::layout;
use crate::limits;

/// Byte range of a frame in a pack, written `@OFFSET+LENGTH` after the path of the pack. The suffix `-first` marks a difference to the first frame.
///
/// ```
/// use taceva_dataset::{Digest, FrameEntry};
///
/// let entry = FrameEntry::at("frames/0000.pack@5+7-first", Digest::of(b""));
/// let span = entry.span.ok_or("it is in a pack")?;
/// assert_eq!((span.offset, span.length, span.is_difference), (5, 7, true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Offset of the first byte.
    pub offset: u64,
    /// Length, bytes.
    pub length: u32,
    /// True if the picture is the difference to the first frame of the pack.
    pub is_difference: bool,
}

/// Suffix of the byte range of a difference.
const DIFFERENCE: &str = "-first";

impl Span {
    /// Offset after the last byte.
    pub(crate) fn end(self) -> u64 {
        self.offset.saturating_add(u64::from(self.length))
    }
}

impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let difference = if self.is_difference { DIFFERENCE } else { "" };
        write!(f, "@{}+{}{difference}", self.offset, self.length)
    }
}

impl FromStr for Span {
    type Err = ();

    fn from_str(text: &str) -> Result<Span, ()> {
        let (offset, length) = text
            .strip_prefix('@')
            .and_then(|text| text.split_once('+'))
            .ok_or(())?;
        let whole = length.strip_suffix(DIFFERENCE);
        Ok(Span {
            offset: offset.parse().map_err(drop)?,
            length: whole.unwrap_or(length).parse().map_err(drop)?,
            is_difference: whole.is_some(),
        })
    }
}

/// Bytes of the frame at `span` in the pack `file`, which is at `path`.
pub(crate) fn read_span(mut file: File, path: &Path, span: Span) -> Result<Vec<u8>, DatasetError> {
    if u64::from(span.length) > limits::IMAGE_BYTES {
        return Err(DatasetError::path(
            format!("{}{span}", path.display()),
            format!("a picture has at most {} bytes", limits::IMAGE_BYTES),
        ));
    }
    let failed = || DatasetError::io("read", path);
    file.seek(SeekFrom::Start(span.offset)).map_err(failed())?;
    let mut bytes = Vec::new();
    // A truncated pack gives fewer bytes, which the digest of the frame detects.
    file.take(u64::from(span.length))
        .read_to_end(&mut bytes)
        .map_err(failed())?;
    Ok(bytes)
}

/// Position at which the next frame is appended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PackEnd {
    /// Number of the pack, from 0.
    pub(crate) number: usize,
    /// Number of bytes in the pack.
    pub(crate) length: u64,
}

impl PackEnd {
    /// Position after the frame at `path`; unchanged if the frame is not in a pack or lies before this position.
    pub(crate) fn behind(self, path: &str, span: Option<Span>) -> PackEnd {
        let found = layout::pack_number(path).zip(span);
        found.map_or(self, |(number, span)| {
            let end = PackEnd {
                number,
                length: span.end(),
            };
            match (end.number, end.length) > (self.number, self.length) {
                true => end,
                false => self,
            }
        })
    }
}

/// Pack to which frames are appended.
#[derive(Debug)]
pub(crate) struct PackWriter {
    folder: PathBuf,
    file: File,
    end: PackEnd,
}

impl PackWriter {
    /// Opens the pack at `end` in the dataset at `folder`. The file name is durable on return.
    pub(crate) fn open(folder: &Path, end: PackEnd) -> Result<PackWriter, DatasetError> {
        let path = folder.join(layout::pack_path(end.number));
        refuse_link(&path)?;
        let file = OpenOptions::new()
            .append(true)
            .create(true)
            .open(&path)
            .map_err(DatasetError::io("open", &path))?;
        // Also if it exists: a killed process leaves names that are not durable.
        make_names_durable(&folder.join(layout::FRAMES))?;
        Ok(PackWriter {
            folder: folder.to_owned(),
            file,
            end,
        })
    }

    /// Appends the image file `bytes`, which is durable after [`sync`](PackWriter::sync).
    pub(crate) fn append(
        &mut self,
        bytes: &[u8],
        is_difference: bool,
    ) -> Result<(String, Span), DatasetError> {
        let path = layout::pack_path(self.end.number);
        let length = u32::try_from(bytes.len()).map_err(|_| {
            DatasetError::request(
                &self.folder.join(&path),
                format!(
                    "a picture of {} bytes, expected less than 2^32",
                    bytes.len()
                ),
            )
        })?;
        let span = Span {
            offset: self.end.length,
            length,
            is_difference,
        };
        self.file
            .write_all(bytes)
            .map_err(DatasetError::io("append to", &self.folder.join(&path)))?;
        self.end.length = span.end();
        Ok((path, span))
    }

    /// Starts a new pack if this pack is full.
    pub(crate) fn roll(&mut self) -> Result<(), DatasetError> {
        if self.end.length >= limits::PACK_BYTES {
            self.sync()?;
            let end = PackEnd {
                number: self.end.number + 1,
                length: 0,
            };
            *self = PackWriter::open(&self.folder, end)?;
        }
        Ok(())
    }

    /// Position at which the next frame is appended.
    pub(crate) fn end(&self) -> PackEnd {
        self.end
    }

    /// Syncs the appended frames to disk.
    pub(crate) fn sync(&self) -> Result<(), DatasetError> {
        let path = self.folder.join(layout::pack_path(self.end.number));
        self.file
            .sync_data()
            .map_err(DatasetError::io("make durable", &path))
    }
}

/// Cuts unacknowledged bytes after `end` in the packs of the dataset at `folder`.
pub(crate) fn cut_behind(folder: &Path, end: PackEnd) -> Result<(), DatasetError> {
    let path = folder.join(layout::pack_path(end.number));
    refuse_link(&path)?;
    match fs::metadata(&path) {
        Ok(found) if found.len() > end.length => OpenOptions::new()
            .write(true)
            .open(&path)
            .and_then(|file| file.set_len(end.length))
            .map_err(DatasetError::io("remove the incomplete end of", &path))?,
        Ok(found) if found.len() < end.length => {
            return Err(DatasetError::damaged(
                &path,
                format!(
                    "{} bytes, but the journal names {}",
                    found.len(),
                    end.length
                ),
            ));
        }
        Err(error) if end.length > 0 => return Err(DatasetError::io("read", &path)(error)),
        _ => {}
    }
    let behind = folder.join(layout::pack_path(end.number + 1));
    match fs::remove_file(&behind) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(DatasetError::io("remove", &behind)(error))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_reads_back_as_it_is_written_and_nothing_else_is_one() {
        for is_difference in [false, true] {
            let span = Span {
                offset: 12,
                length: 34,
                is_difference,
            };
            assert_eq!(span.to_string().parse(), Ok(span));
        }
        for wrong in [
            "",
            "12+34",
            "@12",
            "@+",
            "@-1+2",
            "@1+99999999999",
            "@1+2 ",
            "@1+2-last",
        ] {
            assert_eq!(wrong.parse::<Span>(), Err(()), "{wrong:?}");
        }
    }

    #[test]
    fn a_pack_that_was_cut_short_of_what_the_journal_names_is_damaged() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join(layout::FRAMES)).expect("made");
        let mut pack = PackWriter::open(folder.path(), PackEnd::default()).expect("new");
        let (path, span) = pack.append(b"four", false).expect("room");
        pack.append(b"torn", false).expect("room");
        let end = PackEnd::default().behind(&path, Some(span));
        cut_behind(folder.path(), end).expect("a torn tail");
        let pack = folder.path().join(&path);
        assert_eq!(fs::read(&pack).expect("there"), b"four");
        assert_eq!(
            read_span(File::open(&pack).expect("there"), &pack, span).expect("there"),
            b"four"
        );
        fs::write(&pack, b"fo").expect("cut");
        assert!(cut_behind(folder.path(), end).is_err());
        assert_eq!(
            read_span(File::open(&pack).expect("there"), &pack, span).expect("short"),
            b"fo"
        );
    }
}
