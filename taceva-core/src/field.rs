//! Names of the parts of a sample. A reader decodes and stores only the parts that its caller names.

use std::ops::BitOr;

use crate::display::display;

/// One part of a [`Sample`](crate::Sample).
///
/// ```
/// use taceva_core::Field;
/// assert_eq!(Field::Repeat.name(), "repeat");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
#[non_exhaustive]
pub enum Field {
    /// Picture of the gel.
    Frame,
    /// Readings of the reference instruments.
    Truth,
    /// Predictions of a model.
    Prediction,
    /// Contact point; confidence intervals cluster samples by this point.
    Point,
    /// Depth level within a contact point.
    DepthStep,
    /// Number of the press among repeated presses of one contact point.
    Repeat,
    /// Branch of the press: load or unload.
    Phase,
    /// Lighting scene, or another condition of the recording.
    Scene,
    /// Individual unit of the sensor model.
    UnitId,
    /// Time at which the sample was observed.
    Stamp,
    /// Relief of the touched grating: lines or dots.
    Kind,
    /// Spacing of the touched grating, mm.
    Spacing,
    /// Grating spacing that a model predicts, mm.
    PredictedSpacing,
    /// Mean luma of the picture's pixels.
    Intensity,
    /// Digest of the picture's bytes. Equal digests show equal pictures without decoding.
    FrameDigest,
    /// Readings of the taxels, for a sensor with taxels instead of a camera.
    Signals,
}

impl Field {
    /// Every field.
    pub const ALL: [Field; 16] = [
        Field::Frame,
        Field::Truth,
        Field::Prediction,
        Field::Point,
        Field::DepthStep,
        Field::Repeat,
        Field::Phase,
        Field::Scene,
        Field::UnitId,
        Field::Stamp,
        Field::Kind,
        Field::Spacing,
        Field::PredictedSpacing,
        Field::Intensity,
        Field::FrameDigest,
        Field::Signals,
    ];

    /// Name of the field in plans and messages.
    pub const fn name(self) -> &'static str {
        match self {
            Field::Frame => "frame",
            Field::Truth => "truth",
            Field::Prediction => "prediction",
            Field::Point => "point_id",
            Field::DepthStep => "depth_step",
            Field::Repeat => "repeat",
            Field::Phase => "phase",
            Field::Scene => "scene",
            Field::UnitId => "unit_id",
            Field::Stamp => "t_s",
            Field::Kind => "kind",
            Field::Spacing => "spacing_mm",
            Field::PredictedSpacing => "predicted spacing_mm",
            Field::Intensity => "intensity",
            Field::FrameDigest => "frame_sha256",
            Field::Signals => "signals",
        }
    }
}

display!(Field, name);

/// A set of fields.
///
/// ```
/// use taceva_core::{Field, FieldSet};
/// let fields = FieldSet::EMPTY.with(Field::Truth).with(Field::Point);
/// assert!(fields.contains(Field::Point) && !fields.contains(Field::Prediction));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FieldSet {
    bits: u32,
}

impl FieldSet {
    /// The set without any field.
    pub const EMPTY: FieldSet = FieldSet { bits: 0 };
    /// Fields needed to score predictions: truth, prediction and contact point.
    pub const PAIRS: FieldSet = FieldSet::EMPTY
        .with(Field::Truth)
        .with(Field::Prediction)
        .with(Field::Point);

    /// Returns this set with `field` added.
    pub const fn with(self, field: Field) -> FieldSet {
        FieldSet {
            bits: self.bits | 1 << field as u8,
        }
    }

    /// Returns this set without `field`.
    pub const fn without(self, field: Field) -> FieldSet {
        FieldSet {
            bits: self.bits & !(1 << field as u8),
        }
    }

    /// True if `field` is in the set.
    pub const fn contains(self, field: Field) -> bool {
        self.bits & 1 << field as u8 != 0
    }

    /// Fields of the set, in the order in which [`Field`] declares them.
    pub fn iter(self) -> impl Iterator<Item = Field> {
        Field::ALL
            .into_iter()
            .filter(move |field| self.contains(*field))
    }
}

impl BitOr for FieldSet {
    type Output = FieldSet;
    fn bitor(self, other: FieldSet) -> FieldSet {
        FieldSet {
            bits: self.bits | other.bits,
        }
    }
}

impl FromIterator<Field> for FieldSet {
    fn from_iter<I: IntoIterator<Item = Field>>(fields: I) -> FieldSet {
        fields.into_iter().fold(FieldSet::EMPTY, FieldSet::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_was_put_in_and_nothing_else() {
        for field in Field::ALL {
            let only = FieldSet::EMPTY.with(field);
            assert_eq!(only.iter().collect::<Vec<_>>(), [field]);
            assert_eq!(only.without(field), FieldSet::EMPTY);
        }
        assert_eq!(
            Field::ALL.into_iter().collect::<FieldSet>().iter().count(),
            Field::ALL.len()
        );
    }
}
