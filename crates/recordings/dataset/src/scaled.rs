//! JPEG at a fraction of its size: of each block only as many coefficients are turned back into pixels as that takes.

use jpeg_decoder::{Decoder, PixelFormat as JpegFormat};
use taceva_core::{Frame, FrameInfo, PixelFormat};

use crate::decode::{ChannelOrder, ImageKind, checked_length, in_order, kind_of_whole};
use crate::guard::guarded;
use crate::limits;

/// The fraction of its sides at which a JPEG is decoded.
///
/// A pixel is the mean of those it stands for, but for rounding and for what the coefficients that are left out would have carried over the
/// border of a block. Sides that are no whole multiple are rounded up.
///
/// ```
/// use taceva_core::{FrameInfo, PixelFormat};
/// use taceva_dataset::DecodeScale;
///
/// let info = FrameInfo { width: 640, height: 481, format: PixelFormat::Rgb8 };
/// let quarter = DecodeScale::Quarter.of(info);
/// assert_eq!((quarter.width, quarter.height), (160, 121));
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DecodeScale {
    /// As it was taken.
    #[default]
    Full,
    /// Half as wide and high.
    Half,
    /// A quarter as wide and high.
    Quarter,
    /// An eighth as wide and high: one pixel a block.
    Eighth,
}

impl DecodeScale {
    /// Every scale, the largest first.
    pub const ALL: [DecodeScale; 4] = [
        DecodeScale::Full,
        DecodeScale::Half,
        DecodeScale::Quarter,
        DecodeScale::Eighth,
    ];

    /// How many pixels along a side become one.
    pub const fn denominator(self) -> u32 {
        1 << self as u32
    }

    /// A frame of `info` at this scale.
    pub const fn of(self, info: FrameInfo) -> FrameInfo {
        FrameInfo {
            width: info.width.div_ceil(self.denominator()),
            height: info.height.div_ceil(self.denominator()),
            format: info.format,
        }
    }
}

/// The frame in the JPEG file `bytes` at `scale`, its colours stored in `order`.
pub(crate) fn decode_scaled(
    bytes: &[u8],
    order: ChannelOrder,
    scale: DecodeScale,
) -> Result<Frame, String> {
    if kind_of_whole(bytes)? != ImageKind::Jpeg {
        let denominator = scale.denominator();
        return Err(format!(
            "a PNG or TIFF, which is decoded at its full size only; JPEG would be at 1/{denominator}"
        ));
    }
    let (info, pixels) = guarded(|| jpeg_at(bytes, scale))??;
    let pixels = in_order(info, pixels, order)?;
    Frame::new(info, pixels).map_err(|error| error.to_string())
}

