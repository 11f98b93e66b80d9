//! Extracts the features of one sample from a frame, or from the signals of one instant.

use std::sync::Arc;

use taceva_core::{FeatureShape, Features, Frame, FrameInfo, Input, InputInfo};

use super::area::AreaSums;
use super::cell_features::CellFeatures;
use super::error::FeatureError;
use super::gradients::Gradients;
use super::kinds::FeatureKind;
use super::markers::MarkerField;
use super::pixels::Pixels;
use super::signals::Taxels;
use super::spec::{Color, FeatureSpec};
use super::statistics::Statistics;

/// Extracts features from frames of one size and format, or from signals of one grid of taxels. Threads can share an extractor.
///
/// The features of a sample depend only on its frame or signals, and on the reference.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_models::{Extractor, FeatureSpec, ModelSettings};
///
/// // The red lamp, at 0°, lights the gel by an eighth more than before.
/// let info = FrameInfo { width: 16, height: 16, format: PixelFormat::Rgb8 };
/// let even = |light: [u8; 3]| Frame::new(info, light.repeat(16 * 16));
/// let settings = ModelSettings::parse(["features=gradients+statistics", "size=1"])?;
/// let spec = FeatureSpec::from_settings(&settings)?;
/// let extractor = Extractor::new(spec, info, Some((&even([80, 80, 80])?).into()))?;
/// let features = extractor.extract_all([&even([90, 80, 80])?])?;
/// // The slope towards the lamp is two thirds of the change; the slope across it is 0. The mean is luma, and the spread is 0.
/// let expected = [0.125 * 2.0 / 3.0, 0.0, 0.125 / 3.0, (80.0 + 0.299 * 10.0) / 255.0, 0.0];
/// for (found, expected) in features.values().iter().zip(expected) {
///     assert!((found - expected).abs() < 1e-4, "{found} for {expected}");
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Extractor {
    spec: FeatureSpec,
    of: Of,
}

/// Input of an extractor, with the prepared computation.
#[derive(Clone, Debug)]
enum Of {
    /// Frames of one size and format. The list contains one computation per requested kind of features, in order.
    Frames(FrameInfo, Vec<Arc<dyn CellFeatures>>),
    /// Signals of one grid of taxels.
    Signals(Taxels),
}

