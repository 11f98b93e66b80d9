//! File bytes with patches for `hdf5-pure`. Soft links become hard links, and layouts get a version that the crate supports.

use std::sync::Arc;

use hdf5_pure::{FormatError, Source};

use super::layout_version;
use super::soft_links::{LONGEST_PATCH, Patches};
use crate::source::{ByteSource, FileBytes};

pub(super) struct PatchedFile {
    pub(super) bytes: Arc<FileBytes>,
    pub(super) patches: Patches,
}

impl Source for PatchedFile {
    fn len(&self) -> u64 {
        self.bytes.length()
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), FormatError> {
        let end = offset.checked_add(buffer.len() as u64);
        if end.is_none_or(|end| end > self.bytes.length()) {
            return Err(FormatError::UnexpectedEof {
                expected: buffer.len(),
                available: usize::try_from(self.bytes.length().saturating_sub(offset))
                    .unwrap_or(usize::MAX),
            });
        }
        self.bytes
            .read_at(offset, buffer)
            .map_err(|problem| FormatError::Source(problem.to_string()))?;
        let end = end.unwrap_or(u64::MAX);
        let first = offset.saturating_sub(LONGEST_PATCH - 1);
        for (at, patch) in self.patches.range(first..end) {
            for (at, byte) in (*at..).zip(patch) {
                let place = at
                    .checked_sub(offset)
                    .and_then(|at| usize::try_from(at).ok());
                if let Some(read) = place.and_then(|place| buffer.get_mut(place)) {
                    *read = *byte;
                }
            }
        }
        Ok(())
    }

    fn read_metadata_at(&self, offset: u64, length: usize) -> Result<Vec<u8>, FormatError> {
        let mut block = self.read_exact_at(offset, length)?;
        layout_version::lower(&mut block);
        Ok(block)
    }
}
