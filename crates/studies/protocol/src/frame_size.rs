//! Size of stored frames.

use std::fmt;

use serde::Serialize;
use taceva_core::FrameInfo;

/// Width and height of a frame, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct FrameSize {
    /// Width, in pixels.
    pub width: u32,
    /// Height, in pixels.
    pub height: u32,
}

impl FrameSize {
    /// Longest accepted side, in pixels.
    pub const SIDE_MAX: u32 = 16_384;

    /// Parses `WIDTHxHEIGHT`; `None` for other text or a side outside 1 to [`SIDE_MAX`](Self::SIDE_MAX).
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

    /// True if the frame has at least this many columns and rows.
    pub const fn holds(self, [width, height]: [u32; 2]) -> bool {
        width <= self.width && height <= self.height
    }

    /// True if frames of `info` can be reduced to this size.
    pub(crate) fn is_within(self, info: FrameInfo) -> bool {
        self.width <= info.width && self.height <= info.height
    }

    /// Format of the stored frames: this size, with 8 bits per value.
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
