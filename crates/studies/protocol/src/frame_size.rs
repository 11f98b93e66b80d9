//! The size at which a recording keeps its frames.

use std::fmt;

use serde::Serialize;
use taceva_core::FrameInfo;

/// The sides of a frame, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct FrameSize {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl FrameSize {
    /// The longest side that is accepted.
    pub const SIDE_MAX: u32 = 16_384;

    /// The size that `text` says, `WIDTHxHEIGHT`; `None` if it says none, or a side is out of range.
    pub(crate) fn parse(text: &str) -> Option<FrameSize> {
        let side = |text: &str| {
            let is_whole = text.bytes().all(|byte| byte.is_ascii_digit());
            let side = text.parse().ok().filter(|_| is_whole)?;
            (1..=FrameSize::SIDE_MAX).contains(&side).then_some(side)
        };
        let (width, height) = text.split_once('x')?;
        Some(FrameSize {
            width: side(width)?,
            height: side(height)?,
        })
    }

    /// Whether a model can look at so many cells of a frame of this size.
    pub const fn holds(self, [width, height]: [u32; 2]) -> bool {
        width <= self.width && height <= self.height
    }

    /// Whether frames of `info` can be reduced to this size.
    pub(crate) fn is_within(self, info: FrameInfo) -> bool {
        self.width <= info.width && self.height <= info.height
    }

    /// What is kept of frames of `info`: this size, in 8 bits.
    pub fn kept(self, info: FrameInfo) -> FrameInfo {
        FrameInfo {
            width: self.width,
            height: self.height,
            format: info.format.of_eight_bits(),
        }
    }
}

impl fmt::Display for FrameSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}
