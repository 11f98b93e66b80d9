//! File of a clip. Every read is checked against the length of the file.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use crate::error::VideoError;

/// Regular file, open as long as this value exists. Threads may share it.
#[derive(Debug)]
pub(crate) struct Source {
    path: PathBuf,
    file: File,
    length: u64,
}

impl Source {
    /// Opens a regular file. The kind of file is checked first, because opening a FIFO would block.
    pub(crate) fn open(path: &Path) -> Result<Source, VideoError> {
        let metadata = fs::metadata(path).map_err(VideoError::io("read", path))?;
        if !metadata.is_file() {
            return Err(VideoError::damaged(path, 0, "not a regular file"));
        }
        let file = File::open(path).map_err(VideoError::io("open", path))?;
        Ok(Source {
            path: path.to_owned(),
            file,
            length: metadata.len(),
        })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    pub(crate) fn length(&self) -> u64 {
        self.length
    }

    /// Error for damage at `offset`.
    pub(crate) fn damaged(&self, offset: u64, problem: impl Into<String>) -> VideoError {
        VideoError::damaged(&self.path, offset, problem)
    }

    /// Fills `into` with the bytes from `offset`.
    pub(crate) fn read_into(&self, offset: u64, into: &mut [u8]) -> Result<(), VideoError> {
        let end = offset.checked_add(into.len() as u64);
        if end.is_none_or(|end| end > self.length) {
            let problem = format!(
                "expected {} bytes here, but the file ends after {}",
                into.len(),
                self.length
            );
            return Err(self.damaged(offset.min(self.length), problem));
        }
        read_exact_at(&self.file, into, offset).map_err(VideoError::io("read", &self.path))
    }

    /// Reads `size` bytes at `offset`. The error for more than `limit` bytes names the quantity `what`.
    pub(crate) fn read(
        &self,
        offset: u64,
        size: u64,
        what: &'static str,
        limit: u64,
    ) -> Result<Vec<u8>, VideoError> {
        if size > limit {
            return Err(VideoError::TooLarge {
                path: self.path.clone(),
                what,
                found: size,
                limit,
            });
        }
        let end = offset.checked_add(size);
        let size = usize::try_from(size).ok();
        let Some(size) = size.filter(|_| end.is_some_and(|end| end <= self.length)) else {
            return Err(self.damaged(
                offset.min(self.length),
                format!(
                    "{what} are missing: the file ends after {} bytes",
                    self.length
                ),
            ));
        };
        let mut bytes = vec![0; size];
        self.read_into(offset, &mut bytes)?;
        Ok(bytes)
    }
}

#[cfg(unix)]
fn read_exact_at(file: &File, into: &mut [u8], offset: u64) -> std::io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, into, offset)
}

#[cfg(windows)]
fn read_exact_at(file: &File, mut into: &mut [u8], mut offset: u64) -> std::io::Result<()> {
    use std::os::windows::fs::FileExt;
    while !into.is_empty() {
        let read = file.seek_read(into, offset)?;
        if read == 0 {
            return Err(std::io::ErrorKind::UnexpectedEof.into());
        }
        into = &mut into[read..];
        offset += read as u64;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_allocated_for_bytes_that_the_file_does_not_have() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x");
        fs::write(&path, b"abcdef").expect("written");
        let source = Source::open(&path).expect("opens");
        assert_eq!(source.read(2, 3, "bytes", 9).expect("there"), b"cde");
        let refused = source.read(0, u64::MAX, "bytes", 9);
        assert!(matches!(refused, Err(VideoError::TooLarge { .. })));
        for (offset, size) in [(2, 5), (u64::MAX, 2), (7, 0)] {
            let cut = source.read(offset, size, "bytes", 9);
            assert!(matches!(cut, Err(VideoError::Damaged { .. })), "{offset}");
        }
        assert!(Source::open(folder.path()).is_err());
    }
}
