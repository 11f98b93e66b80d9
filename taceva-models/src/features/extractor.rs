//! From one frame to one sample's features, exactly rounded once.

use taceva_core::{FeatureShape, Features, Frame, FrameInfo};

use super::area::AreaSums;
use super::spec::{Color, FeatureSpec};

/// Weights of red, green and blue in gray, in thousandths (Rec. ITU-R BT.601).
const LUMA: [i64; 3] = [299, 587, 114];
const LUMA_SUM: i64 = 1000;

/// Turns frames of one kind into features; shared freely between threads.
///
/// Sums stay whole numbers until the one division at the end, so a feature is the exact area average rounded once.
#[derive(Clone, Debug)]
pub struct Extractor {
    spec: FeatureSpec,
    info: FrameInfo,
    areas: AreaSums,
    reference: Option<Vec<i64>>,
}

impl Extractor {
    /// An extractor of `spec` from frames of `info`; a difference needs the `reference` frame.
    ///
    /// # Errors
    /// [`FeatureError`] if the frame is smaller than the features, is gray where colour is asked for or has too many
    /// rows, or if the reference frame is absent or of another kind.
    pub fn new(
        spec: FeatureSpec,
        info: FrameInfo,
        reference: Option<&Frame>,
    ) -> Result<Extractor, FeatureError> {
        if info.width < spec.width || info.height < spec.height {
            return Err(FeatureError::Small { info, spec });
        }
        if info.height > AreaSums::ROWS_MAX {
            return Err(FeatureError::Tall { info });
        }
        if spec.color == Color::Rgb && info.format.samples() == 1 {
            return Err(FeatureError::Colorless { info });
        }
        let mut extractor = Extractor {
            areas: AreaSums::new(info, spec.width, spec.height),
            spec,
            info,
            reference: None,
        };
        if spec.difference {
            let frame = reference.ok_or(FeatureError::NoReference)?;
            extractor.check(frame)?;
            let mut sums = Vec::with_capacity(spec.shape().len());
            extractor.for_each_sum(frame, |sum| sums.push(sum));
            extractor.reference = Some(sums);
        }
        Ok(extractor)
    }

    /// The shape of one sample's features.
    pub fn shape(&self) -> FeatureShape {
        self.spec.shape()
    }

    /// The kind of frame it takes.
    pub fn frame_info(&self) -> FrameInfo {
        self.info
    }

    /// Writes the features of `frame`.
    ///
    /// # Shapes
    /// `into`: `[height, width, depth]` of [`shape`](Extractor::shape), the caller's.
    /// # Units
    /// Full scale is 1; a difference lies in -1..1.
    /// # Errors
    /// [`FeatureError::Kind`] if the frame is of another size or format, [`FeatureError::Buffer`] if `into` has another length.
    pub fn extract(&self, frame: &Frame, into: &mut [f32]) -> Result<(), FeatureError> {
        self.check(frame)?;
        let expected = self.shape().len();
        if into.len() != expected {
            return Err(FeatureError::Buffer {
                expected,
                found: into.len(),
            });
        }
        let full_scale = self.full_scale();
        let mut places = into.iter_mut().enumerate();
        self.for_each_sum(frame, |sum| {
            let (position, place) = places.next().expect("a place for each sum, checked above");
            let reference = self.reference.as_ref().map_or(0, |sums| sums[position]);
            *place = ratio(sum - reference, full_scale);
        });
        Ok(())
    }

    /// The features of some frames.
    ///
    /// # Errors
    /// As [`extract`](Extractor::extract).
    pub fn extract_all<'a>(
        &self,
        frames: impl IntoIterator<Item = &'a Frame>,
    ) -> Result<Features, FeatureError> {
        let length = self.shape().len();
        let mut values = Vec::new();
        for frame in frames {
            let start = values.len();
            values.resize(start + length, 0.0);
            self.extract(frame, &mut values[start..])?;
        }
        Ok(Features::new(self.shape(), values).expect("whole samples of this very shape"))
    }

    fn check(&self, frame: &Frame) -> Result<(), FeatureError> {
        if frame.info() == self.info {
            Ok(())
        } else {
            Err(FeatureError::Kind {
                expected: self.info,
                found: frame.info(),
            })
        }
    }

    /// Whether RGB frames are turned into gray.
    fn mixes(&self) -> bool {
        self.spec.color == Color::Gray && self.info.format.samples() == 3
    }

    fn full_scale(&self) -> i64 {
        let mixed = if self.mixes() { LUMA_SUM } else { 1 };
        signed(self.areas.full_scale()) * mixed
    }

    fn for_each_sum(&self, frame: &Frame, mut take: impl FnMut(i64)) {
        if self.mixes() {
            self.areas.for_each(frame, |cell| {
                take(
                    cell.iter()
                        .zip(LUMA)
                        .map(|(&sum, weight)| signed(sum) * weight)
                        .sum(),
                );
            });
        } else {
            self.areas
                .for_each(frame, |cell| cell.iter().for_each(|&sum| take(signed(sum))));
        }
    }
}

