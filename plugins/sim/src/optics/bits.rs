//! How many bits a sample of a frame has.

use taceva_core::{FrameInfo, PixelFormat};

/// Bits of a sample: 8, a count a DN; or 16, 256 counts a DN.
///
/// Eight are enough where the noise of a pixel is a good part of a DN, and take a fifth of the room when they are stored without loss:
/// what sixteen hold beyond is mostly noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bits {
    /// 8.
    Eight,
    /// 16.
    Sixteen,
}

impl Bits {
    /// Both.
    pub const ALL: [Bits; 2] = [Bits::Eight, Bits::Sixteen];

    /// As it is written.
    pub const fn name(self) -> &'static str {
        match self {
            Bits::Eight => "8",
            Bits::Sixteen => "16",
        }
    }

    /// A frame as `info` says, with samples of so many bits.
    pub fn of(self, info: FrameInfo) -> FrameInfo {
        let is_gray = info.format.samples() == 1;
        let format = match (self, is_gray) {
            (Bits::Eight, true) => PixelFormat::Gray8,
            (Bits::Eight, false) => PixelFormat::Rgb8,
            (Bits::Sixteen, true) => PixelFormat::Gray16,
            (Bits::Sixteen, false) => PixelFormat::Rgb16,
        };
        FrameInfo { format, ..info }
    }
}
