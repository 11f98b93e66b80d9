//! That the frames of a recording are not as the camera gave them.

use serde::{Deserialize, Serialize};
use taceva_core::FrameInfo;

/// From what, and how, the frames of a recording were reduced before they were recorded.
///
/// ```
/// use taceva_core::{FrameInfo, PixelFormat};
/// use taceva_dataset::ReducedFrames;
///
/// let camera = FrameInfo { width: 160, height: 120, format: PixelFormat::Rgb16 };
/// let reduced = ReducedFrames::area_averages(camera);
/// assert_eq!(reduced.by, "area averages, rounded to 8 bits");
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReducedFrames {
    /// A frame of the camera.
    #[serde(flatten)]
    pub from: FrameInfo,
    /// How, in words.
    pub by: String,
}

impl ReducedFrames {
    /// Frames of `from`, each reduced to exact area averages that were rounded once, to 8 bits.
    pub fn area_averages(from: FrameInfo) -> ReducedFrames {
        ReducedFrames {
            from,
            by: "area averages, rounded to 8 bits".to_owned(),
        }
    }

    /// Whether frames of `info` can be what was left of those of the camera.
    pub(crate) fn may_give(&self, info: FrameInfo) -> bool {
        let from = self.from;
        info.width <= from.width
            && info.height <= from.height
            && info.format == from.format.of_eight_bits()
    }
}
