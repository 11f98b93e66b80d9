//! Mean, standard deviation and quantiles of the pixels of each cell.

use std::ops::Range;

use taceva_core::{Frame, FrameInfo, single};

use super::cell_features::CellFeatures;
use super::kinds::FeatureKind;
use super::pixels::{LUMA, LUMA_SUM, mixes};
use super::spec::{Color, FeatureSpec};

/// Quantiles of the pixel values, in %.
const QUANTILES: [usize; 5] = [5, 25, 50, 75, 95];
/// Number of values per cell and colour: mean, standard deviation and quantiles.
const NUMBERS: usize = 2 + QUANTILES.len();

/// Statistics of each colour in each cell: mean, population standard deviation, and the quantiles of 5, 25, 50, 75 and 95 %. The quantile of q % is
/// the least pixel value that at least q % of the pixels do not exceed.
///
/// Each pixel belongs to one cell. With `width` cells across a frame of W columns, cell i has columns `floor(i W / width) .. floor((i + 1) W /
/// width)`. Rows are divided likewise. Sums are integers, so every statistic depends only on the values of the cell's pixels, and not on their order.
/// The statistics describe the distribution of light in a cell, but not positions. A press gives the same values anywhere in its cell.
#[derive(Debug)]
pub(super) struct Statistics {
    color: Color,
    info: FrameInfo,
    columns: Vec<Range<usize>>,
    rows: Vec<Range<usize>>,
    reference: Option<Vec<f64>>,
}

impl Statistics {
    /// Prepares statistics for frames of `info`. A frame must not be smaller than the grid of `spec`.
    pub(super) fn new(
        spec: &FeatureSpec,
        info: FrameInfo,
        reference: Option<&Frame>,
    ) -> Statistics {
        let mut statistics = Statistics {
            color: spec.color,
            info,
            columns: cells(info.width as usize, spec.width as usize),
            rows: cells(info.height as usize, spec.height as usize),
            reference: None,
        };
        statistics.reference = reference.map(|frame| statistics.numbers(frame));
        statistics
    }

    /// Statistics of each plane of each cell, row by row.
    fn numbers(&self, frame: &Frame) -> Vec<f64> {
        let planes = self.color.depth();
        let (values, full_scale) = self.values(frame);
        let width = self.info.width as usize;
        let mut numbers = Vec::with_capacity(self.rows.len() * self.columns.len() * self.depth());
        let mut cell = Vec::new();
        for rows in &self.rows {
            for columns in &self.columns {
                for plane in 0..planes {
                    cell.clear();
                    for row in rows.clone() {
                        let pixels = (row * width + columns.start)..(row * width + columns.end);
                        let samples = &values[pixels.start * planes..pixels.end * planes];
                        cell.extend(samples.iter().skip(plane).step_by(planes));
                    }
                    cell.sort_unstable();
                    numbers.extend(of_sorted(&cell, full_scale));
                }
            }
        }
        numbers
    }

    /// Integer value of every pixel and colour, pixel by pixel, and the full scale of these values.
    fn values(&self, frame: &Frame) -> (Vec<u32>, f64) {
        let full_scale = f64::from(self.info.format.full_scale());
        let samples = frame.samples().map(u32::from);
        if !mixes(self.color, self.info.format) {
            return (samples.collect(), full_scale);
        }
        let samples: Vec<u32> = samples.collect();
        let (pixels, _) = samples.as_chunks::<3>();
        let gray = |pixel: &[u32; 3]| {
            let parts = pixel.iter().zip(LUMA);
            let sum: i64 = parts.map(|(&part, weight)| i64::from(part) * weight).sum();
            u32::try_from(sum).expect("a thousand times 65,535 at most")
        };
        (
            pixels.iter().map(gray).collect(),
            full_scale * LUMA_SUM as f64,
        )
    }
}

impl CellFeatures for Statistics {
    fn depth(&self) -> usize {
        FeatureKind::Statistics.depth(self.color)
    }

    fn write(&self, frame: &Frame, into: &mut [f32]) {
        for (position, (place, number)) in into.iter_mut().zip(self.numbers(frame)).enumerate() {
            let reference = self.reference.as_ref().map_or(0.0, |own| own[position]);
            *place = single(number - reference);
        }
    }
}

/// Pixel ranges of `count` cells along a side of `length` pixels.
fn cells(length: usize, count: usize) -> Vec<Range<usize>> {
    let start = |cell: usize| cell * length / count;
    (0..count)
        .map(|cell| start(cell)..start(cell + 1))
        .collect()
}

