//! Errors of feature extraction.

use taceva_core::{FrameInfo, InputInfo, SignalInfo};

use super::area::AreaSums;
use super::spec::FeatureSpec;
use super::window::FrameWindow;

/// Error that prevents the extraction of features from a frame or from signals.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// The frame has fewer pixels than the requested features have cells, along at least one side.
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
    /// The frame cannot be reduced to the requested size, because the size is 0 or exceeds the frame.
    #[error(
        "frames of {info} cannot be reduced to {width}×{height}; expected a width from 1 to {} and a height from 1 to {}",
        info.width,
        info.height
    )]
    Reduction {
        /// Frame size and format.
        info: FrameInfo,
        /// Requested width, in pixels.
        width: u32,
        /// Requested height, in pixels.
        height: u32,
    },
    /// Colour was requested, but frames are gray.
    #[error("frames of {info} have no colour; set `color=gray`")]
    Colorless {
        /// Frame size and format.
        info: FrameInfo,
    },
    /// Surface slopes were requested. They need the colours of three lamps, but frames are gray.
    #[error(
        "frames of {info} have no colour, but `features=gradients` distinguishes three lamps by their colours"
    )]
    Lampless {
        /// Frame size and format.
        info: FrameInfo,
    },
    /// A reference frame of the untouched gel is needed, but the recording names none.
    #[error(
        "`{asked}` needs a no-contact reference frame, but the recording names none; import it with `reference = \"rest.png\"`, or \
         `reference = {{ frame = 0 }}` for a frame of its clip or array, in [frame] of the map"
    )]
    NoReference {
        /// Setting that needs the reference frame.
        asked: &'static str,
    },
    /// Markers were requested, but the reference frame shows no grid of markers.
    #[error(
        "`features=markers` needs a grid of markers, but the no-contact reference frame shows {}",
        match found { 0 => "no distinct spot".to_owned(), count => format!("{count} spots at uneven distances") }
    )]
    NoMarkers {
        /// Number of spots found, which form no even grid.
        found: usize,
    },
    /// The size or format of the frame differs from earlier frames, or from the frames of the model.
    #[error("a frame of {found}, expected {expected}")]
    Kind {
        /// Expected size and format of the frame.
        expected: FrameInfo,
        /// Size and format of the given frame.
        found: FrameInfo,
    },
    /// The input is a frame instead of signals, signals instead of a frame, or signals of another grid.
    #[error("{found}, expected {expected}")]
    Input {
        /// Expected kind of input, with its frame size or grid.
        expected: InputInfo,
        /// Kind of the given input, with its frame size or grid.
        found: InputInfo,
    },
    /// The features and the signals have different grids.
    #[error("signals of {info} do not fit features of {spec}")]
    OtherGrid {
        /// Rows, columns and values per taxel of the signals.
        info: SignalInfo,
        /// Requested features.
        spec: FeatureSpec,
    },
    /// The difference from contact-free signals was requested, but the recording names none.
    #[error(
        "`difference=true` needs rows without contact, but the recording names none; name them with `rest` of `[signals]`"
    )]
    NoRest,
    /// Frames are needed, but the recording contains none.
    #[error("`{asked}` applies to frames, but the recording has {has}")]
    NoFrames {
        /// Setting that needs frames.
        asked: String,
        /// Content of the recording instead of frames.
        has: &'static str,
    },
    /// Signals are needed, but the recording contains none.
    #[error("the recording has no signals; set `input=frame`")]
    NoSignals,
    /// The recording has frames and signals, and no setting selects one of them.
    #[error("the recording has frames and signals: set `input=frame` or `input=signals`")]
    TwoInputs,
    /// The grid of taxels has too few rows or columns for a network.
    #[error(
        "a network needs a grid of at least {least}×{least} places, found {info}; every other model accepts it"
    )]
    NarrowGrid {
        /// Rows, columns and values per taxel of the signals.
        info: SignalInfo,
        /// Minimum number of rows and of columns.
        least: u32,
    },
    /// Each prediction of the model needs a window of several frames, but a single frame is given.
    #[error(
        "the model reads windows of {} frames, expected a model of single frames: fit one without `window`",
        window.frames()
    )]
    Window {
        /// Frames in the window of one prediction.
        window: FrameWindow,
    },
    /// The caller's buffer for the features has the wrong length.
    #[error("a buffer of {found} numbers, expected {expected}, one per feature")]
    Buffer {
        /// Number of features, which the buffer must hold.
        expected: usize,
        /// Length of the given buffer, in values.
        found: usize,
    },
}