/// A sum over a cell: below 2^48 for 65,535 rows and columns of 16 bits, and a frame in memory is no wider than 2^32.
fn signed(sum: u64) -> i64 {
    i64::try_from(sum).expect("a cell of a frame in memory sums to less than 2^63")
}

/// The quotient as a feature.
#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision; this is the one rounding"
)]
fn ratio(sum: i64, full_scale: i64) -> f32 {
    (sum as f64 / full_scale as f64) as f32
}

/// Why features cannot be taken from a frame.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// The frame has fewer pixels than the features.
    #[error("frames of {info} are smaller than the features asked for, {spec}")]
    Small {
        /// The frame.
        info: FrameInfo,
        /// The features.
        spec: FeatureSpec,
    },
    /// The frame has more rows than sums can hold.
    #[error("frames of {info} have more than {} rows", AreaSums::ROWS_MAX)]
    Tall {
        /// The frame.
        info: FrameInfo,
    },
    /// Colour is asked for and there is none.
    #[error("frames of {info} have no colour; `color=gray` would be accepted")]
    Colorless {
        /// The frame.
        info: FrameInfo,
    },
    /// The difference from a frame that nobody gave.
    #[error("`difference=true` needs a no-contact reference frame, and the recording names none")]
    NoReference,
    /// A frame of another size or format than the first ones, or than the model was fitted on.
    #[error("a frame of {found} where {expected} is expected")]
    Kind {
        /// What was agreed on.
        expected: FrameInfo,
        /// What came.
        found: FrameInfo,
    },
    /// The caller's buffer has another length than the features.
    #[error("a buffer of {found} numbers for {expected} features")]
    Buffer {
        /// Numbers of a sample.
        expected: usize,
        /// Numbers the buffer holds.
        found: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::PixelFormat;

    fn frame(width: u32, height: u32, format: PixelFormat, seed: u64) -> Frame {
        let info = FrameInfo {
            width,
            height,
            format,
        };
        let mut state = crate::random::SplitMix64::new(seed);
        let bytes = (0..info.byte_len().expect("small"))
            .map(|_| state.next_u64().to_le_bytes()[0])
            .collect();
        Frame::new(info, bytes).expect("whole")
    }

    fn spec(width: u32, height: u32, color: Color) -> FeatureSpec {
        FeatureSpec {
            width,
            height,
            color,
            ..FeatureSpec::default()
        }
    }

    fn features(frame: &Frame, spec: FeatureSpec) -> Vec<f32> {
        let extractor = Extractor::new(spec, frame.info(), None).expect("fits");
        let mut values = vec![0.0; extractor.shape().len()];
        extractor.extract(frame, &mut values).expect("same kind");
        values
    }

    /// The definition, written as slowly and plainly as possible: areas of overlap in f64.
    fn by_definition(frame: &Frame, spec: FeatureSpec) -> Vec<f64> {
        let info = frame.info();
        let samples: Vec<f64> = frame.samples().map(f64::from).collect();
        let depth = info.format.samples();
        let overlap = |index: u32, cells: u32, pixels: u32, pixel: u32| {
            let cell = f64::from(pixels) / f64::from(cells);
            let (start, end) = (f64::from(index) * cell, f64::from(index + 1) * cell);
            (end.min(f64::from(pixel + 1)) - start.max(f64::from(pixel))).max(0.0) / cell
        };
        let mut values = Vec::new();
        for row in 0..spec.height {
            for column in 0..spec.width {
                let mut cell = vec![0.0; depth];
                for y in 0..info.height {
                    for x in 0..info.width {
                        let weight = overlap(row, spec.height, info.height, y)
                            * overlap(column, spec.width, info.width, x);
                        for (sample, total) in cell.iter_mut().enumerate() {
                            *total +=
                                weight * samples[((y * info.width + x) as usize) * depth + sample];
                        }
                    }
                }
                let full = f64::from(info.format.full_scale());
                if spec.color == Color::Gray && depth == 3 {
                    values.push((0.299 * cell[0] + 0.587 * cell[1] + 0.114 * cell[2]) / full);
                } else {
                    values.extend(cell.iter().map(|total| total / full));
                }
            }
        }
        values
    }

    #[test]
    fn features_are_area_averages_for_every_format_and_ratio() {
        let formats = [
            (PixelFormat::Gray8, Color::Gray),
            (PixelFormat::Gray16, Color::Gray),
            (PixelFormat::Rgb8, Color::Gray),
            (PixelFormat::Rgb16, Color::Gray),
            (PixelFormat::Rgb8, Color::Rgb),
            (PixelFormat::Rgb16, Color::Rgb),
        ];
        for (format, color) in formats {
            for (width, height) in [(8, 6), (7, 5), (24, 18), (1, 1), (23, 17)] {
                let frame = frame(24, 18, format, 7);
                let spec = spec(width, height, color);
                for (found, expected) in features(&frame, spec)
                    .iter()
                    .zip(by_definition(&frame, spec))
                {
                    // The definition above rounds in f64; a feature is rounded to f32, half an ulp of 1.
                    assert!(
                        (f64::from(*found) - expected).abs() < 6.1e-8,
                        "{format:?} to {spec}: {found} for {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_difference_from_itself_is_zero_and_from_black_is_the_frame() {
        let bright = frame(20, 20, PixelFormat::Rgb8, 1);
        let black = Frame::new(bright.info(), vec![0; bright.bytes().len()]).expect("whole");
        let plain = spec(7, 7, Color::Gray);
        let difference = FeatureSpec {
            difference: true,
            ..plain
        };
        let of = |reference: &Frame| {
            Extractor::new(difference, bright.info(), Some(reference))
                .expect("fits")
                .extract_all([&bright])
                .expect("same kind")
        };
        assert!(
            of(&bright)
                .values()
                .iter()
                .all(|value| value.to_bits() == 0)
        );
        assert_eq!(of(&black).values(), features(&bright, plain));
    }

    #[test]
    fn white_is_one_whatever_the_format() {
        for format in [
            PixelFormat::Gray8,
            PixelFormat::Gray16,
            PixelFormat::Rgb8,
            PixelFormat::Rgb16,
        ] {
            let info = frame(33, 21, format, 1).info();
            let white =
                Frame::new(info, vec![0xff; info.byte_len().expect("small")]).expect("whole");
            let values = features(&white, spec(10, 10, Color::Gray));
            assert!(
                values
                    .iter()
                    .all(|value| value.to_bits() == 1.0_f32.to_bits())
            );
        }
    }

    #[test]
    fn frames_that_do_not_fit_are_refused_with_their_sizes() {
        let gray = frame(20, 20, PixelFormat::Gray8, 1);
        let error = Extractor::new(FeatureSpec::default(), gray.info(), None).expect_err("small");
        assert_eq!(
            error.to_string(),
            "frames of 20×20 gray8 are smaller than the features asked for, 32×32 gray"
        );
        let error =
            Extractor::new(spec(4, 4, Color::Rgb), gray.info(), None).expect_err("no colour");
        assert!(matches!(error, FeatureError::Colorless { .. }));
        let difference = FeatureSpec {
            difference: true,
            ..spec(4, 4, Color::Gray)
        };
        let error = Extractor::new(difference, gray.info(), None).expect_err("no reference");
        assert_eq!(error, FeatureError::NoReference);
        let extractor = Extractor::new(spec(4, 4, Color::Gray), gray.info(), None).expect("fits");
        let other = frame(20, 21, PixelFormat::Gray8, 1);
        let error = extractor
            .extract(&other, &mut [0.0; 16])
            .expect_err("another size");
        assert_eq!(
            error.to_string(),
            "a frame of 20×21 gray8 where 20×20 gray8 is expected"
        );
        assert!(matches!(
            extractor.extract(&gray, &mut [0.0; 15]),
            Err(FeatureError::Buffer { .. })
        ));
    }
}
