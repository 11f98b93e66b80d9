//! Why features cannot be taken.

use taceva_core::{FrameInfo, InputInfo, SignalInfo};

use super::area::AreaSums;
use super::spec::FeatureSpec;

/// Why features cannot be taken from a frame.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// The frame has fewer pixels than the features.
    #[error(
        "frames of {info} are smaller than the features asked for, {spec}; `size={}x{}` would be accepted",
        info.width.min(spec.width),
        info.height.min(spec.height)
    )]
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
    /// A size that frames cannot be reduced to.
    #[error(
        "frames of {info} cannot be reduced to {width}×{height}; expected a width from 1 to {} and a height from 1 to {}",
        info.width,
        info.height
    )]
    Reduction {
        /// The frame.
        info: FrameInfo,
        /// The width that was asked for.
        width: u32,
        /// The height that was asked for.
        height: u32,
    },
    /// Colour is asked for and there is none.
    #[error("frames of {info} have no colour; `color=gray` would be accepted")]
    Colorless {
        /// The frame.
        info: FrameInfo,
    },
    /// Slopes are asked for and there is no colour to distinguish lamps by.
    #[error(
        "frames of {info} have no colour, by which `features=gradients` distinguishes three lamps"
    )]
    Lampless {
        /// The frame.
        info: FrameInfo,
    },
    /// A comparison with a reference frame that the recording does not name.
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
    /// A frame where signals are expected, signals where a frame is, or signals of another grid.
    #[error("{found}, expected {expected}")]
    Input {
        /// What was agreed on.
        expected: InputInfo,
        /// What came.
        found: InputInfo,
    },
    /// Features of another grid than that of the signals.
    #[error("signals of {info} for features of {spec}")]
    OtherGrid {
        /// The signals.
        info: SignalInfo,
        /// The features.
        spec: FeatureSpec,
    },
    /// Differences of signals from those without contact, which nobody named.
    #[error(
        "`difference=true` needs rows without contact, and the recording names none; `rest` of `[signals]` names them"
    )]
    NoRest,
    /// Frames are asked for and there are none.
    #[error("`{asked}` applies to frames, and the recording has {has}")]
    NoFrames {
        /// The setting that asks for them.
        asked: String,
        /// What it has.
        has: &'static str,
    },
    /// Signals are asked for and there are none.
    #[error("the recording has no signals; `input=frame` would be accepted")]
    NoSignals,
    /// Frames and signals, and nobody said which of them a model is to look at.
    #[error(
        "the recording has frames and signals: `input=frame` or `input=signals` says what the model looks at"
    )]
    TwoInputs,
    /// A network over a grid of taxels that has too few of them.
    #[error(
        "a network slides over a grid of at least {least}×{least} places, and this one has {info}; every other model takes it"
    )]
    NarrowGrid {
        /// The signals.
        info: SignalInfo,
        /// Places a side that a network needs.
        least: u32,
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
