//! Frames to PNG files, without loss.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use taceva_core::{Frame, PixelFormat};

use crate::guard::guarded;

/// The PNG file of `frame`.
pub(crate) fn encode_png(frame: &Frame) -> Result<Vec<u8>, String> {
    let info = frame.info();
    let color = match info.format {
        PixelFormat::Gray8 => ExtendedColorType::L8,
        PixelFormat::Gray16 => ExtendedColorType::L16,
        PixelFormat::Rgb8 => ExtendedColorType::Rgb8,
        PixelFormat::Rgb16 => ExtendedColorType::Rgb16,
        other => return Err(format!("frames of type {} are not written", other.name())),
    };
    let mut file = Vec::new();
    guarded(|| {
        let encoder =
            PngEncoder::new_with_quality(&mut file, CompressionType::Fast, FilterType::Adaptive);
        let pixels = native_endian(frame);
        encoder
            .write_image(&pixels, info.width, info.height, color)
            .map_err(|error| error.to_string())
    })??;
    Ok(file)
}

/// The encoder takes 16-bit numbers in the order of the machine.
fn native_endian(frame: &Frame) -> std::borrow::Cow<'_, [u8]> {
    if frame.info().format.bytes_per_sample() == 2 && cfg!(target_endian = "big") {
        frame.samples().flat_map(u16::to_ne_bytes).collect()
    } else {
        frame.bytes().into()
    }
}
