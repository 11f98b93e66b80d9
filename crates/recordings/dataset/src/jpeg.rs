//! Completeness check of JPEG files: reads the entropy-coded data to its end, block by block, and compares it with the headers.
//!
//! Decoders fill missing parts with gray and continue after damage; here either is an error. Damage is not detected if every code is still
//! in the table and the last one ends at the marker.

mod bits;
mod frame;
mod huffman;
mod scan;
mod segments;

use segments::Reader;

/// Reads the JPEG `bytes` to its end marker; later bytes are ignored.
///
/// # Errors
/// A message about the fault. Entropy-coded data may end early or late, or have an unknown code or impossible values. Restart markers may be
/// missing, misplaced or out of order. Scans may leave the picture incomplete, and a segment may be truncated or inconsistent.
pub(crate) fn check_whole(bytes: &[u8]) -> Result<(), String> {
    Reader::new(bytes).read_all()
}

#[cfg(test)]
mod tests;
