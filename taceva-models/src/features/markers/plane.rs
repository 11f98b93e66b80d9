//! Gray pictures, and local means of their pixels.

use taceva_core::{Frame, single};

use crate::features::pixels::{LUMA, LUMA_SUM};

/// Gray picture: brightness of its pixels row by row. Full scale is 1.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<f32>,
}

impl Plane {
    /// Converts `frame` to gray: luma by Rec. ITU-R BT.601, where full scale is 1.
    pub(super) fn of(frame: &Frame) -> Plane {
        let info = frame.info();
        let full_scale = f64::from(info.format.full_scale());
        let values = if info.format.samples() == 1 {
            let gray = |sample| single(f64::from(sample) / full_scale);
            frame.samples().map(gray).collect()
        } else {
            let scale = full_scale * LUMA_SUM as f64;
            let weights = LUMA.map(|weight| weight as f64);
            let samples: Vec<u16> = frame.samples().collect();
            let (pixels, _) = samples.as_chunks::<3>();
            let gray = |pixel: &[u16; 3]| {
                let parts = pixel.iter().zip(weights);
                let sum: f64 = parts.map(|(&part, weight)| f64::from(part) * weight).sum();
                single(sum / scale)
            };
            pixels.iter().map(gray).collect()
        };
        Plane {
            width: info.width as usize,
            height: info.height as usize,
            values,
        }
    }

    /// Mean around each pixel, over a square with sides of `2 radius + 1` pixels. Near the border the square shrinks to both sides alike. The mean of
    /// brightness that changes linearly thus equals the brightness at the pixel.
    pub(super) fn local_mean(&self, radius: usize) -> Plane {
        let across = self.means_across(radius);
        Plane {
            values: self.means_down(&across, radius),
            ..*self
        }
    }

    fn means_across(&self, radius: usize) -> Vec<f64> {
        let mut means = Vec::with_capacity(self.values.len());
        let mut sums = vec![0.0; self.width + 1];
        for row in self.values.chunks_exact(self.width) {
            for (column, &value) in row.iter().enumerate() {
                sums[column + 1] = sums[column] + f64::from(value);
            }
            means.extend((0..self.width).map(|column| {
                let (first, end) = window(column, radius, self.width);
                (sums[end] - sums[first]) / (end - first) as f64
            }));
        }
        means
    }

    /// Mean of each value's column over up to `radius` rows above and below it. Running sums add one row and subtract one row per step.
    fn means_down(&self, values: &[f64], radius: usize) -> Vec<f32> {
        let row = |index: usize| &values[index * self.width..][..self.width];
        let mut sums = vec![0.0; self.width];
        let mut means = Vec::with_capacity(values.len());
        let (mut first, mut end) = (0, 0);
        for index in 0..self.height {
            let (wanted_first, wanted_end) = window(index, radius, self.height);
            while end < wanted_end {
                for (sum, value) in sums.iter_mut().zip(row(end)) {
                    *sum += value;
                }
                end += 1;
            }
            while first < wanted_first {
                for (sum, value) in sums.iter_mut().zip(row(first)) {
                    *sum -= value;
                }
                first += 1;
            }
            let count = (end - first) as f64;
            means.extend(sums.iter().map(|sum| single(sum / count)));
        }
        means
    }

    /// Standard deviation of the noise of pixels, estimated from a median so that edges hardly count. At least the standard deviation of rounding to
    /// 8 bits.
    pub(super) fn noise(&self) -> f32 {
        /// Factor from the median absolute deviation to the standard deviation, for normal noise from which the mean of nine pixels was subtracted.
        const DEVIATIONS: f32 = 1.4826 * 1.0607;
        /// Standard deviation of rounding to 8 bits, relative to full scale: one level divided by √12.
        const ROUNDING: f32 = 0.2887 / 255.0;
        let means = self.local_mean(1);
        let pairs = self.values.iter().zip(&means.values);
        let mut apart: Vec<f32> = pairs.map(|(value, mean)| (value - mean).abs()).collect();
        let middle = apart.len() / 2;
        let (_, median, _) = apart.select_nth_unstable_by(middle, f32::total_cmp);
        (DEVIATIONS * *median).max(ROUNDING)
    }
}

/// Range of indices, end excluded, that extends equally to both sides of `position`: by `radius`, or less at the ends of `length` values.
fn window(position: usize, radius: usize, length: usize) -> (usize, usize) {
    let radius = radius.min(position).min(length - 1 - position);
    (position - radius, position + radius + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::test_pictures::noise;
    use taceva_core::PixelFormat;

    #[test]
    fn local_means_are_those_of_their_definition_up_to_the_border() {
        let plane = Plane::of(&noise(13, 9, PixelFormat::Rgb8, 4));
        for radius in [0, 1, 3, 20] {
            let means = plane.local_mean(radius);
            for (position, mean) in means.values.iter().enumerate() {
                let (row, column) = (position / 13, position % 13);
                let [up, left] = [(row, 9), (column, 13)]
                    .map(|(at, length)| radius.min(at).min(length - 1 - at));
                let (mut sum, mut count) = (0.0, 0.0);
                for y in row - up..=row + up {
                    for x in column - left..=column + left {
                        sum += f64::from(plane.values[y * 13 + x]);
                        count += 1.0;
                    }
                }
                assert!((f64::from(*mean) - sum / count).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn noise_is_recognised_by_its_standard_deviation() {
        // Uniformly distributed bytes have a standard deviation of 256 / √12 levels.
        let found = Plane::of(&noise(200, 200, PixelFormat::Gray8, 1)).noise();
        let truth = 256.0 / 12.0_f32.sqrt() / 255.0;
        assert!((found / truth - 1.0).abs() < 0.3, "{found} for {truth}");
    }
}
