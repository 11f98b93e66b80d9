//! Decoding of PNG and JPEG files into the caller's buffer.

use std::io::Cursor;

use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::{ColorType, ImageDecoder, ImageError, Limits};
use taceva_core::{FrameInfo, FrameMut, PixelFormat, contained};

use super::limits;

/// Reads size and format of the image in `bytes`, without decoding it.
pub(crate) fn info(bytes: &[u8]) -> Result<FrameInfo, String> {
    let decoder = opened(bytes)?;
    frame_info(decoder.as_ref())
}

/// Decodes the image in `bytes` into the frame `into`, which must have the size and format of the image.
pub(crate) fn decode(bytes: &[u8], into: &mut FrameMut<'_>) -> Result<(), Mismatch> {
    let decoder = opened(bytes).map_err(Mismatch::Damaged)?;
    let found = frame_info(decoder.as_ref()).map_err(Mismatch::Damaged)?;
    if found != into.info() {
        return Err(Mismatch::Size(found));
    }
    let pixels = into.bytes_mut();
    contained(|| decoder.read_image_boxed(pixels))
        .and_then(|read| read.map_err(|error| error.to_string()))
        .map_err(Mismatch::Damaged)?;
    // The decoder writes 16-bit samples in native byte order; frames are little-endian.
    if cfg!(target_endian = "big") && found.format.bytes_per_sample() == 2 {
        pixels.chunks_exact_mut(2).for_each(<[u8]>::reverse);
    }
    Ok(())
}

/// Failure to decode an image into a frame.
#[derive(Debug)]
pub(crate) enum Mismatch {
    /// The size or format of the image differs from the frame. The value describes the image.
    Size(FrameInfo),
    /// The image cannot be decoded.
    Damaged(String),
}

const PNG: (&[u8], &[u8]) = (b"\x89PNG\r\n\x1a\n", b"IEND\xaeB`\x82");
const JPEG: (&[u8], &[u8]) = (b"\xff\xd8\xff", b"\xff\xd9");

/// Opens a decoder for `bytes`, which must end with the end marker of the format. A JPEG decoder would fill a truncated image with gray.
fn opened(bytes: &[u8]) -> Result<Box<dyn ImageDecoder + '_>, String> {
    let begins = |(signature, _): (&[u8], &[u8])| bytes.starts_with(signature);
    let (_, end) = match (begins(PNG), begins(JPEG)) {
        (true, _) => PNG,
        (_, true) => JPEG,
        _ => return Err("its content is neither PNG nor JPEG".to_owned()),
    };
    if !bytes.ends_with(end) {
        return Err("truncated: the end marker of its format is missing".to_owned());
    }
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(limits::IMAGE_SIDE);
    limits.max_image_height = Some(limits::IMAGE_SIDE);
    limits.max_alloc = Some(limits::DECODED_BYTES);
    let open = || -> Result<Box<dyn ImageDecoder + '_>, ImageError> {
        let reader = Cursor::new(bytes);
        if begins(PNG) {
            return Ok(Box::new(PngDecoder::with_limits(reader, limits)?));
        }
        let mut decoder = JpegDecoder::new(reader)?;
        decoder.set_limits(limits)?;
        Ok(Box::new(decoder))
    };
    contained(open)?.map_err(|error| error.to_string())
}

fn frame_info(decoder: &dyn ImageDecoder) -> Result<FrameInfo, String> {
    let format = match decoder.color_type() {
        ColorType::L8 => PixelFormat::Gray8,
        ColorType::L16 => PixelFormat::Gray16,
        ColorType::Rgb8 => PixelFormat::Rgb8,
        ColorType::Rgb16 => PixelFormat::Rgb16,
        ColorType::La8 | ColorType::La16 | ColorType::Rgba8 | ColorType::Rgba16 => {
            return Err("has an alpha channel: flatten it to gray or RGB".to_owned());
        }
        other => {
            return Err(format!(
                "has pixels of type {other:?}, expected gray or RGB"
            ));
        }
    };
    let (width, height) = decoder.dimensions();
    let info = FrameInfo {
        width,
        height,
        format,
    };
    match info.byte_len() {
        Some(1..) if decoder.total_bytes() <= limits::DECODED_BYTES => Ok(info),
        _ => Err(format!(
            "a frame of {info}, expected at most {} bytes",
            limits::DECODED_BYTES
        )),
    }
}
