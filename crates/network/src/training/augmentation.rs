//! Random changes of pictures. Labels are unchanged, or change by a known amount.

use serde::{Deserialize, Serialize};

use crate::architecture::Architecture;
use crate::error::NetworkError;
use crate::picture::Picture;
use taceva_core::random::Draws;

/// Random changes of pictures before each step. The default changes nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Augmentation {
    /// Half-width, from 0 to 1, of the uniform distribution of the brightness factor around 1.
    pub brightness: f64,
    /// Standard deviation of the noise added to each value, in the unit of the pictures.
    pub noise: f64,
    /// Random shifts of pictures.
    pub jitter: Jitter,
}

/// Shifts by whole pixels. The pixels at the edge are repeated.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Jitter {
    /// Largest shift in each direction, in pixels.
    pub pixels: usize,
    /// Change of each output's label, in the unit of the label, for a shift by one pixel down and by one pixel to the right. Empty if no label depends on
    /// position.
    pub label_per_pixel: Vec<[f64; 2]>,
}

/// Shift down and to the right, in pixels.
pub(super) type Shift = [i32; 2];

impl Augmentation {
    pub(super) fn check(&self, architecture: &Architecture) -> Result<(), NetworkError> {
        let refuse = |name, found: String, expected| {
            Err(NetworkError::Recipe {
                name,
                found,
                expected,
            })
        };
        if !(0.0..=1.0).contains(&self.brightness) {
            return refuse("brightness", self.brightness.to_string(), "0 to 1");
        }
        if !(self.noise.is_finite() && self.noise >= 0.0) {
            return refuse(
                "noise",
                self.noise.to_string(),
                "a finite number, at least 0",
            );
        }
        let side = architecture.input.height.min(architecture.input.width);
        if self.jitter.pixels >= side || self.jitter.pixels > 1 << 20 {
            return refuse(
                "jitter",
                self.jitter.pixels.to_string(),
                "fewer pixels than the shorter side",
            );
        }
        let moves = &self.jitter.label_per_pixel;
        let is_finite = moves.iter().flatten().all(|number| number.is_finite());
        if !(moves.is_empty() || moves.len() == architecture.outputs) || !is_finite {
            let found = format!("{moves:?}");
            return refuse(
                "label_per_pixel",
                found,
                "two finite numbers for each output, or none",
            );
        }
        Ok(())
    }

    /// Changes a picture by random numbers of its sample. Returns the picture and its shift.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "drawn in double precision and kept in single"
    )]
    pub(super) fn apply(
        &self,
        draws: Draws,
        picture: Picture,
        values: &[f32],
    ) -> (Vec<f32>, Shift) {
        let shift = [0, 1].map(|axis| self.jitter.draw(draws.unit(axis)));
        let mut changed = self.jitter.shifted(shift, picture, values);
        if self.brightness > 0.0 {
            let gain = 1.0 + self.brightness * (2.0 * draws.unit(2) - 1.0);
            changed.iter_mut().for_each(|value| *value *= gain as f32);
        }
        if self.noise > 0.0 {
            // Standard deviation of a sum of four uniform draws of 16 bits.
            let unit = (4.0_f64 / 12.0).sqrt() * 65536.0;
            let (factor, draws) = ((self.noise / unit) as f32, draws.of(3));
            for (position, value) in changed.iter_mut().enumerate() {
                let bits = draws.bits(position as u64);
                let sum: u32 = (0..4)
                    .map(|part| (bits >> (16 * part)) as u32 & 0xffff)
                    .sum();
                // The mean is 4 · 65,535 / 2.
                *value += (sum as f32 - 131_070.0) * factor;
            }
        }
        (changed, shift)
    }

    /// Change of the label of `output` by a shift, in the unit of the label.
    pub(super) fn moved(&self, shift: Shift, output: usize) -> f64 {
        self.jitter
            .label_per_pixel
            .get(output)
            .map_or(0.0, |per_pixel| {
                per_pixel[0] * f64::from(shift[0]) + per_pixel[1] * f64::from(shift[1])
            })
    }
}

