//! TIFF decoder: one picture of 8 or 16 bits, gray or RGB, uncompressed or with LZW, Deflate or PackBits.

use std::io::Cursor;

use taceva_core::{FrameInfo, PixelFormat};
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

use super::{checked_length, most_of, without_alpha};
use crate::limits;

/// Decodes a TIFF file. Returns its format and its pixels, with interleaved colours and little-endian 16-bit values.
///
/// Rejects other number types (signed, floating point, other bit depths), colours (palettes, CMYK, YCbCr), compressions (JPEG, fax), and several
/// pictures in one file. The error names the unsupported content.
pub(super) fn decode(bytes: &[u8]) -> Result<(FrameInfo, Vec<u8>), String> {
    let mut allowed = Limits::default();
    let most = most_of(bytes);
    allowed.decoding_buffer_size = most;
    allowed.intermediate_buffer_size = most;
    let mut decoder = Decoder::new(Cursor::new(bytes))
        .map_err(text)?
        .with_limits(allowed);
    let (width, height) = decoder.dimensions().map_err(text)?;
    if width > limits::IMAGE_SIDE || height > limits::IMAGE_SIDE {
        return Err(format!(
            "{width}×{height}, expected sides of at most {} pixels",
            limits::IMAGE_SIDE
        ));
    }
    let color = decoder.colortype().map_err(text)?;
    let (format, samples) = match color {
        ColorType::Gray(8) => (PixelFormat::Gray8, 1),
        ColorType::Gray(16) => (PixelFormat::Gray16, 1),
        ColorType::RGB(8) => (PixelFormat::Rgb8, 3),
        ColorType::RGB(16) => (PixelFormat::Rgb16, 3),
        ColorType::RGBA(8) => (PixelFormat::Rgb8, 4),
        ColorType::RGBA(16) => (PixelFormat::Rgb16, 4),
        other => {
            return Err(format!(
                "unsupported TIFF pixel type {other:?}: expected 8 or 16 bits, gray or RGB; convert it, or write it as PNG"
            ));
        }
    };
    let info = FrameInfo {
        width,
        height,
        format,
    };
    check_pieces(&mut decoder, bytes.len() as u64)?;
    let values = u64::from(width) * u64::from(height) * samples;
    let length = checked_length(values * format.bytes_per_sample() as u64, bytes)?;
    let pixels = match decoder.read_image().map_err(text)? {
        DecodingResult::U8(pixels) => pixels,
        DecodingResult::U16(numbers) => numbers.into_iter().flat_map(u16::to_le_bytes).collect(),
        _ => {
            return Err(
                "TIFF with signed or floating-point numbers is not supported: expected unsigned numbers of 8 or 16 bits".to_owned(),
            );
        }
    };
    if pixels.len() != length {
        return Err(format!(
            "TIFF with {} bytes of pixels for {width}×{height}: separate planes of colours are not supported",
            pixels.len()
        ));
    }
    if decoder.more_images() {
        return Err("TIFF with several pictures: write each into a separate file".to_owned());
    }
    let pixels = match color {
        ColorType::RGBA(8) => without_alpha::<4, 1>(&pixels)?,
        ColorType::RGBA(_) => without_alpha::<8, 2>(&pixels)?,
        _ => pixels,
    };
    Ok((info, pixels))
}

/// Error message of the decoder. For unsupported content, the message also lists the supported alternatives.
fn text(error: TiffError) -> String {
    match error {
        TiffError::UnsupportedError(what) => format!(
            "unsupported TIFF: {what}; write it uncompressed, with LZW, Deflate or PackBits, or as PNG"
        ),
        other => other.to_string(),
    }
}

/// Checks that every strip or tile lies within the file, because a Deflate decoder may need fewer bytes than declared.
fn check_pieces(decoder: &mut Decoder<Cursor<&[u8]>>, length: u64) -> Result<(), String> {
    for (offsets, lengths) in [
        (Tag::StripOffsets, Tag::StripByteCounts),
        (Tag::TileOffsets, Tag::TileByteCounts),
    ] {
        let of = |decoder: &mut Decoder<Cursor<&[u8]>>, tag| {
            let found: Option<Vec<u64>> = decoder.find_tag_unsigned_vec(tag).map_err(text)?;
            Ok::<_, String>(found.unwrap_or_default())
        };
        let pieces = of(decoder, offsets)?.into_iter().zip(of(decoder, lengths)?);
        for (at, bytes) in pieces {
            if at.checked_add(bytes).is_none_or(|end| end > length) {
                return Err(format!(
                    "cut short or damaged: the picture has {bytes} bytes from byte {at} on, but the file has {length}"
                ));
            }
        }
    }
    Ok(())
}
