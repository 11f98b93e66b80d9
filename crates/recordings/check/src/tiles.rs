//! Mean brightness of the tiles of a picture, for comparing pictures without pixel noise.

use taceva_core::{Frame, single};

use crate::count::count;

/// Number of tiles across the width of a picture.
const ACROSS: usize = 8;

/// Mean brightness of square tiles, row by row, as fractions of full scale.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tiles {
    /// Number of tiles per row.
    across: usize,
    means: Vec<f32>,
}

impl Tiles {
    /// Tiles of `frame`, each an eighth of the frame width wide, averaged over all colours.
    pub(crate) fn of(frame: &Frame) -> Tiles {
        let info = frame.info();
        let (width, height) = (info.width as usize, info.height as usize);
        let depth = info.format.samples();
        let across = ACROSS.min(width).max(1);
        // As square as whole tiles allow.
        let down = ((height * across + width / 2) / width.max(1)).clamp(1, height.max(1));
        let mut sums = vec![0_u64; across * down];
        let mut counts = vec![0_u64; across * down];
        let mut add_row = |row: usize, values: &mut dyn Iterator<Item = u64>| {
            let first = row * down / height.max(1) * across;
            for (position, value) in values.enumerate() {
                let tile = first + position / depth * across / width.max(1);
                sums[tile] += value;
                counts[tile] += 1;
            }
        };
        let row_samples = width * depth;
        match info.format.bytes_per_sample() {
            1 => {
                for (row, bytes) in frame.bytes().chunks_exact(row_samples.max(1)).enumerate() {
                    add_row(row, &mut bytes.iter().map(|byte| u64::from(*byte)));
                }
            }
            _ => {
                let samples: Vec<u16> = frame.samples().collect();
                for (row, samples) in samples.chunks_exact(row_samples.max(1)).enumerate() {
                    add_row(row, &mut samples.iter().map(|sample| u64::from(*sample)));
                }
            }
        }
        let top = u64::from(info.format.full_scale());
        let means = sums
            .iter()
            .zip(&counts)
            .map(|(sum, count)| single(*sum as f64 / ((*count).max(1) * top) as f64));
        Tiles {
            across,
            means: means.collect(),
        }
    }

    /// Mean of each tile over several pictures; `None` for no picture, or for different sizes.
    pub(crate) fn mean<'a>(all: impl IntoIterator<Item = &'a Tiles>) -> Option<Tiles> {
        let mut all = all.into_iter();
        let first = all.next()?;
        let mut sums: Vec<f64> = first.means.iter().map(|mean| f64::from(*mean)).collect();
        let mut count = 1.0;
        for tiles in all {
            if !tiles.is_like(first) {
                return None;
            }
            let pairs = sums.iter_mut().zip(&tiles.means);
            pairs.for_each(|(sum, mean)| *sum += f64::from(*mean));
            count += 1.0;
        }
        let means = sums.into_iter().map(|sum| single(sum / count)).collect();
        Some(Tiles {
            across: first.across,
            means,
        })
    }

    /// Mean absolute difference of the tiles, as a fraction of full scale; infinite if the numbers of tiles differ.
    pub(crate) fn distance(&self, other: &Tiles) -> f64 {
        if !self.is_like(other) {
            return f64::INFINITY;
        }
        let sum: f64 = self.differences(other).sum();
        sum / count(self.means.len().max(1))
    }

    /// Maximum absolute difference of two tiles at one place, as a fraction of full scale; infinite if the numbers of tiles differ.
    pub(crate) fn greatest(&self, other: &Tiles) -> f64 {
        if !self.is_like(other) {
            return f64::INFINITY;
        }
        self.differences(other).fold(0.0, f64::max)
    }

    fn differences<'a>(&'a self, other: &'a Tiles) -> impl Iterator<Item = f64> + 'a {
        let pairs = self.means.iter().zip(&other.means);
        pairs.map(|(one, other)| f64::from((one - other).abs()))
    }

    fn is_like(&self, other: &Tiles) -> bool {
        self.across == other.across && self.means.len() == other.means.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{FrameInfo, PixelFormat};

    fn gray(width: u32, height: u32, light: impl Fn(u32, u32) -> u8) -> Frame {
        let info = FrameInfo {
            width,
            height,
            format: PixelFormat::Gray8,
        };
        let rows = 0..height;
        let bytes = rows.flat_map(|y| (0..width).map(move |x| (x, y)));
        Frame::new(info, bytes.map(|(x, y)| light(x, y)).collect()).expect("whole")
    }

    #[test]
    fn a_dark_eighth_of_a_picture_is_one_tile_of_many() {
        let flat = Tiles::of(&gray(80, 40, |_, _| 102));
        let dark = Tiles::of(&gray(
            80,
            40,
            |x, y| if x < 10 && y < 10 { 51 } else { 102 },
        ));
        assert_eq!(flat.means.len(), 32);
        assert!((flat.greatest(&dark) - 0.2).abs() < 1e-6);
        assert!((flat.distance(&dark) - 0.2 / 32.0).abs() < 1e-6);
        let mean = Tiles::mean([&flat, &dark]).expect("of one size");
        assert!((mean.greatest(&flat) - 0.1).abs() < 1e-6);
    }

    #[test]
    fn pictures_of_a_pixel_and_of_other_sizes_have_tiles_and_no_panic() {
        let pixel = Tiles::of(&gray(1, 1, |_, _| 255));
        let strip = Tiles::of(&gray(3, 50, |_, _| 255));
        assert_eq!(pixel.distance(&pixel).to_bits(), 0.0_f64.to_bits());
        assert!(pixel.distance(&strip).is_infinite());
        assert_eq!(Tiles::mean([&pixel, &strip]), None);
    }
}
