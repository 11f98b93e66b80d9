//! Whether a JPEG is whole: its entropy-coded data is read to its end, block by block, and must be exactly what the headers promise.
//!
//! Decoders fill what is missing with gray and go on after what is damaged; here anything of that kind is an error. What cannot be
//! seen is damage after which every code is still one of the table and the last one ends where the marker begins.

mod bits;
mod frame;
mod huffman;
mod scan;
mod segments;

use segments::Reader;

/// Reads the JPEG `bytes` to its end marker; what follows that is not looked at.
///
/// # Errors
/// In words: entropy-coded data that ends early, goes on after its last block, has a code of no table or values that no picture has; a
/// restart marker that is missing, astray or out of turn; scans that do not make a whole picture; a segment that is cut or contradicts
/// another.
pub(crate) fn check_whole(bytes: &[u8]) -> Result<(), String> {
    Reader::new(bytes).read_all()
}

#[cfg(test)]
mod tests;
