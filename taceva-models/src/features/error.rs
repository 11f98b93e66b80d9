//! Why features cannot be taken.

use taceva_core::FrameInfo;

use super::area::AreaSums;
use super::spec::FeatureSpec;

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
    /// Slopes are asked for and there is no colour to distinguish lamps by.
    #[error(
        "frames of {info} have no colour, by which `features=gradients` tells three lamps apart"
    )]
    Lampless {
        /// The frame.
        info: FrameInfo,
    },
    /// A comparison with a frame that nobody gave.
    #[error("`{asked}` needs a no-contact reference frame, and the recording names none")]
    NoReference {
        /// The setting that asks for it.
        asked: &'static str,
    },
    /// Markers are asked for and the reference frame shows none.
    #[error(
        "`features=markers` needs a grid of markers, and the no-contact reference frame shows {}",
        match found { 0 => "no spot that stands out".to_owned(), count => format!("{count} spots at uneven distances") }
    )]
    NoMarkers {
        /// Spots that stand out, but stand in no grid.
        found: usize,
    },
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
