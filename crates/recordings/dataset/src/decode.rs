//! Decodes PNG, JPEG and TIFF files to frames.

mod tiff;

use std::io::Cursor;

use jpeg_decoder::{Decoder, PixelFormat as JpegFormat};
use png::{BitDepth, ColorType};
use serde::{Deserialize, Serialize};
use taceva_core::{Frame, FrameInfo, PixelFormat};
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

use crate::decoder_panic::guarded;
use crate::jpeg::check_whole;
use crate::limits;

/// Order of the colours within a pixel of an image file.
///
/// ```
/// use taceva_dataset::ChannelOrder;
///
/// assert_eq!(ChannelOrder::Bgr.name(), "bgr");
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ChannelOrder {
    /// Red, green, blue: the standard of image files.
    Rgb,
    /// Blue, green, red: written by programs that skip the conversion to standard order. Decoded frames are red, green, blue.
    Bgr,
    /// One value per pixel.
    Gray,
}

impl ChannelOrder {
    /// Name of this order, as written in files.
    pub const fn name(self) -> &'static str {
        match self {
            ChannelOrder::Rgb => "rgb",
            ChannelOrder::Bgr => "bgr",
            ChannelOrder::Gray => "gray",
        }
    }
}

/// File formats of stored frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum ImageKind {
    /// PNG image, lossless.
    Png,
    /// JPEG image, lossy.
    Jpeg,
    /// TIFF image.
    Tiff,
}

const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
const PNG_END: &[u8] = b"\0\0\0\0IEND\xaeB`\x82";
const JPEG_SIGNATURE: &[u8] = b"\xff\xd8\xff";
const JPEG_END: &[u8] = b"\xff\xd9";
/// File signatures of TIFF in both byte orders, and of BigTIFF, which may exceed 4 GiB.
const TIFF_SIGNATURES: [&[u8]; 4] = [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"];

impl ImageKind {
    /// Format that the signature of `bytes` identifies; `None` for an unknown signature. The file name is ignored.
    pub fn of(bytes: &[u8]) -> Option<ImageKind> {
        if bytes.starts_with(PNG_SIGNATURE) {
            Some(ImageKind::Png)
        } else if bytes.starts_with(JPEG_SIGNATURE) {
            Some(ImageKind::Jpeg)
        } else {
            let mut tiff = TIFF_SIGNATURES.iter();
            tiff.any(|signature| bytes.starts_with(signature))
                .then_some(ImageKind::Tiff)
        }
    }

    /// Usual file extension of the format.
    pub const fn extension(self) -> &'static str {
        match self {
            ImageKind::Png => "png",
            ImageKind::Jpeg => "jpg",
            ImageKind::Tiff => "tif",
        }
    }

    /// True if `extension` is usual for this format.
    pub fn has_extension(self, extension: &str) -> bool {
        let known: &[&str] = match self {
            ImageKind::Png => &["png"],
            ImageKind::Jpeg => &["jpg", "jpeg"],
            ImageKind::Tiff => &["tif", "tiff"],
        };
        known
            .iter()
            .any(|known| extension.eq_ignore_ascii_case(known))
    }
}

/// Decodes the image file `bytes`, whose colours are stored in `order`.
///
/// Keeps 8 and 16 bits, gray and RGB. PNG palettes and lower bit depths become 8-bit RGB or gray. An alpha channel is dropped if opaque everywhere, otherwise
/// rejected. A file without its end marker is rejected as truncated, although decoders fill the missing part with gray.
pub fn decode(bytes: &[u8], order: ChannelOrder) -> Result<(ImageKind, Frame), String> {
    let kind = kind_of_whole(bytes)?;
    let (info, pixels) = guarded(|| match kind {
        ImageKind::Png => decode_png(bytes),
        ImageKind::Jpeg if has_a_scan_a_component(bytes) => decode_scan_a_component(bytes),
        ImageKind::Jpeg => decode_jpeg(bytes),
        ImageKind::Tiff => tiff::decode(bytes),
    })??;
    let pixels = in_order(info, pixels, order)?;
    let frame = Frame::new(info, pixels).map_err(|error| error.to_string())?;
    Ok((kind, frame))
}

/// Checks that a decodable image file of `kind` is complete. PNG and TIFF decoders check this themselves; JPEG decoders fill missing parts with
/// gray.
pub fn check_to_the_end(bytes: &[u8], kind: ImageKind) -> Result<(), String> {
    match kind {
        ImageKind::Png | ImageKind::Tiff => Ok(()),
        ImageKind::Jpeg => guarded(|| check_whole(bytes))?
            .map_err(|problem| format!("cut short or damaged inside: {problem}")),
    }
}

