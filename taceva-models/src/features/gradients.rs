//! Surface slopes of a gel without markers, computed from the light of three coloured lamps.

use taceva_core::{Frame, FrameInfo, PixelFormat};

use super::area::AreaSums;
use super::cell_features::CellFeatures;
use super::error::FeatureError;
use super::pixels::{ratio, signed};
use super::spec::FeatureSpec;

/// Smallest brightness assumed for the reference, as a share of full scale. Division by a smaller brightness would amplify noise in dark areas.
const LIT: f32 = 1.0 / 16.0;
/// Number of integer steps for a relative change of 1. Values of pixels are integers until they are averaged.
const STEPS: f32 = 16_384.0;
/// Integer that represents a relative change of 0. The representable range is −2 to 2.
const ZERO: u16 = 32_768;
/// Factor 1 / √3. It converts the difference between the lamps at 120° and 240° to the slope towards 90°.
const ACROSS: f32 = 0.577_350_27;

/// Slopes of each cell of a frame towards 0° and 90°, and the change of light that slopes do not explain.
///
/// # The light
/// Three lamps shine at a low angle on a matt surface: red at 0°, green at 120° and blue at 240°. Let `g` be the small slope of the surface,
/// (∂z/∂x, ∂z/∂y). Lamp `c` has the direction `d_c` and the elevation `e`. By Lambert's law, to first order, a slope multiplies its light by
/// `1 - cot(e) g·d_c`. Let `r_c` be the relative change `(frame - reference) / reference` of colour `c`, and `s` a change common to all three.
/// Then `r_c = p·d_c + s` has one solution. It is computed for each pixel and averaged over the cell:
///
/// `p_x = 2/3 (r_red - (r_green + r_blue) / 2)`, `p_y = (r_green - r_blue) / √3`, `s = (r_red + r_green + r_blue) / 3`.
///
/// `p = -cot(e) g` is positive where the surface faces the lamp. Division by the reference cancels uneven lamps, vignetting and the gel's colour.
///
/// # Calibration
/// No calibration with a ball is needed. Lamps with other directions or colours give another fixed linear combination of slopes. A model learns it
/// from its training labels.
///
/// # Limits
/// Shear is not measured, because no point of the surface is tracked. The depth of a flat touch is measured only at its edge. Slopes are wrong in
/// shadow, in saturated pixels and if they are too steep for the linear law. A common change of all lamps affects only `s`. A change of a single lamp
/// cannot be told from a slope.
#[derive(Debug)]
pub(super) struct Gradients {
    areas: AreaSums,
    reference: Vec<f32>,
    /// Reciprocal of the reference brightness, for each colour of each pixel. The brightness is taken as at least `LIT` of full scale.
    inverse: Vec<f32>,
}

impl Gradients {
    /// Prepares gradients for frames of the same size and format as `reference`. The frame must be at least as large as the grid of `spec`.
    pub(super) fn new(spec: &FeatureSpec, reference: &Frame) -> Result<Gradients, FeatureError> {
        let info = reference.info();
        if info.format.samples() != 3 {
            return Err(FeatureError::Lampless { info });
        }
        let slopes = slopes_info(info);
        let full_scale = f32::from(info.format.full_scale());
        let reference: Vec<f32> = reference.samples().map(f32::from).collect();
        let inverse = reference
            .iter()
            .map(|light| light.max(LIT * full_scale).recip());
        Ok(Gradients {
            areas: AreaSums::new(slopes, spec.width, spec.height),
            inverse: inverse.collect(),
            reference,
        })
    }

    /// Both slopes and the common change of light at each pixel, as the three colours of a frame in integer steps.
    fn slopes(&self, frame: &Frame) -> Frame {
        let mut bytes = Vec::with_capacity(2 * self.reference.len());
        let own = self.reference.iter().zip(&self.inverse);
        let mut changes = frame
            .samples()
            .zip(own)
            .map(|(light, (reference, inverse))| (f32::from(light) - reference) * inverse);
        while let (Some(red), Some(green), Some(blue)) =
            (changes.next(), changes.next(), changes.next())
        {
            let towards = 2.0 / 3.0 * (red - 0.5 * (green + blue));
            let across = ACROSS * (green - blue);
            let common = (red + green + blue) / 3.0;
            for number in [towards, across, common] {
                bytes.extend(step(number).to_le_bytes());
            }
        }
        Frame::new(slopes_info(frame.info()), bytes).expect("three numbers per pixel")
    }
}

impl CellFeatures for Gradients {
    fn depth(&self) -> usize {
        3
    }

    fn write(&self, frame: &Frame, into: &mut [f32]) {
        let pixels = signed(self.areas.full_scale()) / i64::from(u16::MAX);
        let zero = pixels * i64::from(ZERO);
        #[expect(clippy::cast_possible_truncation, reason = "16,384")]
        let one = pixels * STEPS as i64;
        let mut places = into.iter_mut();
        self.areas.for_each(&self.slopes(frame), |cell| {
            for (&sum, place) in cell.iter().zip(&mut places) {
                *place = ratio(signed(sum) - zero, one);
            }
        });
    }
}

