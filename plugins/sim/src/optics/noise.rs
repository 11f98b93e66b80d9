//! Noise from a tile of normal numbers. Each row starts at a different place of the tile.
//!
//! A new normal number for each pixel would cost more than the rest of a frame. Therefore 65,536 numbers are drawn once. The noise of a row is a section of
//! this tile with a random start and sign. Numbers within a row are independent. Rows with overlapping sections have equal numbers at different positions. A
//! test bounds the effect on the statistics of a frame.

use std::sync::OnceLock;

use crate::number::{count, narrow};
use crate::random::{Purpose, Random, Stream};

/// Count of numbers in the tile.
const TILE: usize = 1 << 16;
/// Longest row, samples: three colours of 16,384 pixels. The end of the tile repeats as many numbers of its start.
pub(super) const LONGEST_ROW: usize = 3 << 14;
/// Fixed seed, because the tile is a constant of the model.
const TILE_SEED: u64 = 0x7411_e5ee_d0ff_0a15;

/// Noise of one row: a section of the tile, with a sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowNoise {
    pub(super) normal: &'static [f32],
    pub(super) sign: f32,
}

/// Noise of a row of `length` samples.
pub(super) fn row(stream: &Stream, index: u64, length: usize) -> RowNoise {
    let bits = stream.bits(index);
    let start = usize::from(u16::try_from(bits & 0xffff).expect("masked to 16 bits"));
    RowNoise {
        normal: &tile()[start..start + length],
        sign: if bits & 0x1_0000 == 0 { 1.0 } else { -1.0 },
    }
}

/// Draws the tile, once.
pub(super) fn prepare() {
    tile();
}

/// 65,536 numbers of mean 0 and standard deviation 1, followed by a copy of the first numbers.
fn tile() -> &'static [f32] {
    static NUMBERS: OnceLock<Vec<f32>> = OnceLock::new();
    NUMBERS.get_or_init(|| {
        let stream = Random::new(TILE_SEED).stream(Purpose::PixelNoise, 0);
        let drawn: Vec<f64> = (0..TILE as u64).map(|index| stream.normal(index)).collect();
        // Standardised, so the draw does not shift the mean of a frame.
        let mean = drawn.iter().sum::<f64>() / count(TILE);
        let variance = drawn.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count(TILE);
        let scale = 1.0 / variance.sqrt();
        let standard = drawn.iter().map(|x| narrow((x - mean) * scale));
        let mut numbers: Vec<f32> = standard.collect();
        numbers.extend_from_within(..LONGEST_ROW);
        numbers
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tile_is_standard_normal() {
        let moment = |power: i32| {
            let sum: f64 = tile()[..TILE]
                .iter()
                .map(|x| f64::from(*x).powi(power))
                .sum();
            sum / count(TILE)
        };
        assert!(moment(1).abs() < 1e-6);
        assert!((moment(2) - 1.0).abs() < 1e-5);
        // Standard errors of skewness and kurtosis: √(6/n) and √(24/n).
        assert!(moment(3).abs() < 4.0 * (6.0 / count(TILE)).sqrt());
        assert!((moment(4) - 3.0).abs() < 4.0 * (24.0 / count(TILE)).sqrt());
    }

    #[test]
    fn a_row_is_a_function_of_its_index() {
        let stream = Random::new(3).stream(Purpose::PixelNoise, 9);
        let start = |index| row(&stream, index, 8).normal.as_ptr();
        assert_eq!(start(5), start(5));
        assert_ne!(start(5), start(6));
        assert_eq!(row(&stream, 0, LONGEST_ROW).normal.len(), LONGEST_ROW);
    }
}
