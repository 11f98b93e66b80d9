//! Input of a model: the picture of a camera, or the readings of taxels.

use std::fmt;

use crate::field::Field;
use crate::frame::{Frame, FrameInfo};
use crate::signals::{SignalInfo, Signals};

/// Borrowed input of a model from one sample.
///
/// ```
/// use taceva_core::{Field, Input, SignalInfo, Signals, Unit};
/// let info = SignalInfo::new(1, 2, 1, Unit::Count)?;
/// let signals = Signals::new(info, vec![512.0, 498.0])?;
/// let input = Input::from(&signals);
/// assert_eq!((input.info(), input.info().field()), (info.into(), Field::Signals));
/// # Ok::<(), taceva_core::SignalError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Input<'a> {
    /// Picture of the gel.
    Frame(&'a Frame),
    /// Readings of the taxels.
    Signals(&'a Signals),
}

impl Input<'_> {
    /// Kind of the input, picture or readings of taxels, with its size.
    pub fn info(&self) -> InputInfo {
        match self {
            Input::Frame(frame) => InputInfo::Frame(frame.info()),
            Input::Signals(signals) => InputInfo::Signals(signals.info()),
        }
    }
}

impl<'a> From<&'a Frame> for Input<'a> {
    fn from(frame: &'a Frame) -> Input<'a> {
        Input::Frame(frame)
    }
}

impl<'a> From<&'a Signals> for Input<'a> {
    fn from(signals: &'a Signals) -> Input<'a> {
        Input::Signals(signals)
    }
}

/// Size of a model's input, which is a picture or the readings of taxels.
///
/// A file stores this value under the key `frame` or the key `signals`.
///
/// ```
/// use taceva_core::{FrameInfo, InputInfo, PixelFormat};
/// let info = FrameInfo { width: 64, height: 48, format: PixelFormat::Gray8 };
/// assert_eq!(InputInfo::from(info).to_string(), "a frame of 64×48 gray8");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum InputInfo {
    /// Size and pixel format of a picture.
    Frame(FrameInfo),
    /// Size and unit of the readings of taxels.
    Signals(SignalInfo),
}

impl InputInfo {
    /// Part of a sample that holds this input: the frame or the signals.
    pub const fn field(&self) -> Field {
        match self {
            InputInfo::Frame(_) => Field::Frame,
            InputInfo::Signals(_) => Field::Signals,
        }
    }
}

impl From<FrameInfo> for InputInfo {
    fn from(info: FrameInfo) -> InputInfo {
        InputInfo::Frame(info)
    }
}

impl From<SignalInfo> for InputInfo {
    fn from(info: SignalInfo) -> InputInfo {
        InputInfo::Signals(info)
    }
}

impl fmt::Display for InputInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InputInfo::Frame(info) => write!(f, "a frame of {info}"),
            InputInfo::Signals(info) => write!(f, "signals of {info}"),
        }
    }
}
