//! The size at which a recording keeps its frames.

use std::fmt;

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use taceva_core::FrameInfo;

use super::setting::Setting;

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

/// What is kept of a recording that a scene makes.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table with `frames`")]
pub(super) struct WrittenRecording {
    /// The size to which frames are reduced before they are kept; as they come when absent.
    pub(super) frames: Option<Setting<WrittenSize>>,
}

/// A size as it was written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WrittenSize(pub(super) String);

/// A number is taken too, so that it is refused by the key and with what was expected.
impl<'de> Deserialize<'de> for WrittenSize {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<WrittenSize, D::Error> {
        struct Size;

        impl Visitor<'_> for Size {
            type Value = WrittenSize;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a size such as `frames = \"64x48\"`")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<WrittenSize, E> {
                Ok(WrittenSize(text.to_owned()))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<WrittenSize, E> {
                Ok(WrittenSize(number.to_string()))
            }
        }

        deserializer.deserialize_any(Size)
    }
}
