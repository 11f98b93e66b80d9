//! Preprocessing of pictures for networks. The preprocessing is part of the model, and stored in the model's file.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use taceva_core::{FeatureShape, single, whole_size};

/// Preprocessing applied to each picture.
///
/// Preprocessing removes slow changes of brightness within a picture and between pictures. For a sensor with markers, these changes contain little
/// information on the contact. A sensor that shows contact by colour needs them, and should be used without preprocessing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Preprocessing {
    /// Standard deviation of a Gaussian, in pixels. The mean of a pixel's surroundings, weighted by this Gaussian, is subtracted from the pixel; 0
    /// subtracts nothing.
    pub local_mean_px: f64,
    /// True to subtract the mean of each picture and divide by its standard deviation. All pixels of a uniform picture become 0.
    pub contrast: bool,
}

/// Radius at which the Gaussian is cut off, in standard deviations.
const REACH: f64 = 3.0;

impl Preprocessing {
    /// Largest standard deviation of the Gaussian, in pixels.
    pub const LOCAL_MEAN_MAX: f64 = 100.0;

    /// True if all settings are in range.
    pub(crate) fn is_valid(&self) -> bool {
        (0.0..=Preprocessing::LOCAL_MEAN_MAX).contains(&self.local_mean_px)
    }

    /// Preprocesses each picture of `values` separately, so that one picture does not affect the prediction of another.
    pub(crate) fn apply(&self, shape: FeatureShape, values: &[f32]) -> Vec<f32> {
        let kernel = self.kernel();
        let mut changed = values.to_vec();
        changed
            .par_chunks_mut(shape.len().max(1))
            .for_each(|picture| {
                if let Some(kernel) = &kernel {
                    subtract_local_mean(kernel, shape, picture);
                }
                if self.contrast {
                    normalise_contrast(picture);
                }
            });
        changed
    }

    /// Weights of the Gaussian at distances of 0, 1, … pixels; `None` if no local mean is subtracted.
    fn kernel(&self) -> Option<Vec<f64>> {
        let sigma = self.local_mean_px;
        (sigma > 0.0).then(|| {
            let reach = whole_size((REACH * sigma).ceil());
            let weight = |distance: usize| (-0.5 * (distance as f64 / sigma).powi(2)).exp();
            (0..=reach).map(weight).collect()
        })
    }
}

/// Subtracts from each value the weighted mean of its surroundings within the picture.
fn subtract_local_mean(kernel: &[f64], shape: FeatureShape, picture: &mut [f32]) {
    let FeatureShape {
        height,
        width,
        depth,
    } = shape;
    let along = |at: usize, length: usize| {
        let first = at.saturating_sub(kernel.len() - 1);
        let last = (at + kernel.len() - 1).min(length - 1);
        first..=last
    };
    // Rows first, then columns: the Gaussian is separable, and so is its share within the picture.
    let mut rows = vec![0.0_f64; picture.len()];
    for (row, means) in picture
        .chunks_exact(width * depth)
        .zip(rows.chunks_exact_mut(width * depth))
    {
        for x in 0..width {
            let mut weights = 0.0;
            for near in along(x, width) {
                let weight = kernel[near.abs_diff(x)];
                weights += weight;
                for channel in 0..depth {
                    means[x * depth + channel] += weight * f64::from(row[near * depth + channel]);
                }
            }
            means[x * depth..][..depth]
                .iter_mut()
                .for_each(|mean| *mean /= weights);
        }
    }
    for (y, row) in picture.chunks_exact_mut(width * depth).enumerate() {
        let mut means = vec![0.0_f64; row.len()];
        let mut weights = 0.0;
        for near in along(y, height) {
            let weight = kernel[near.abs_diff(y)];
            weights += weight;
            let others = &rows[near * row.len()..][..row.len()];
            let places = means.iter_mut().zip(others);
            places.for_each(|(mean, other)| *mean += weight * other);
        }
        for (value, mean) in row.iter_mut().zip(means) {
            *value = single(f64::from(*value) - mean / weights);
        }
    }
}

/// Subtracts the mean of a picture, and divides by the picture's standard deviation.
fn normalise_contrast(picture: &mut [f32]) {
    let count = picture.len() as f64;
    let values = || picture.iter().copied().map(f64::from);
    let mean = values().sum::<f64>() / count;
    let variance = values().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    let scale = if variance > 0.0 {
        1.0 / variance.sqrt()
    } else {
        0.0
    };
    for value in picture {
        *value = single((f64::from(*value) - mean) * scale);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPE: FeatureShape = FeatureShape {
        height: 5,
        width: 7,
        depth: 2,
    };

    fn picture() -> Vec<f32> {
        let mut random = taceva_core::random::SplitMix64::new(3);
        (0..SHAPE.len())
            .map(|_| f32::from(random.next_u64().to_le_bytes()[0]) / 255.0)
            .collect()
    }

    #[test]
    fn the_local_mean_is_that_of_the_definition() {
        let (sigma, values) = (1.3, picture());
        let only = Preprocessing {
            local_mean_px: sigma,
            contrast: false,
        };
        let found = only.apply(SHAPE, &values);
        let at = |y: usize, x: usize, channel: usize| (y * SHAPE.width + x) * 2 + channel;
        for (y, x) in (0..5).flat_map(|y| (0..7).map(move |x| (y, x))) {
            for channel in 0..2 {
                let (mut sum, mut weights) = (0.0, 0.0);
                for (near_y, near_x) in (0..5_usize).flat_map(|y| (0..7_usize).map(move |x| (y, x)))
                {
                    let (dy, dx) = (near_y.abs_diff(y), near_x.abs_diff(x));
                    // Four pixels is three standard deviations, rounded up.
                    if dy > 4 || dx > 4 {
                        continue;
                    }
                    let square = (dy * dy + dx * dx) as f64;
                    let weight = (-square / (2.0 * sigma * sigma)).exp();
                    sum += weight * f64::from(values[at(near_y, near_x, channel)]);
                    weights += weight;
                }
                let expected = f64::from(values[at(y, x, channel)]) - sum / weights;
                assert!((f64::from(found[at(y, x, channel)]) - expected).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn contrast_does_not_depend_on_light_and_an_even_picture_stays_zero() {
        let both = Preprocessing {
            local_mean_px: 2.0,
            contrast: true,
        };
        let values = picture();
        let brighter: Vec<f32> = values.iter().map(|value| 0.5 * value + 0.25).collect();
        let (found, other) = (both.apply(SHAPE, &values), both.apply(SHAPE, &brighter));
        assert!(found.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-5));
        let square: f32 = found.iter().map(|value| value * value).sum();
        assert!((square / 70.0 - 1.0).abs() < 1e-5);
        let even = both.apply(SHAPE, &[0.25; 70]);
        assert!(even.iter().all(|value| value.abs() < f32::EPSILON));
    }
}