/// Format of an image file. Returns an error message for an unknown format or a missing end marker.
pub(crate) fn kind_of_whole(bytes: &[u8]) -> Result<ImageKind, String> {
    let kind = ImageKind::of(bytes)
        .ok_or("neither PNG nor JPEG nor TIFF: its first bytes are those of another format")?;
    let is_ended = match kind {
        ImageKind::Png => bytes.ends_with(PNG_END),
        // TIFF has no end marker: its directory names every strip, which the decoder reads.
        ImageKind::Tiff => true,
        // Some cameras write data after the picture, which is ignored.
        ImageKind::Jpeg => {
            bytes.ends_with(JPEG_END) || bytes.windows(2).rev().any(|pair| pair == JPEG_END)
        }
    };
    if is_ended {
        Ok(kind)
    } else {
        Err(
            "cut short or damaged: the file does not end in the end marker of its format"
                .to_owned(),
        )
    }
}

fn decode_png(bytes: &[u8]) -> Result<(FrameInfo, Vec<u8>), String> {
    let text = |error: png::DecodingError| error.to_string();
    let most = png::Limits {
        bytes: most_of(bytes),
    };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), most);
    // Palettes become colours, and fewer than 8 bits become 8.
    decoder.set_transformations(png::Transformations::EXPAND);
    let (width, height) = decoder.read_header_info().map_err(text)?.size();
    if width.max(height) > limits::IMAGE_SIDE {
        return Err(format!(
            "an image of {width}×{height}, expected sides of at most {} pixels",
            limits::IMAGE_SIDE
        ));
    }
    let mut reader = decoder.read_info().map_err(text)?;
    let length = reader.output_buffer_size();
    let length = length.ok_or("the image exceeds the address space")?;
    let mut pixels = vec![0; checked_length(length as u64, bytes)?];
    reader.next_frame(&mut pixels).map_err(text)?;
    let (format, pixels) = match reader.output_color_type() {
        (ColorType::Grayscale, BitDepth::Eight) => (PixelFormat::Gray8, pixels),
        (ColorType::Rgb, BitDepth::Eight) => (PixelFormat::Rgb8, pixels),
        (ColorType::Grayscale, BitDepth::Sixteen) => (PixelFormat::Gray16, little_endian(pixels)),
        (ColorType::Rgb, BitDepth::Sixteen) => (PixelFormat::Rgb16, little_endian(pixels)),
        (ColorType::GrayscaleAlpha, BitDepth::Eight) => {
            (PixelFormat::Gray8, without_alpha::<2, 1>(&pixels)?)
        }
        (ColorType::Rgba, BitDepth::Eight) => (PixelFormat::Rgb8, without_alpha::<4, 1>(&pixels)?),
        (ColorType::GrayscaleAlpha, BitDepth::Sixteen) => (
            PixelFormat::Gray16,
            little_endian(without_alpha::<4, 2>(&pixels)?),
        ),
        (ColorType::Rgba, BitDepth::Sixteen) => (
            PixelFormat::Rgb16,
            little_endian(without_alpha::<8, 2>(&pixels)?),
        ),
        other => return Err(unsupported("PNG pixel", &other)),
    };
    let info = FrameInfo {
        width,
        height,
        format,
    };
    Ok((info, pixels))
}

/// Error message for a pixel or colour type other than gray and RGB.
fn unsupported(what: &str, found: &dyn std::fmt::Debug) -> String {
    format!("unsupported {what} type {found:?}; convert to gray or RGB")
}

/// True if a sequential JPEG codes each colour in a separate scan (ITU-T T.81, B.2.2 and B.2.3). Its first scan then has fewer components than its
/// frame.
fn has_a_scan_a_component(bytes: &[u8]) -> bool {
    let mut of_frame = None;
    let mut rest = bytes.get(2..).unwrap_or(&[]);
    while let [0xff, marker, behind @ ..] = rest {
        let [high, low, ..] = behind else {
            return false;
        };
        let length = usize::from(u16::from_be_bytes([*high, *low]));
        match marker {
            0xff => {
                rest = &rest[1..];
                continue;
            }
            0xc0 | 0xc1 => of_frame = behind.get(7).copied(),
            0xda => {
                let of_scan = behind.get(2).copied();
                return of_frame
                    .zip(of_scan)
                    .is_some_and(|(of_frame, of_scan)| of_scan < of_frame);
            }
            _ => {}
        }
        rest = behind.get(length..).unwrap_or(&[]);
    }
    false
}

