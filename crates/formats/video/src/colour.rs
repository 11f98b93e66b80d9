//! Conversion of luma and chroma to red, green and blue, with integer arithmetic.

use std::path::Path;

use crate::error::VideoError;

/// Colour coding of luma and chroma.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct YuvCoding {
    /// Matrix number of ITU-T H.273; `None` if the stream states none.
    pub(crate) matrix: Option<u16>,
    /// True for samples from 0 to 255. False for luma from 16 to 235 and chroma from 16 to 240.
    pub(crate) is_full_range: bool,
}

/// Planes of a frame of 8 bits per sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planes<'a> {
    width: usize,
    height: usize,
    luma: &'a [u8],
    /// Planes of blue and red chroma; `None` for gray.
    chroma: Option<[&'a [u8]; 2]>,
    /// Number of pixels per chroma sample as powers of two, along a row and along a column.
    shifts: [u32; 2],
}

/// Matrix number that is not supported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UnknownMatrix(u16);

impl UnknownMatrix {
    pub(crate) fn at(self, path: &Path) -> VideoError {
        VideoError::Colours {
            path: path.to_owned(),
            matrix: self.0,
        }
    }
}

impl<'a> Planes<'a> {
    /// Planes without padding in the rows. Each chroma sample covers `1 << shifts[0]` by `1 << shifts[1]` pixels.
    ///
    /// # Panics
    /// Panics if a plane is too small. Decoders check the sizes first.
    pub(crate) fn new(
        width: u32,
        height: u32,
        luma: &'a [u8],
        chroma: Option<[&'a [u8]; 2]>,
        shifts: [u32; 2],
    ) -> Planes<'a> {
        let (width, height) = (width as usize, height as usize);
        assert!(luma.len() >= width * height, "luma of {} bytes", luma.len());
        let least = shifted(width, shifts[0]) * shifted(height, shifts[1]);
        for plane in chroma.into_iter().flatten() {
            assert!(plane.len() >= least, "chroma of {} bytes", plane.len());
        }
        Planes {
            width,
            height,
            luma: &luma[..width * height],
            chroma,
            shifts,
        }
    }

    /// Converts each pixel to red, green and blue with the nearest chroma sample, in fixed-point arithmetic with 8 fractional bits.
    ///
    /// # Errors
    /// [`UnknownMatrix`] for a matrix other than BT.601, BT.709, FCC, SMPTE 240M and BT.2020.
    pub(crate) fn to_rgb(self, coding: YuvCoding) -> Result<Vec<u8>, UnknownMatrix> {
        let Factors {
            luma,
            offset,
            red_of_red,
            green_of_blue,
            green_of_red,
            blue_of_blue,
        } = Factors::of(coding)?;
        let mut rgb = Vec::with_capacity(self.width * self.height * 3);
        let chroma_width = shifted(self.width, self.shifts[0]);
        for (row, line) in self.luma.chunks_exact(self.width).enumerate() {
            let from = (row >> self.shifts[1]) * chroma_width;
            for (column, &sample) in line.iter().enumerate() {
                let at = from + (column >> self.shifts[0]);
                let [blue, red] = self.chroma.map_or([0, 0], |planes| {
                    planes.map(|plane| i32::from(plane[at]) - 128)
                });
                // Adds half a step, so that the shift rounds to nearest.
                let light = (i32::from(sample) - offset) * luma + 128;
                let mixed = [
                    light + red_of_red * red,
                    light - green_of_blue * blue - green_of_red * red,
                    light + blue_of_blue * blue,
                ];
                rgb.extend(
                    mixed.map(|value| u8::try_from((value >> 8).clamp(0, 255)).unwrap_or(0)),
                );
            }
        }
        Ok(rgb)
    }
}

/// Divides a length by `1 << shift`, rounded up.
fn shifted(length: usize, shift: u32) -> usize {
    (length + (1 << shift) - 1) >> shift
}

/// Conversion factors of samples, in units of 1/256.
struct Factors {
    luma: i32,
    /// Luma value of black.
    offset: i32,
    red_of_red: i32,
    green_of_blue: i32,
    green_of_red: i32,
    blue_of_blue: i32,
}

