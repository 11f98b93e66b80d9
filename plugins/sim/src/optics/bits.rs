//! Bits of a sample of a frame.

use taceva_core::{FrameInfo, PixelFormat};

/// Bits of a sample: 8, with 1 count per DN; or 16, with 256 counts per DN.
///
/// Eight bits suffice if the noise of a pixel is a large part of a DN. Frames of 8 bits need a fifth of the space in lossless storage. The additional bits of
/// 16-bit frames are mostly noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bits {
    /// 8 bits.
    Eight,
    /// 16 bits.
    Sixteen,
}

impl Bits {
    /// Both numbers of bits.
    pub const ALL: [Bits; 2] = [Bits::Eight, Bits::Sixteen];

    /// Name in the arguments of a driver.
    pub const fn name(self) -> &'static str {
        match self {
            Bits::Eight => "8",
            Bits::Sixteen => "16",
        }
    }

    /// Format of `info` with this number of bits per sample.
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
