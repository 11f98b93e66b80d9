//! Encoding frames: as PNG files without loss, as JPEG files with loss.

mod png;

use std::borrow::Cow;

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use taceva_core::{Frame, PixelFormat};

use crate::guard::guarded;

/// The PNG file of `frame`.
pub fn encode_png(frame: &Frame) -> Result<Vec<u8>, String> {
    guarded(|| png::file(frame))?
}

/// The JPEG file of `frame`, of a quality from 1 to 100; numbers of 16 bits are rounded to the 8 that JPEG holds.
pub fn encode_jpeg(frame: &Frame, quality: u8) -> Result<Vec<u8>, String> {
    let info = frame.info();
    let color = match info.format.of_eight_bits() {
        PixelFormat::Gray8 => ExtendedColorType::L8,
        PixelFormat::Rgb8 => ExtendedColorType::Rgb8,
        other => return Err(format!("frames of type {} are not written", other.name())),
    };
    let mut file = Vec::new();
    guarded(|| {
        JpegEncoder::new_with_quality(&mut file, quality)
            .write_image(&eight_bits(frame), info.width, info.height, color)
            .map_err(|error| error.to_string())
    })??;
    Ok(file)
}

fn eight_bits(frame: &Frame) -> Cow<'_, [u8]> {
    if frame.info().format.bytes_per_sample() == 1 {
        return frame.bytes().into();
    }
    // 65535 is 255 times 257.
    let rounded = |value: u16| u8::try_from((u32::from(value) + 128) / 257).expect("at most 255");
    frame.samples().map(rounded).collect()
}