fn slopes_info(info: FrameInfo) -> FrameInfo {
    FrameInfo {
        format: PixelFormat::Rgb16,
        ..info
    }
}

/// Converts a relative change to the nearest integer step. Values beyond −2 to 2 become the nearest bound.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a conversion to fewer bits ends at its bounds"
)]
fn step(number: f32) -> u16 {
    (number * STEPS + f32::from(ZERO)).round() as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::test_pictures::noise;
    use crate::features::{Extractor, FeatureKind};

    const SIDE: u32 = 24;

    fn spec(side: u32) -> FeatureSpec {
        FeatureSpec {
            kinds: FeatureKind::Gradients.into(),
            width: side,
            height: side,
            ..FeatureSpec::default()
        }
    }

    /// Test frame of 16 bits: a surface with a given `slope` at each place, lit by lamps of brightness `lamps`. `dimming` multiplies the light of a
    /// flat surface.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a camera"
    )]
    fn lit(lamps: [f64; 3], dimming: f64, slope: impl Fn(f64, f64) -> [f64; 2]) -> Frame {
        let info = FrameInfo {
            width: SIDE,
            height: SIDE,
            format: PixelFormat::Rgb16,
        };
        let mut bytes = Vec::new();
        for y in 0..SIDE {
            for x in 0..SIDE {
                let [gx, gy] = slope(f64::from(x), f64::from(y));
                for (lamp, angle) in lamps.iter().zip([0.0_f64, 120.0, 240.0]) {
                    let (across, along) = angle.to_radians().sin_cos();
                    let light = lamp * (dimming + gx * along + gy * across);
                    bytes.extend(((65_535.0 * light).round() as u16).to_le_bytes());
                }
            }
        }
        Frame::new(info, bytes).expect("whole")
    }

    fn features(reference: &Frame, frame: &Frame, side: u32) -> Vec<f32> {
        let extractor =
            Extractor::new(spec(side), frame.info(), Some(reference.into())).expect("fits");
        let features = extractor.extract_all([frame]).expect("same kind");
        features.values().to_vec()
    }

    #[test]
    fn the_slopes_of_a_bowl_come_back_whatever_the_lamps() {
        let bowl = |x: f64, y: f64| [0.01 * (x - 11.5), -0.006 * (y - 11.5)];
        for lamps in [[0.4, 0.4, 0.4], [0.5, 0.2, 0.35]] {
            let reference = lit(lamps, 1.0, |_, _| [0.0, 0.0]);
            let frame = lit(lamps, 0.9, bowl);
            for (position, cell) in features(&reference, &frame, 8).chunks_exact(3).enumerate() {
                let middle = |cell: usize| 3.0 * cell as f64 + 1.0;
                let [gx, gy] = bowl(middle(position % 8), middle(position / 8));
                for (found, truth) in cell.iter().zip([gx, gy, -0.1]) {
                    // Tolerance: half a step of a pixel, and half a level of a 16-bit camera at a fifth of full scale.
                    assert!(
                        (f64::from(*found) - truth).abs() < 1e-4,
                        "{found} for {truth}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_untouched_gel_leans_nowhere() {
        let untouched = noise(30, 20, PixelFormat::Rgb8, 2);
        let found = features(&untouched, &untouched, 5);
        assert!(found.iter().all(|value| value.to_bits() == 0));
    }

    #[test]
    fn a_dark_corner_does_not_turn_noise_into_slopes() {
        let info = noise(16, 16, PixelFormat::Rgb8, 1).info();
        let of = |level: u8| Frame::new(info, vec![level; 3 * 256]).expect("whole");
        let mut bytes = of(1).into_bytes();
        bytes.iter_mut().step_by(3).for_each(|red| *red = 2);
        let noisy = Frame::new(info, bytes).expect("whole");
        let found = features(&of(1), &noisy, 2);
        // One level relative to a sixteenth of full scale, times two thirds; the true change is a doubling.
        assert!(
            (found[0] - 2.0 / 3.0 * 16.0 / 255.0).abs() < 1e-4,
            "{}",
            found[0]
        );
    }

    #[test]
    fn frames_without_colour_and_recordings_without_a_reference_are_refused() {
        let gray = noise(40, 40, PixelFormat::Gray8, 1);
        let error = Extractor::new(spec(32), gray.info(), Some((&gray).into())).expect_err("gray");
        assert_eq!(error, FeatureError::Lampless { info: gray.info() });
        let color = noise(40, 40, PixelFormat::Rgb8, 1);
        let error = Extractor::new(spec(32), color.info(), None).expect_err("no reference");
        let asked = "features=gradients";
        assert_eq!(error, FeatureError::NoReference { asked });
    }
}
