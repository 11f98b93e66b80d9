//! Reduction of frames to fewer pixels of 8 bits: exact area averages, rounded once.

use taceva_core::{Frame, FrameInfo};

use super::area::AreaSums;
use super::error::FeatureError;

/// Reduces frames of one kind to a coarser grid of 8-bit pixels.
///
/// A reduced pixel is the mean of its area. Source pixels at the rim are weighted by their overlap, as in features of the same grid. The mean is
/// rounded once, half up, to a multiple of full scale / 255. For 16-bit pixels, this step is 257 levels. Rounding changes features of the same grid
/// by at most half a step.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_models::FrameReduction;
///
/// let info = FrameInfo { width: 3, height: 1, format: PixelFormat::Gray16 };
/// let steps = [10_u16, 20, 31].map(|level| (257 * level).to_le_bytes());
/// let frame = Frame::new(info, steps.concat())?;
/// let reduction = FrameReduction::new(info, [2, 1])?;
/// // (10 + 20/2) / 1.5 and (20/2 + 31) / 1.5
/// assert_eq!(reduction.reduce(&frame)?.bytes(), [13, 27]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FrameReduction {
    from: FrameInfo,
    to: FrameInfo,
    areas: AreaSums,
}

impl FrameReduction {
    /// Prepares the reduction of frames of `from` to a width and a height.
    ///
    /// # Errors
    /// [`FeatureError::Reduction`] if a side is 0 or longer than that side of the frame, [`FeatureError::Tall`] if the frame has too many rows.
    pub fn new(from: FrameInfo, [width, height]: [u32; 2]) -> Result<FrameReduction, FeatureError> {
        if !(1..=from.width).contains(&width) || !(1..=from.height).contains(&height) {
            return Err(FeatureError::Reduction {
                info: from,
                width,
                height,
            });
        }
        if from.height > AreaSums::ROWS_MAX {
            return Err(FeatureError::Tall { info: from });
        }
        Ok(FrameReduction {
            from,
            to: FrameInfo {
                width,
                height,
                format: from.format.of_eight_bits(),
            },
            areas: AreaSums::new(from, width, height),
        })
    }

    /// Size and format of input frames.
    pub fn from(&self) -> FrameInfo {
        self.from
    }

    /// Size and format of reduced frames.
    pub fn to(&self) -> FrameInfo {
        self.to
    }

    /// Reduces a frame.
    ///
    /// # Errors
    /// [`FeatureError::Kind`] if the size or format of `frame` is wrong.
    pub fn reduce(&self, frame: &Frame) -> Result<Frame, FeatureError> {
        if frame.info() != self.from {
            return Err(FeatureError::Kind {
                expected: self.from,
                found: frame.info(),
            });
        }
        let full_scale = self.areas.full_scale();
        let mut bytes = Vec::with_capacity(self.to.byte_len().unwrap_or_default());
        self.areas.for_each(frame, |cell| {
            bytes.extend(cell.iter().map(|sum| rounded(*sum, full_scale)));
        });
        Ok(Frame::new(self.to, bytes).expect("one byte per sample of every cell"))
    }
}

/// Divides `sum` by `full_scale` and rounds to the nearest of 255 steps. `sum` is below 2^48 and at most `full_scale`.
fn rounded(sum: u64, full_scale: u64) -> u8 {
    u8::try_from((sum * 255 + full_scale / 2) / full_scale).unwrap_or(u8::MAX)
}

#[cfg(test)]
mod tests {
    use taceva_core::PixelFormat;

    use super::*;
    use crate::features::test_pictures::noise;
    use crate::features::{Extractor, FeatureSpec};
    use crate::settings::ModelSettings;

    fn info(width: u32, height: u32, format: PixelFormat) -> FrameInfo {
        FrameInfo {
            width,
            height,
            format,
        }
    }

    #[test]
    fn every_pixel_is_the_feature_of_its_cell_but_for_half_a_step() {
        for format in [PixelFormat::Gray16, PixelFormat::Rgb16, PixelFormat::Rgb8] {
            let info = info(37, 23, format);
            let frame = noise(37, 23, format, 5);
            let reduced = FrameReduction::new(info, [16, 9]).and_then(|own| own.reduce(&frame));
            let reduced = reduced.expect("smaller");
            let color = if format.samples() == 3 {
                "color=rgb"
            } else {
                "color=gray"
            };
            let settings = ModelSettings::parse(["size=16x9", color]).expect("settings");
            let spec = FeatureSpec::from_settings(&settings).expect("a spec");
            let extractor = Extractor::new(spec, info, None).expect("features");
            let features = extractor.extract_all([&frame]).expect("features");
            for (found, feature) in reduced.bytes().iter().zip(features.values()) {
                let off = f64::from(*found) - f64::from(*feature) * 255.0;
                assert!(off.abs() <= 0.5 + 1e-4, "{format:?}: {off} steps");
            }
        }
    }

    #[test]
    fn a_frame_of_eight_bits_at_its_own_size_stays_as_it_is_and_white_stays_white() {
        let own = info(11, 7, PixelFormat::Rgb8);
        let frame = noise(11, 7, PixelFormat::Rgb8, 6);
        let same = FrameReduction::new(own, [11, 7]).and_then(|same| same.reduce(&frame));
        assert_eq!(same.expect("its own size"), frame);
        let deep = info(5, 3, PixelFormat::Gray16);
        let white = Frame::new(deep, vec![0xff; 30]).expect("whole");
        let small = FrameReduction::new(deep, [2, 2]).and_then(|small| small.reduce(&white));
        assert_eq!(small.expect("smaller").bytes(), [255; 4]);
    }

    #[test]
    fn halves_are_rounded_up() {
        let own = info(2, 1, PixelFormat::Gray8);
        let frame = Frame::new(own, vec![4, 7]).expect("whole");
        let mean = FrameReduction::new(own, [1, 1]).and_then(|mean| mean.reduce(&frame));
        assert_eq!(mean.expect("smaller").bytes(), [6]);
    }

    #[test]
    fn a_size_of_zero_and_one_larger_than_the_frame_are_refused_with_what_would_be_accepted() {
        let own = info(8, 6, PixelFormat::Gray8);
        for size in [[0, 6], [8, 0], [9, 6], [8, 7]] {
            let error = FrameReduction::new(own, size)
                .expect_err("no size")
                .to_string();
            let [width, height] = size;
            assert_eq!(
                error,
                format!(
                    "frames of 8×6 gray8 cannot be reduced to {width}×{height}; expected a width from 1 to 8 and a height from 1 to 6"
                )
            );
        }
    }

    #[test]
    fn a_frame_of_another_kind_is_refused() {
        let own = info(8, 6, PixelFormat::Gray8);
        let reduction = FrameReduction::new(own, [4, 3]).expect("smaller");
        let other = noise(8, 6, PixelFormat::Rgb8, 7);
        let error = reduction.reduce(&other).expect_err("colour").to_string();
        assert_eq!(error, "a frame of 8×6 rgb8, expected 8×6 gray8");
    }
}
