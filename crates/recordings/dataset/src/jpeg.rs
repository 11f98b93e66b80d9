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
/// A message: entropy-coded data that ends early or late, has an unknown code or impossible values; a restart marker that is missing,
/// misplaced or out of order; scans that make no complete picture; a truncated or inconsistent segment.
pub(crate) fn check_whole(bytes: &[u8]) -> Result<(), String> {
    Reader::new(bytes).read_all()
}

#[cfg(test)]
mod tests;