/// Mean, standard deviation and quantiles of `sorted`, scaled so that full scale is 1. `sorted` must not be empty.
fn of_sorted(sorted: &[u32], full_scale: f64) -> [f64; NUMBERS] {
    let count = sorted.len() as u128;
    let sum: u128 = sorted.iter().map(|&value| u128::from(value)).sum();
    let squares: u128 = sorted.iter().map(|&value| u128::from(value).pow(2)).sum();
    let scale = count as f64 * full_scale;
    let mut numbers = [0.0; NUMBERS];
    numbers[0] = sum as f64 / scale;
    // n Σv² - (Σv)² is n² times the variance, and as an integer at least 0.
    numbers[1] = ((count * squares - sum * sum) as f64).sqrt() / scale;
    for (number, hundredths) in numbers[2..].iter_mut().zip(QUANTILES) {
        let rank = (hundredths * sorted.len()).div_ceil(100);
        *number = f64::from(sorted[rank - 1]) / full_scale;
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::test_pictures::noise;
    use crate::features::{Extractor, FeatureKind};
    use taceva_core::PixelFormat;
    use taceva_core::random::SplitMix64;

    fn spec(width: u32, height: u32, color: Color) -> FeatureSpec {
        FeatureSpec {
            kinds: FeatureKind::Statistics.into(),
            width,
            height,
            color,
            ..FeatureSpec::default()
        }
    }

    fn features(frame: &Frame, spec: FeatureSpec) -> Vec<f32> {
        let extractor = Extractor::new(spec, frame.info(), None).expect("fits");
        let features = extractor.extract_all([frame]).expect("same kind");
        features.values().to_vec()
    }

    #[test]
    fn a_ramp_has_the_statistics_that_paper_gives() {
        // 0, 1, …, 99: mean 49.5, variance (100² - 1) / 12, and the 5th, 25th, … of a hundred.
        let info = FrameInfo {
            width: 10,
            height: 10,
            format: PixelFormat::Gray8,
        };
        let frame = Frame::new(info, (0..100).collect()).expect("whole");
        let found = features(&frame, spec(1, 1, Color::Gray));
        let expected = [
            49.5,
            (9999.0_f64 / 12.0).sqrt(),
            4.0,
            24.0,
            49.0,
            74.0,
            94.0,
        ];
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (f64::from(*found) - expected / 255.0).abs() < 1e-7,
                "{found} {expected}"
            );
        }
    }

    #[test]
    fn an_even_frame_has_no_spread_in_any_format() {
        for format in [PixelFormat::Gray16, PixelFormat::Rgb8, PixelFormat::Rgb16] {
            let info = noise(7, 5, format, 1).info();
            let white = vec![0xff; info.byte_len().expect("small")];
            let white = Frame::new(info, white).expect("whole");
            for cell in features(&white, spec(3, 2, Color::Gray)).chunks_exact(NUMBERS) {
                assert_eq!(cell, [1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
            }
        }
    }

    #[test]
    fn pixels_may_change_places_within_a_cell_and_no_bit_changes() {
        let mut random = SplitMix64::new(9);
        let frame = noise(12, 12, PixelFormat::Rgb16, 5);
        let mut pixels: Vec<[u8; 6]> = frame.bytes().as_chunks::<6>().0.to_vec();
        random.shuffle(&mut pixels);
        let shuffled = Frame::new(frame.info(), pixels.concat()).expect("whole");
        for color in [Color::Gray, Color::Rgb] {
            let spec = spec(1, 1, color);
            assert_eq!(features(&frame, spec), features(&shuffled, spec));
        }
    }

    #[test]
    fn every_pixel_belongs_to_one_cell() {
        for length in 1..60 {
            for count in 1..=length {
                let cells = cells(length, count);
                let pixels = cells.iter().cloned().flatten();
                assert_eq!(pixels.collect::<Vec<_>>(), (0..length).collect::<Vec<_>>());
                assert!(cells.iter().all(|cell| !cell.is_empty()));
            }
        }
    }

    #[test]
    fn a_difference_from_itself_is_zero() {
        let frame = noise(20, 20, PixelFormat::Rgb8, 1);
        let spec = FeatureSpec {
            difference: true,
            ..spec(4, 4, Color::Rgb)
        };
        let extractor = Extractor::new(spec, frame.info(), Some((&frame).into())).expect("fits");
        let features = extractor.extract_all([&frame]).expect("same kind");
        assert!(features.values().iter().all(|value| value.to_bits() == 0));
    }
}
