//! Lossless encoding of frames as PNG files.

mod bits;
mod deflate;
mod huffman;
mod png;

use taceva_core::Frame;

pub(crate) use png::PngFile;

/// Encodes `frame` as a PNG file.
pub fn encode_png(frame: &Frame) -> Result<Vec<u8>, String> {
    PngFile::plan(frame).map(|file| file.write())
}
