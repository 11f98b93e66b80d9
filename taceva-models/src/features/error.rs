//! Errors of feature extraction.

use taceva_core::{FrameInfo, InputInfo, SignalInfo};

use super::area::AreaSums;
use super::spec::FeatureSpec;
use super::window::FrameWindow;

/// Error of feature extraction.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// The frame has fewer pixels than the requested features have cells.
    #[error(
        "frames of {info} are smaller than the requested features, {spec}; set `size={}x{}`",
        info.width.min(spec.width),
        info.height.min(spec.height)
    )]
    Small {
        /// Frame size and format.
        info: FrameInfo,
        /// Requested features.
        spec: FeatureSpec,
    },
    /// The frame has too many rows for exact sums.
    #[error("frames of {info} have more than {} rows", AreaSums::ROWS_MAX)]
    Tall {
        /// Frame size and format.
        info: FrameInfo,
    },
    /// Frames cannot be reduced to this size.
    #[error(
        "frames of {info} cannot be reduced to {width}×{height}; expected a width from 1 to {} and a height from 1 to {}",
        info.width,
        info.height
    )]
    Reduction {
        /// Frame size and format.
        info: FrameInfo,
        /// Requested width.
        width: u32,
        /// Requested height.
        height: u32,
    },
    /// Colour was requested, but frames are gray.
    #[error("frames of {info} have no colour; set `color=gray`")]
    Colorless {
        /// Frame size and format.
        info: FrameInfo,
    },
    /// Slopes were requested, but gray frames do not distinguish the lamps.
    #[error(
        "frames of {info} have no colour, but `features=gradients` distinguishes three lamps by their colours"
    )]
    Lampless {
        /// Frame size and format.
        info: FrameInfo,
    },
    /// A reference frame is needed, but the recording names none.
    #[error(
        "`{asked}` needs a no-contact reference frame, but the recording names none; import it with `reference = \"rest.png\"`, or \
         `reference = {{ frame = 0 }}` for a frame of its clip or array, in [frame] of the map"
    )]
    NoReference {
        /// Setting that needs the reference frame.
        asked: &'static str,
    },
    /// Markers were requested, but the reference frame shows none.
    #[error(
        "`features=markers` needs a grid of markers, but the no-contact reference frame shows {}",
        match found { 0 => "no distinct spot".to_owned(), count => format!("{count} spots at uneven distances") }
    )]
    NoMarkers {
        /// Number of significant spots that belong to no grid.
        found: usize,
    },
    /// The size or format of the frame differs from earlier frames, or from the frames of the model.
    #[error("a frame of {found}, expected {expected}")]
    Kind {
        /// Expected size and format.
        expected: FrameInfo,
        /// Found size and format.
        found: FrameInfo,
    },
    /// The input is a frame instead of signals, signals instead of a frame, or signals of another grid.
    #[error("{found}, expected {expected}")]
    Input {
        /// Expected input.
        expected: InputInfo,
        /// Found input.
        found: InputInfo,
    },
    /// The features and the signals have different grids.
    #[error("signals of {info} do not fit features of {spec}")]
    OtherGrid {
        /// Grid of the signals.
        info: SignalInfo,
        /// Requested features.
        spec: FeatureSpec,
    },
    /// Differences of signals were requested, but the recording names no contact-free signals.
    #[error(
        "`difference=true` needs rows without contact, but the recording names none; name them with `rest` of `[signals]`"
    )]
    NoRest,
    /// Frames are needed, but the recording contains none.
    #[error("`{asked}` applies to frames, but the recording has {has}")]
    NoFrames {
        /// Setting that needs frames.
        asked: String,
        /// Content of the recording.
        has: &'static str,
    },
    /// Signals are needed, but the recording contains none.
    #[error("the recording has no signals; set `input=frame`")]
    NoSignals,
    /// The recording has frames and signals, and no setting selects one of them.
    #[error("the recording has frames and signals: set `input=frame` or `input=signals`")]
    TwoInputs,
    /// The grid of taxels is too small for a network.
    #[error(
        "a network needs a grid of at least {least}×{least} places, found {info}; every other model accepts it"
    )]
    NarrowGrid {
        /// Grid of the signals.
        info: SignalInfo,
        /// Minimum number of cells along a side for a network.
        least: u32,
    },
    /// The model reads windows, and one frame is given.
    #[error(
        "the model reads windows of {} frames, expected a model of single frames: fit one without `window`",
        window.frames()
    )]
    Window {
        /// Frames that one sample of the model reads.
        window: FrameWindow,
    },
    /// The caller's buffer has the wrong length.
    #[error("a buffer of {found} numbers, expected {expected}, one per feature")]
    Buffer {
        /// Number of features.
        expected: usize,
        /// Length of the buffer.
        found: usize,
    },
}
