//! Encoding of frames as PNG files, without loss.

mod png;

use taceva_core::Frame;

use crate::decoder_panic::guarded;

/// The PNG file of `frame`.
pub fn encode_png(frame: &Frame) -> Result<Vec<u8>, String> {
    guarded(|| png::file(frame))?
}