fn decode_jpeg(bytes: &[u8]) -> Result<(FrameInfo, Vec<u8>), String> {
    let side = limits::IMAGE_SIDE as usize;
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(side)
        .set_max_height(side);
    let text = |error: zune_jpeg::errors::DecodeErrors| error.to_string();
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(text)?;
    let (format, output) = match decoder.input_colorspace() {
        Some(ColorSpace::Luma) => (PixelFormat::Gray8, ColorSpace::Luma),
        Some(ColorSpace::YCbCr | ColorSpace::RGB) => (PixelFormat::Rgb8, ColorSpace::RGB),
        other => return Err(unsupported("JPEG colour", &other)),
    };
    decoder.set_options(options.jpeg_set_out_colorspace(output));
    let size = decoder.info().ok_or("the file states no size")?;
    let info = FrameInfo {
        width: u32::from(size.width),
        height: u32::from(size.height),
        format,
    };
    let length = info
        .byte_len()
        .ok_or("the image exceeds the address space")?;
    checked_length(length as u64, bytes)?;
    let mut pixels = vec![0; length];
    decoder.decode_into(&mut pixels).map_err(text)?;
    Ok((info, pixels))
}

/// Decodes a JPEG with one scan for each colour. `zune-jpeg` decodes this file wrongly without an error.
fn decode_scan_a_component(bytes: &[u8]) -> Result<(FrameInfo, Vec<u8>), String> {
    let text = |error: jpeg_decoder::Error| error.to_string();
    let mut decoder = Decoder::new(bytes);
    decoder.set_max_decoding_buffer_size(most_of(bytes));
    decoder.read_info().map_err(text)?;
    let found = decoder.info().ok_or("the file states no size")?;
    let format = match found.pixel_format {
        JpegFormat::L8 => PixelFormat::Gray8,
        JpegFormat::RGB24 => PixelFormat::Rgb8,
        other => return Err(unsupported("JPEG colour", &other)),
    };
    let info = FrameInfo {
        width: found.width.into(),
        height: found.height.into(),
        format,
    };
    if info.width.max(info.height) > limits::IMAGE_SIDE {
        return Err(format!(
            "an image of {info}, expected sides of at most {} pixels",
            limits::IMAGE_SIDE
        ));
    }
    let pixels = decoder.decode().map_err(text)?;
    Ok((info, pixels))
}

/// Size limit of the decoded image in `file`, bytes.
fn most_of(file: &[u8]) -> usize {
    usize::try_from(limits::decoded_bytes(file.len())).unwrap_or(usize::MAX)
}

/// Converts `bytes`, the decoded size of the image in `file`, to `usize`.
///
/// # Errors
/// Error message if the decoded size exceeds the limit of [`most_of`].
fn checked_length(bytes: u64, file: &[u8]) -> Result<usize, String> {
    let length = usize::try_from(bytes).map_err(|_| "the image exceeds the address space")?;
    match length <= most_of(file) {
        true => Ok(length),
        false => Err(format!(
            "{bytes} bytes when decoded, expected at most {} for a file of {} bytes: write it with less compression",
            most_of(file),
            file.len()
        )),
    }
}

/// Converts the 16-bit numbers of a PNG from big-endian to little-endian, as in frames.
fn little_endian(mut pixels: Vec<u8>) -> Vec<u8> {
    pixels
        .chunks_exact_mut(2)
        .for_each(|number| number.reverse());
    pixels
}

/// Removes the last `ALPHA` bytes of each pixel of `PIXEL` bytes, which must all be opaque.
fn without_alpha<const PIXEL: usize, const ALPHA: usize>(pixels: &[u8]) -> Result<Vec<u8>, String> {
    let mut colours = Vec::with_capacity(pixels.len() / PIXEL * (PIXEL - ALPHA));
    for pixel in pixels.chunks_exact(PIXEL) {
        let (colour, alpha) = pixel.split_at(PIXEL - ALPHA);
        if alpha.iter().any(|byte| *byte != 255) {
            return Err("has transparent pixels, which no camera sends; flatten it".to_owned());
        }
        colours.extend_from_slice(colour);
    }
    Ok(colours)
}

/// Pixels with their colours in standard order, or an error message if `order` contradicts the number of colours.
fn in_order(info: FrameInfo, mut pixels: Vec<u8>, order: ChannelOrder) -> Result<Vec<u8>, String> {
    let is_gray = info.format.samples() == 1;
    if is_gray != (order == ChannelOrder::Gray) {
        return Err(format!(
            "channel order `{}` is declared, the image is {info}",
            order.name()
        ));
    }
    if order == ChannelOrder::Bgr {
        let width = info.format.bytes_per_sample();
        for pixel in pixels.chunks_exact_mut(3 * width) {
            let (first, rest) = pixel.split_at_mut(width);
            first.swap_with_slice(&mut rest[width..]);
        }
    }
    Ok(pixels)
}

#[cfg(test)]
mod tests;
