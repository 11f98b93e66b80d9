//! Conversion of raw ffmpeg frames to pictures.

use super::format::{Layout, bytes_of, chroma_side};
use crate::clip::{Colours, Picture};
use crate::colour::{Planes, UnknownMatrix, YuvCoding};

/// Layout and colour coding of a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct RawFrame {
    pub(super) layout: Layout,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) coding: YuvCoding,
}

/// Reason why a frame has no picture of the requested colours.
pub(super) enum Refused {
    NoLuma,
    Matrix(UnknownMatrix),
}

impl RawFrame {
    /// Converts the frame `bytes`, which must have the size of the layout.
    pub(super) fn picture(&self, bytes: Vec<u8>, colours: Colours) -> Result<Picture, Refused> {
        let (width, height) = (self.width, self.height);
        let pixels = width as usize * height as usize;
        let samples = match (self.layout, colours) {
            (Layout::Packed { .. } | Layout::Planes, Colours::Luma) => return Err(Refused::NoLuma),
            (Layout::Packed { step, order }, Colours::Rgb) => bytes
                .chunks_exact(step)
                .flat_map(|pixel| order.map(|at| pixel[at]))
                .collect(),
            (Layout::Planes, Colours::Rgb) => {
                let (green, rest) = bytes.split_at(pixels);
                let (blue, red) = rest.split_at(pixels);
                let colours = red.iter().zip(green).zip(blue);
                colours
                    .flat_map(|((red, green), blue)| [*red, *green, *blue])
                    .collect()
            }
            (Layout::Gray { bits } | Layout::Planar { bits, .. }, Colours::Luma) if bits > 8 => {
                let luma = bytes.chunks_exact(2).take(pixels);
                return Ok(Picture::Deep {
                    width,
                    height,
                    bits,
                    samples: luma
                        .map(|two| u16::from_le_bytes([two[0], two[1]]))
                        .collect(),
                });
            }
            (
                Layout::Gray { .. } | Layout::Planar { .. } | Layout::Paired { .. },
                Colours::Luma,
            ) => {
                let mut luma = bytes;
                luma.truncate(pixels);
                luma
            }
            (Layout::Woven { luma, .. }, Colours::Luma) => {
                bytes.iter().skip(luma).step_by(2).copied().collect()
            }
            (_, Colours::Rgb) => self.rgb(&bytes).map_err(Refused::Matrix)?,
        };
        Ok(Picture::Pixels {
            width,
            height,
            samples,
        })
    }

    /// Converts luma and chroma to red, green and blue of 8 bits each.
    fn rgb(&self, bytes: &[u8]) -> Result<Vec<u8>, UnknownMatrix> {
        let pixels = self.width as usize * self.height as usize;
        let planes = |luma: &[u8], chroma: Option<[&[u8]; 2]>, shifts| {
            Planes::new(self.width, self.height, luma, chroma, shifts).to_rgb(self.coding)
        };
        match self.layout {
            Layout::Planar { shifts, bits, .. } => {
                let bytes = of_8_bits(bytes, bits);
                let (luma, chroma) = bytes.split_at(pixels);
                let each = chroma_side(self.width as usize, shifts[0])
                    * chroma_side(self.height as usize, shifts[1]);
                let (blue, red) = chroma.split_at(each);
                planes(luma, Some([blue, red]), shifts)
            }
            Layout::Paired { is_red_first } => {
                let (luma, pairs) = bytes.split_at(pixels);
                let first: Vec<u8> = pairs.iter().step_by(2).copied().collect();
                let second: Vec<u8> = pairs.iter().skip(1).step_by(2).copied().collect();
                let chroma: [&[u8]; 2] = match is_red_first {
                    true => [&second, &first],
                    false => [&first, &second],
                };
                planes(luma, Some(chroma), [1, 1])
            }
            Layout::Woven { luma, blue, red } => {
                let every = |from: usize, step| {
                    bytes
                        .iter()
                        .skip(from)
                        .step_by(step)
                        .copied()
                        .collect::<Vec<u8>>()
                };
                let (luma, blue, red) = (every(luma, 2), every(blue, 4), every(red, 4));
                planes(&luma, Some([&blue, &red]), [1, 0])
            }
            Layout::Gray { bits } => planes(&of_8_bits(bytes, bits), None, [0, 0]),
            // The picture consists of colours already. The caller handles these layouts.
            Layout::Packed { .. } | Layout::Planes => Ok(Vec::new()),
        }
    }
}

