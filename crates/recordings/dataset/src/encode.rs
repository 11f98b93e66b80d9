//! Lossless encoding of frames as PNG files.

mod png;

use taceva_core::Frame;

use crate::decoder_panic::guarded;

/// Encodes `frame` as a PNG file.
pub fn encode_png(frame: &Frame) -> Result<Vec<u8>, String> {
    guarded(|| png::file(frame))?
}