impl Extractor {
    /// Builds an extractor of the features `spec` from frames or signals of `info`. `reference` is the contact-free frame or signals. Differences,
    /// markers and gradients need it.
    ///
    /// # Errors
    /// [`FeatureError`] in four cases. The frame is smaller than the features, gray although colour is requested, or has too many rows. A needed
    /// reference is missing or of another kind. The reference lacks requested markers. The grid of the signals differs from the grid of `spec`.
    pub fn new(
        spec: FeatureSpec,
        info: impl Into<InputInfo>,
        reference: Option<Input<'_>>,
    ) -> Result<Extractor, FeatureError> {
        let info = info.into();
        let wrong = |found: Input<'_>| FeatureError::Input {
            expected: info,
            found: found.info(),
        };
        let of = match (info, reference) {
            (InputInfo::Frame(info), None) => Of::Frames(info, parts(&spec, info, None)?),
            (InputInfo::Frame(info), Some(Input::Frame(reference))) => {
                Of::Frames(info, parts(&spec, info, Some(reference))?)
            }
            (InputInfo::Signals(info), None) => Of::Signals(Taxels::new(&spec, info, None)?),
            (InputInfo::Signals(info), Some(Input::Signals(rest))) => {
                Of::Signals(Taxels::new(&spec, info, Some(rest))?)
            }
            (_, Some(other)) => return Err(wrong(other)),
            (_, None) => return Err(FeatureError::NoSignals),
        };
        Ok(Extractor { spec, of })
    }

    /// Shape of the features of one frame, or of the signals of one instant.
    pub fn shape(&self) -> FeatureShape {
        self.spec.frame_shape()
    }

    /// Specification of the extracted features.
    pub fn spec(&self) -> &FeatureSpec {
        &self.spec
    }

    /// Expected input: size and format of frames, or grid of signals.
    pub fn input(&self) -> InputInfo {
        match &self.of {
            Of::Frames(info, _) => (*info).into(),
            Of::Signals(taxels) => taxels.info().into(),
        }
    }

    /// Computes the features of one frame, or of the signals of one instant.
    ///
    /// # Shapes
    /// `into`: `[height, width, depth]` of [`shape`](Extractor::shape), allocated by the caller.
    /// # Units
    /// Signals keep their unit. Brightness and its statistics: full scale is 1. Displacements of markers: marker spacings. Slopes have a unit that
    /// depends on the elevation of the lamps.
    /// # Errors
    /// [`FeatureError::Kind`] for a frame of another size or format. [`FeatureError::Input`] for the wrong kind of input, or signals of another grid.
    /// [`FeatureError::Buffer`] if the length of `into` is wrong.
    pub fn extract<'a>(
        &self,
        input: impl Into<Input<'a>>,
        into: &mut [f32],
    ) -> Result<(), FeatureError> {
        let input = input.into();
        let shape = self.shape();
        let expected = shape.len();
        if into.len() != expected {
            return Err(FeatureError::Buffer {
                expected,
                found: into.len(),
            });
        }
        match (&self.of, input) {
            (Of::Frames(info, parts), Input::Frame(frame)) => {
                check(*info, frame)?;
                self.write(parts, frame, into);
            }
            (Of::Signals(taxels), Input::Signals(signals)) if taxels.info() == signals.info() => {
                taxels.write(signals, into);
            }
            (_, other) => {
                return Err(FeatureError::Input {
                    expected: self.input(),
                    found: other.info(),
                });
            }
        }
        Ok(())
    }

    /// Writes the features of `frame` to `into`. Each of `parts` computes one kind. The values of one cell are adjacent.
    fn write(&self, parts: &[Arc<dyn CellFeatures>], frame: &Frame, into: &mut [f32]) {
        let shape = self.shape();
        if let [only] = parts {
            only.write(frame, into);
            return;
        }
        let mut first = 0;
        for part in parts {
            let depth = part.depth();
            let mut own = vec![0.0; shape.height * shape.width * depth];
            part.write(frame, &mut own);
            for (cell, own) in into
                .chunks_exact_mut(shape.depth)
                .zip(own.chunks_exact(depth))
            {
                cell[first..first + depth].copy_from_slice(own);
            }
            first += depth;
        }
    }

    /// Features of several frames, or of signals of several instants.
    ///
    /// # Errors
    /// Errors of [`extract`](Extractor::extract).
    pub fn extract_all<'a, I: Into<Input<'a>>>(
        &self,
        inputs: impl IntoIterator<Item = I>,
    ) -> Result<Features, FeatureError> {
        let length = self.shape().len();
        let mut values = Vec::new();
        for input in inputs {
            let start = values.len();
            values.resize(start + length, 0.0);
            self.extract(input, &mut values[start..])?;
        }
        Ok(Features::new(self.shape(), values).expect("whole samples of this very shape"))
    }
}

/// Prepares the computation of each requested kind of features, for frames of `info`.
fn parts(
    spec: &FeatureSpec,
    info: FrameInfo,
    reference: Option<&Frame>,
) -> Result<Vec<Arc<dyn CellFeatures>>, FeatureError> {
    if info.width < spec.width || info.height < spec.height {
        return Err(FeatureError::Small { info, spec: *spec });
    }
    if info.height > AreaSums::ROWS_MAX {
        return Err(FeatureError::Tall { info });
    }
    if spec.color == Color::Rgb && info.format.samples() == 1 {
        return Err(FeatureError::Colorless { info });
    }
    let reference = match (spec.asks_for_reference(), reference) {
        (None, _) => None,
        (Some(asked), None) => return Err(FeatureError::NoReference { asked }),
        (Some(_), Some(frame)) => {
            check(info, frame)?;
            Some(frame)
        }
    };
    let kinds = spec.kinds.iter();
    kinds
        .map(|kind| part(kind, spec, info, reference))
        .collect()
}

