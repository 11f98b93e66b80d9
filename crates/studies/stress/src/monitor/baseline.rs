//! Mean of untouched pictures (without contact), and the difference of a picture from this mean.

use taceva_core::{Frame, FrameInfo, single};

/// Number of square cells across the width of a picture.
const ACROSS: usize = 16;

/// Mean of untouched pictures, and the division of a picture into cells.
#[derive(Clone, Debug)]
pub(super) struct Baseline {
    /// Mean of each pixel value over the untouched pictures.
    means: Vec<f32>,
    /// Index of the cell of each pixel value. A cell is a square of pixels of one colour.
    cells: Vec<u32>,
    /// Number of pixel values in each cell.
    counts: Vec<u32>,
    full: f64,
}

/// Difference of a picture from the mean of untouched pictures.
///
/// # Units
/// Fractions of full scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct Difference {
    /// Mean difference over all pixel values, above 0 for a brighter picture.
    pub(super) level: f64,
    /// Mean over all cells of the absolute mean difference of a cell, without the common change of brightness. Pixel noise hardly affects it.
    pub(super) pattern: f64,
    /// Mean over all pixel values of the absolute deviation of their difference from that of their cell, after the same correction.
    pub(super) detail: f64,
}

impl Baseline {
    /// Computes the mean of `count` pictures of the size and format `info`. `sums` has the sum of each pixel value over the pictures.
    pub(super) fn new(info: FrameInfo, sums: &[u32], count: u32) -> Baseline {
        let (width, height) = (info.width as usize, info.height as usize);
        let colours = info.format.samples();
        let across = ACROSS.min(width).max(1);
        // As square as whole cells allow.
        let down = ((height * across + width / 2) / width.max(1)).clamp(1, height.max(1));
        let mut cells = Vec::with_capacity(sums.len());
        let mut counts = vec![0; across * down * colours];
        for y in 0..height {
            for x in 0..width {
                let cell = y * down / height * across + x * across / width;
                for colour in 0..colours {
                    let cell = cell * colours + colour;
                    counts[cell] += 1;
                    cells.push(u32::try_from(cell).unwrap_or(u32::MAX));
                }
            }
        }
        let means = sums.iter();
        let means = means.map(|sum| single(f64::from(*sum) / f64::from(count)));
        Baseline {
            means: means.collect(),
            cells,
            counts,
            full: f64::from(info.format.full_scale()),
        }
    }

    /// Difference of `frame` from the mean. `frame` has the size and format of the baseline.
    pub(super) fn difference(&self, frame: &Frame) -> Difference {
        let numbers = self.means.len() as f64;
        let sum: f64 = self.means.iter().map(|mean| f64::from(*mean)).sum();
        let level = self.residuals(frame, 0.0).map(|of| of.value).sum::<f64>();
        // A picture of black has no factor.
        let factor = if sum > 0.0 { level / sum } else { 0.0 };
        let mut offsets = vec![0.0_f64; self.counts.len()];
        for of in self.residuals(frame, factor) {
            offsets[of.cell] += of.value;
        }
        for (offset, count) in offsets.iter_mut().zip(&self.counts) {
            *offset /= f64::from(*count);
        }
        let pattern: f64 = offsets.iter().map(|offset| offset.abs()).sum();
        let within = self.residuals(frame, factor);
        let detail: f64 = within.map(|of| (of.value - offsets[of.cell]).abs()).sum();
        Difference {
            level: level / (self.full * numbers),
            pattern: pattern / (self.full * offsets.len() as f64),
            detail: detail / (self.full * numbers),
        }
    }

    /// Difference of each pixel value of `frame` from the mean of this pixel value, minus `factor` times the mean.
    fn residuals<'a>(
        &'a self,
        frame: &'a Frame,
        factor: f64,
    ) -> impl Iterator<Item = Residual> + 'a {
        let means = frame.samples().zip(&self.means);
        means.zip(&self.cells).map(move |((number, mean), cell)| {
            let mean = f64::from(*mean);
            Residual {
                value: f64::from(number) - mean - factor * mean,
                cell: *cell as usize,
            }
        })
    }
}

/// Difference of one pixel value from its mean, and the index of its cell.
struct Residual {
    value: f64,
    cell: usize,
}

#[cfg(test)]
mod tests {
    use taceva_core::PixelFormat;

    use super::*;

    /// Difference of a gray picture of 32 × 32 pixels from a mean of 100. `change` gives the value of each pixel.
    fn difference(change: impl Fn(usize, usize) -> u8) -> Difference {
        let info = FrameInfo {
            width: 32,
            height: 32,
            format: PixelFormat::Gray8,
        };
        let baseline = Baseline::new(info, &[200; 1024], 2);
        let places = (0..1024).map(|place| 100 + change(place % 32, place / 32));
        let frame = Frame::new(info, places.collect()).expect("whole");
        baseline.difference(&frame)
    }

    #[test]
    fn level_pattern_and_detail_are_three_different_changes() {
        let near = |found: f64, expected: f64| (255.0 * found - expected).abs() < 1e-9;
        let brighter = difference(|_, _| 5);
        assert!(near(brighter.level, 5.0) && near(brighter.pattern, 0.0));
        let half = difference(|x, _| if x < 16 { 8 } else { 0 });
        assert!(near(half.level, 4.0) && near(half.pattern, 4.0) && near(half.detail, 0.0));
        let lines = difference(|x, _| if x % 2 == 0 { 8 } else { 0 });
        assert!(near(lines.level, 4.0) && near(lines.pattern, 0.0) && near(lines.detail, 4.0));
    }
}
