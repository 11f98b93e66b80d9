//! Completeness check of JPEG files. Reads the entropy-coded data to its end, block by block, and compares it with the headers.
//!
//! Decoders fill missing parts with gray and continue after damage; this check reports both as errors. Damage is not detected if every code is still in the
//! table and the last code ends at the marker.

mod bits;
mod frame;
mod huffman;
mod scan;
mod segments;

use segments::Reader;

/// Reads the JPEG `bytes` to the end marker. Bytes after the marker are ignored.
///
/// # Errors
/// Message about the fault. Entropy-coded data may end early or late, or contain an unknown code or impossible values. Restart markers may be missing,
/// misplaced or out of order. Scans may leave the picture incomplete, and a segment may be truncated or inconsistent.
pub(crate) fn check_whole(bytes: &[u8]) -> Result<(), String> {
    Reader::new(bytes).read_all()
}

#[cfg(test)]
mod tests;
