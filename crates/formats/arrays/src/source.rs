//! Random-access sources of bytes.

use std::fs::File;
use std::path::Path;
#[cfg(not(unix))]
use std::sync::Mutex;

use crate::error::Problem;
use crate::limits;

/// Source of bytes with a known length. Threads may read at any offset.
pub(crate) trait ByteSource: std::fmt::Debug + Send + Sync {
    /// Length of the source, bytes.
    fn length(&self) -> u64;

    /// Fills `into` with the bytes from offset `at`. The caller has checked the range.
    fn read_at(&self, at: u64, into: &mut [u8]) -> Result<(), Problem>;
}

/// Reads the `length` bytes from offset `at`. Checks the range before it allocates memory.
pub(crate) fn bytes_of(source: &dyn ByteSource, at: u64, length: u64) -> Result<Vec<u8>, Problem> {
    if length > limits::READ_BYTES {
        return Err(Problem::too_large(
            "bytes read at once",
            length,
            limits::READ_BYTES,
        ));
    }
    let end = at.checked_add(length).filter(|end| *end <= source.length());
    let (Some(_), Ok(size)) = (end, usize::try_from(length)) else {
        return Err(Problem::damaged(
            source.length(),
            "the end",
            format!("{length} bytes from byte {at}"),
        ));
    };
    let mut bytes = vec![0; size];
    source.read_at(at, &mut bytes)?;
    Ok(bytes)
}

#[derive(Debug)]
pub(crate) struct FileBytes {
    #[cfg(unix)]
    file: File,
    #[cfg(not(unix))]
    file: Mutex<File>,
    length: u64,
}

impl FileBytes {
    /// Opens a regular file.
    pub(crate) fn open(path: &Path) -> Result<FileBytes, Problem> {
        let file = File::open(path).map_err(Problem::io("open"))?;
        let metadata = file.metadata().map_err(Problem::io("open"))?;
        if !metadata.is_file() {
            return Err(Problem::unsupported("not a regular file", "name a file"));
        }
        Ok(FileBytes {
            #[cfg(unix)]
            file,
            #[cfg(not(unix))]
            file: Mutex::new(file),
            length: metadata.len(),
        })
    }
}

impl ByteSource for FileBytes {
    fn length(&self) -> u64 {
        self.length
    }

    #[cfg(unix)]
    fn read_at(&self, at: u64, into: &mut [u8]) -> Result<(), Problem> {
        use std::os::unix::fs::FileExt;
        self.file
            .read_exact_at(into, at)
            .map_err(Problem::io("read"))
    }

    #[cfg(not(unix))]
    fn read_at(&self, at: u64, into: &mut [u8]) -> Result<(), Problem> {
        use std::io::{Read, Seek, SeekFrom};
        let mut file = self
            .file
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        file.seek(SeekFrom::Start(at))
            .and_then(|_| file.read_exact(into))
            .map_err(Problem::io("read"))
    }
}

impl ByteSource for Vec<u8> {
    fn length(&self) -> u64 {
        self.len() as u64
    }

    fn read_at(&self, at: u64, into: &mut [u8]) -> Result<(), Problem> {
        let start = usize::try_from(at).unwrap_or(usize::MAX);
        let bytes = start
            .checked_add(into.len())
            .and_then(|end| self.get(start..end));
        let bytes =
            bytes.ok_or_else(|| Problem::damaged(self.length(), "the end", "more bytes"))?;
        into.copy_from_slice(bytes);
        Ok(())
    }
}
