//! Reduction of frames before they are recorded.

use serde::{Deserialize, Serialize};
use taceva_core::FrameInfo;

/// Original format and reduction method of frames that were reduced before recording.
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
    /// Size and format of a camera frame before reduction.
    #[serde(flatten)]
    pub from: FrameInfo,
    /// Description of the reduction method.
    pub by: String,
}

impl ReducedFrames {
    /// Reduction of frames of the format `from` to exact area averages, each rounded once, to 8 bits.
    pub fn area_averages(from: FrameInfo) -> ReducedFrames {
        ReducedFrames {
            from,
            by: "area averages, rounded to 8 bits".to_owned(),
        }
    }

    /// True if this reduction can produce frames of the format `info`.
    pub(crate) fn may_give(&self, info: FrameInfo) -> bool {
        let from = self.from;
        info.width <= from.width
            && info.height <= from.height
            && info.format == from.format.of_eight_bits()
    }
}