/// The JPEG `bytes` by `jpeg-decoder`, at any scale.
pub(crate) fn jpeg_at(bytes: &[u8], scale: DecodeScale) -> Result<(FrameInfo, Vec<u8>), String> {
    let text = |error: jpeg_decoder::Error| error.to_string();
    let mut decoder = Decoder::new(bytes);
    let most = checked_length(limits::DECODED_BYTES)?;
    decoder.set_max_decoding_buffer_size(most);
    decoder.read_info().map_err(text)?;
    let found = decoder.info().ok_or("no size in the file")?;
    let format = match found.pixel_format {
        JpegFormat::L8 => PixelFormat::Gray8,
        JpegFormat::RGB24 => PixelFormat::Rgb8,
        other => return Err(format!("colours of type {other:?} are not read")),
    };
    let full = FrameInfo {
        width: found.width.into(),
        height: found.height.into(),
        format,
    };
    if full.width.max(full.height) > limits::IMAGE_SIDE {
        return Err(format!("an image of {full}, larger than is accepted"));
    }
    let info = scale.of(full);
    let side = |length: u32| u16::try_from(length).map_err(|error| error.to_string());
    let given = decoder.scale(side(info.width)?, side(info.height)?);
    let given = given.map_err(text)?;
    if (given.0.into(), given.1.into()) != (info.width, info.height) {
        return Err(format!("decoded as {given:?}, not as {info}"));
    }
    let pixels = decoder.decode().map_err(text)?;
    Ok((info, pixels))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decode::decode;
    use crate::encode::{encode_jpeg, encode_png};

    /// Light that changes smoothly, in every colour another way.
    fn smooth(format: PixelFormat) -> Frame {
        let info = FrameInfo {
            width: 61,
            height: 43,
            format,
        };
        let mut bytes = Vec::new();
        for y in 0..info.height {
            for x in 0..info.width {
                let light = [100 + 2 * x, 40 + 3 * y, 60 + x + y];
                let light = &light[..format.samples()];
                bytes.extend(
                    light
                        .iter()
                        .map(|light| u8::try_from(*light).expect("below 256")),
                );
            }
        }
        Frame::new(info, bytes).expect("whole")
    }

    #[test]
    fn every_scale_shows_the_means_of_the_full_picture() {
        for (format, order) in [
            (PixelFormat::Gray8, ChannelOrder::Gray),
            (PixelFormat::Rgb8, ChannelOrder::Rgb),
        ] {
            let file = encode_jpeg(&smooth(format), 95).expect("encodes");
            let (_, full) = decode(&file, order).expect("decodes");
            for scale in DecodeScale::ALL {
                let small = decode_scaled(&file, order, scale).expect("decodes");
                assert_eq!(small.info(), scale.of(full.info()));
                let off = furthest_off(&full, &small, scale.denominator() as usize);
                // Two levels of rounding in the file, two in the decoders.
                assert!(off < 4.0, "{format:?} {scale:?}: {off} levels");
            }
        }
    }

    /// How far a pixel of `small` is from the mean of those it stands for; the rim, which may stand for fewer, aside.
    fn furthest_off(full: &Frame, small: &Frame, side: usize) -> f64 {
        let depth = full.info().format.samples();
        let [wide, narrow] = [full, small].map(|frame| frame.info().width as usize);
        let (columns, rows) = (wide / side, full.info().height as usize / side);
        let mut worst = 0.0_f64;
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)))
        {
            for sample in 0..depth {
                let at =
                    |x: usize, y: usize| f64::from(full.bytes()[(y * wide + x) * depth + sample]);
                let pixels = (0..side * side).map(|at| (at % side, at / side));
                let sum: f64 = pixels
                    .map(|(x, y)| at(column * side + x, row * side + y))
                    .sum();
                let found = small.bytes()[(row * narrow + column) * depth + sample];
                worst = worst.max((sum / (side * side) as f64 - f64::from(found)).abs());
            }
        }
        worst
    }

    #[test]
    fn blue_green_red_is_swapped_back_at_every_scale() {
        let file = encode_jpeg(&smooth(PixelFormat::Rgb8), 90).expect("encodes");
        let decode = |order| decode_scaled(&file, order, DecodeScale::Eighth).expect("decodes");
        let [plain, swapped] = [ChannelOrder::Rgb, ChannelOrder::Bgr].map(decode);
        let pairs = plain.bytes().chunks(3).zip(swapped.bytes().chunks(3));
        assert!(
            pairs
                .into_iter()
                .all(|(left, right)| left.iter().eq(right.iter().rev()))
        );
    }

    #[test]
    fn a_png_and_a_file_that_was_cut_are_refused() {
        let png = encode_png(&smooth(PixelFormat::Gray8)).expect("encodes");
        let decode = |bytes: &[u8]| decode_scaled(bytes, ChannelOrder::Gray, DecodeScale::Half);
        let message = decode(&png).expect_err("a PNG");
        assert!(
            message.starts_with("a PNG or TIFF, which is decoded at its full size only"),
            "{message}"
        );
        let file = encode_jpeg(&smooth(PixelFormat::Gray8), 90).expect("encodes");
        for length in [0, 3, 20, file.len() / 2, file.len() - 1] {
            decode(&file[..length]).expect_err("cut");
        }
    }
}