fn check(expected: FrameInfo, frame: &Frame) -> Result<(), FeatureError> {
    let found = frame.info();
    if found == expected {
        Ok(())
    } else {
        Err(FeatureError::Kind { expected, found })
    }
}

fn part(
    kind: FeatureKind,
    spec: &FeatureSpec,
    info: FrameInfo,
    reference: Option<&Frame>,
) -> Result<Arc<dyn CellFeatures>, FeatureError> {
    const ASKED: &str = "a reference where one is asked for, checked by the caller";
    let subtracted = reference.filter(|_| spec.difference);
    Ok(match kind {
        FeatureKind::Pixels => Arc::new(Pixels::new(spec, info, subtracted)),
        FeatureKind::Statistics => Arc::new(Statistics::new(spec, info, subtracted)),
        FeatureKind::Gradients => Arc::new(Gradients::new(spec, reference.expect(ASKED))?),
        FeatureKind::Signals => return Err(FeatureError::NoSignals),
        FeatureKind::Markers => Arc::new(MarkerField::new(spec, reference.expect(ASKED))?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::kinds::FeatureKinds;
    use crate::features::test_pictures::noise;
    use taceva_core::PixelFormat;

    fn spec(width: u32, height: u32, color: Color) -> FeatureSpec {
        FeatureSpec {
            width,
            height,
            color,
            ..FeatureSpec::default()
        }
    }

    #[test]
    fn several_kinds_stand_side_by_side_in_each_cell() {
        let frame = noise(24, 18, PixelFormat::Rgb8, 3);
        let untouched = noise(24, 18, PixelFormat::Rgb8, 4);
        let of = |kinds: &str| {
            let spec = FeatureSpec {
                kinds: FeatureKinds::parse(kinds).expect("kinds"),
                ..spec(4, 3, Color::Rgb)
            };
            let extractor =
                Extractor::new(spec, frame.info(), Some((&untouched).into())).expect("fits");
            let features = extractor.extract_all([&frame]).expect("same kind");
            (features.shape().depth, features.values().to_vec())
        };
        let (depth, together) = of("statistics+gradients+pixels");
        let alone = ["pixels", "gradients", "statistics"].map(of);
        for (position, cell) in together.chunks_exact(depth).enumerate() {
            let parts = alone
                .iter()
                .map(|(depth, own)| &own[position * depth..][..*depth]);
            assert_eq!(cell, parts.collect::<Vec<_>>().concat(), "{position}");
        }
    }

    #[test]
    fn frames_that_do_not_fit_are_refused_with_their_sizes() {
        let gray = noise(20, 20, PixelFormat::Gray8, 1);
        let error = Extractor::new(FeatureSpec::default(), gray.info(), None).expect_err("small");
        assert_eq!(
            error.to_string(),
            "frames of 20×20 gray8 are smaller than the requested features, 32×32 gray; set `size=20x20`"
        );
        let error =
            Extractor::new(spec(4, 4, Color::Rgb), gray.info(), None).expect_err("no colour");
        assert!(matches!(error, FeatureError::Colorless { .. }));
        let difference = FeatureSpec {
            difference: true,
            ..spec(4, 4, Color::Gray)
        };
        let error = Extractor::new(difference, gray.info(), None).expect_err("no reference");
        assert_eq!(
            error,
            FeatureError::NoReference {
                asked: "difference=true"
            }
        );
        let extractor = Extractor::new(spec(4, 4, Color::Gray), gray.info(), None).expect("fits");
        let other = noise(20, 21, PixelFormat::Gray8, 1);
        let error = extractor
            .extract(&other, &mut [0.0; 16])
            .expect_err("another size");
        assert_eq!(
            error.to_string(),
            "a frame of 20×21 gray8, expected 20×20 gray8"
        );
        assert!(matches!(
            extractor.extract(&gray, &mut [0.0; 15]),
            Err(FeatureError::Buffer { .. })
        ));
    }
}