/// Reduces little-endian samples of `bits` bits to their upper 8 bits.
fn of_8_bits(bytes: &[u8], bits: u32) -> std::borrow::Cow<'_, [u8]> {
    if bytes_of(bits) == 1 {
        return bytes.into();
    }
    let upper = |two: &[u8]| {
        let sample = u16::from_le_bytes([two[0], two[1]]) >> (bits - 8);
        u8::try_from(sample).unwrap_or(u8::MAX)
    };
    bytes.chunks_exact(2).map(upper).collect::<Vec<u8>>().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(name: &str, width: u32, height: u32) -> RawFrame {
        RawFrame {
            layout: Layout::of(name).expect(name),
            width,
            height,
            coding: YuvCoding {
                matrix: None,
                is_full_range: true,
            },
        }
    }

    fn samples(frame: RawFrame, bytes: &[u8], colours: Colours) -> Option<Vec<u8>> {
        match frame.picture(bytes.to_vec(), colours) {
            Ok(Picture::Pixels { samples, .. }) => Some(samples),
            Ok(other) => panic!("{other:?}"),
            Err(_) => None,
        }
    }

    #[test]
    fn luma_is_where_the_layout_says() {
        let luma = |name, width, bytes: &[u8]| samples(frame(name, width, 1), bytes, Colours::Luma);
        assert_eq!(luma("yuyv422", 2, &[7, 1, 9, 2]), Some(vec![7, 9]));
        assert_eq!(luma("uyvy422", 2, &[1, 7, 2, 9]), Some(vec![7, 9]));
        assert_eq!(luma("yuv444p", 2, &[7, 9, 1, 1, 2, 2]), Some(vec![7, 9]));
        assert_eq!(luma("nv12", 2, &[7, 9, 1, 2]), Some(vec![7, 9]));
        assert_eq!(luma("rgb24", 1, &[1, 2, 3]), None);
        let deep =
            frame("yuv420p10le", 2, 1).picture(vec![0xff, 3, 1, 0, 0, 2, 0, 2], Colours::Luma);
        let Ok(Picture::Deep {
            bits: 10, samples, ..
        }) = deep
        else {
            panic!("10 bits");
        };
        assert_eq!(samples, [1023, 1]);
    }

    #[test]
    fn colours_are_put_in_order() {
        let rgb = |name, width, bytes: &[u8]| samples(frame(name, width, 1), bytes, Colours::Rgb);
        for (name, bytes) in [
            ("rgb24", [10, 20, 30, 0]),
            ("bgr24", [30, 20, 10, 0]),
            ("bgr0", [30, 20, 10, 99]),
            ("argb", [99, 10, 20, 30]),
            ("abgr", [99, 30, 20, 10]),
            ("gbrp", [20, 30, 10, 0]),
        ] {
            let length = frame(name, 1, 1).layout.frame_bytes(1, 1).expect("small");
            assert_eq!(
                rgb(name, 1, &bytes[..length]),
                Some(vec![10, 20, 30]),
                "{name}"
            );
        }
        assert_eq!(rgb("gray", 2, &[7, 9]), Some(vec![7, 7, 7, 9, 9, 9]));
        // More red: the red chroma is above its middle.
        for (name, bytes) in [
            ("yuyv422", vec![100, 128, 100, 178]),
            ("yvyu422", vec![100, 178, 100, 128]),
            ("uyvy422", vec![128, 100, 178, 100]),
            ("nv12", vec![100, 100, 128, 178]),
            ("nv21", vec![100, 100, 178, 128]),
            ("yuv422p", vec![100, 100, 128, 178]),
            ("yuv420p10le", vec![0x90, 1, 0x90, 1, 0, 2, 0xc8, 2]),
        ] {
            assert_eq!(
                rgb(name, 2, &bytes),
                Some(vec![170, 64, 100, 170, 64, 100]),
                "{name}"
            );
        }
    }
}