impl Factors {
    /// Computes the factors from the weights K_r and K_b of red and blue in luma.
    ///
    /// With luma Y and chroma U (blue) and V (red): R = Y + 2 (1 − K_r) V, B = Y + 2 (1 − K_b) U. G follows from Y, the weighted sum of R, G and B.
    fn of(coding: YuvCoding) -> Result<Factors, UnknownMatrix> {
        // Unspecified means BT.601, as in other decoders.
        let (of_red, of_blue) = match coding.matrix.unwrap_or(2) {
            1 => (0.2126, 0.0722),
            2 | 3 | 5 | 6 => (0.299, 0.114),
            4 => (0.30, 0.11),
            7 => (0.212, 0.087),
            9 | 10 => (0.2627, 0.0593),
            other => return Err(UnknownMatrix(other)),
        };
        let (luma_scale, chroma_scale, offset) = match coding.is_full_range {
            true => (1.0, 1.0, 0),
            false => (255.0 / 219.0, 255.0 / 224.0, 16),
        };
        let green = 1.0 - of_red - of_blue;
        #[expect(clippy::cast_possible_truncation, reason = "at most 3 times 256")]
        let fixed = |factor: f64| (factor * 256.0).round() as i32;
        Ok(Factors {
            luma: fixed(luma_scale),
            offset,
            red_of_red: fixed(2.0 * (1.0 - of_red) * chroma_scale),
            green_of_blue: fixed(2.0 * (1.0 - of_blue) * of_blue / green * chroma_scale),
            green_of_red: fixed(2.0 * (1.0 - of_red) * of_red / green * chroma_scale),
            blue_of_blue: fixed(2.0 * (1.0 - of_blue) * chroma_scale),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rgb(luma: u8, blue: u8, red: u8, matrix: Option<u16>, is_full_range: bool) -> [u8; 3] {
        let planes = [[luma], [blue], [red]];
        let planes = Planes::new(1, 1, &planes[0], Some([&planes[1], &planes[2]]), [0, 0]);
        let rgb = planes
            .to_rgb(YuvCoding {
                matrix,
                is_full_range,
            })
            .expect("known");
        rgb.try_into().expect("three")
    }

    #[test]
    fn black_white_and_the_primaries_are_what_they_are_called() {
        for matrix in [None, Some(1), Some(5), Some(9)] {
            assert_eq!(rgb(16, 128, 128, matrix, false), [0, 0, 0]);
            assert_eq!(rgb(235, 128, 128, matrix, false), [255, 255, 255]);
            assert_eq!(rgb(77, 128, 128, matrix, true), [77, 77, 77]);
        }
        // BT.601, limited: red is (81, 90, 240), BT.709: (63, 102, 240).
        for (coded, matrix) in [((81, 90, 240), Some(6)), ((63, 102, 240), Some(1))] {
            let [red, green, blue] = rgb(coded.0, coded.1, coded.2, matrix, false);
            assert!(
                red >= 253 && green <= 2 && blue <= 2,
                "{red} {green} {blue}"
            );
        }
    }

    #[test]
    fn chroma_is_that_of_the_nearest_sample() {
        // 3×3 pixels: chroma of 2×2 samples.
        let luma = [128; 9];
        let (blue, red) = ([128; 4], [128, 128, 128, 255]);
        let planes = Planes::new(3, 3, &luma, Some([&blue, &red]), [1, 1]);
        let rgb = planes
            .to_rgb(YuvCoding {
                matrix: None,
                is_full_range: true,
            })
            .expect("known");
        let reds: Vec<u8> = rgb.chunks(3).map(|pixel| pixel[0]).collect();
        assert_eq!(reds, [128, 128, 128, 128, 128, 128, 128, 128, 255]);
    }

    #[test]
    fn a_matrix_of_no_known_kind_is_refused() {
        let planes = Planes::new(1, 1, &[0], None, [0, 0]);
        let refused = planes.to_rgb(YuvCoding {
            matrix: Some(8),
            is_full_range: true,
        });
        assert_eq!(refused, Err(UnknownMatrix(8)));
    }
}