impl Jitter {
    /// Shift along one axis, from a uniform random number in 0..1.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "checked to be at most 2^20 pixels"
    )]
    fn draw(&self, unit: f64) -> i32 {
        let pixels = self.pixels as i32;
        (unit * f64::from(2 * pixels + 1)) as i32 - pixels
    }

    fn shifted(&self, [down, right]: Shift, picture: Picture, values: &[f32]) -> Vec<f32> {
        if down == 0 && right == 0 {
            return values.to_vec();
        }
        let from = |at: usize, shift: i32, length: usize| {
            let shift = isize::try_from(shift).expect("a shift fits");
            at.saturating_add_signed(-shift).min(length - 1)
        };
        let mut shifted = Vec::with_capacity(values.len());
        for y in 0..picture.height {
            let row = &values[from(y, down, picture.height) * picture.width * picture.channels..];
            for x in 0..picture.width {
                let at = from(x, right, picture.width) * picture.channels;
                shifted.extend_from_slice(&row[at..at + picture.channels]);
            }
        }
        shifted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PICTURE: Picture = Picture {
        height: 2,
        width: 3,
        channels: 1,
    };
    const VALUES: [f32; 6] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];

    #[test]
    fn a_shift_repeats_the_edge() {
        let jitter = Jitter::default();
        let found = jitter.shifted([1, -1], PICTURE, &VALUES);
        assert_eq!(found, [2.0, 3.0, 3.0, 2.0, 3.0, 3.0]);
    }

    #[test]
    fn labels_follow_shifts_and_shifts_are_drawn_evenly() {
        let jitter = Jitter {
            pixels: 1,
            label_per_pixel: vec![[0.5, 0.0], [0.0, -2.0]],
        };
        let augmentation = Augmentation {
            jitter,
            ..Augmentation::default()
        };
        let moved = [0, 1].map(|output| augmentation.moved([3, 2], output));
        assert!((moved[0] - 1.5).abs() < 1e-12 && (moved[1] + 4.0).abs() < 1e-12);
        let mut counts = std::collections::BTreeMap::new();
        for sample in 0..900 {
            let draws = Draws::new(1).of(sample);
            let (_, shift) = augmentation.apply(draws, PICTURE, &VALUES);
            *counts.entry(shift).or_insert(0_u32) += 1;
        }
        // Expected count 100, standard deviation 9.4; the limit is five standard deviations.
        assert_eq!(counts.len(), 9);
        assert!(
            counts.values().all(|count| count.abs_diff(100) < 47),
            "{counts:?}"
        );
    }

    #[test]
    fn noise_and_brightness_have_the_size_asked_for() {
        let picture = Picture {
            height: 100,
            width: 100,
            channels: 1,
        };
        let noise = Augmentation {
            noise: 0.1,
            ..Augmentation::default()
        };
        let (found, _) = noise.apply(Draws::new(5), picture, &[0.5; 10_000]);
        let mean = found.iter().sum::<f32>() / 10_000.0;
        let square = found
            .iter()
            .map(|value| (value - mean).powi(2))
            .sum::<f32>()
            / 10_000.0;
        // Standard errors are 0.001 and 0.0007; the limits are five standard errors.
        assert!((mean - 0.5).abs() < 0.005 && (square.sqrt() - 0.1).abs() < 0.0035);
        let light = Augmentation {
            brightness: 0.2,
            ..Augmentation::default()
        };
        let gains: Vec<f32> = (0..500)
            .map(|seed| light.apply(Draws::new(seed), PICTURE, &VALUES).0[0])
            .collect();
        assert!(gains.iter().all(|gain| (0.8..=1.2).contains(gain)));
        assert!(gains.iter().any(|gain| *gain < 0.82) && gains.iter().any(|gain| *gain > 1.18));
    }
}
