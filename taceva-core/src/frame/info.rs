//! Size and pixel format of a frame.

use std::fmt;

/// Storage format of one pixel. 16-bit samples are little-endian on every machine.
///
/// ```
/// use taceva_core::PixelFormat;
/// assert_eq!((PixelFormat::Rgb16.samples(), PixelFormat::Rgb16.bytes_per_sample()), (3, 2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum PixelFormat {
    /// One byte: gray.
    Gray8,
    /// Two bytes: gray.
    Gray16,
    /// Three bytes: red, green, blue.
    Rgb8,
    /// Six bytes: red, green, blue.
    Rgb16,
}

impl PixelFormat {
    /// Samples per pixel: 1 for gray, 3 for RGB.
    pub const fn samples(self) -> usize {
        match self {
            PixelFormat::Gray8 | PixelFormat::Gray16 => 1,
            PixelFormat::Rgb8 | PixelFormat::Rgb16 => 3,
        }
    }

    /// Bytes per sample: 1 or 2.
    pub const fn bytes_per_sample(self) -> usize {
        match self {
            PixelFormat::Gray8 | PixelFormat::Rgb8 => 1,
            PixelFormat::Gray16 | PixelFormat::Rgb16 => 2,
        }
    }

    /// Greatest sample value: 255 or 65535.
    pub const fn full_scale(self) -> u16 {
        match self.bytes_per_sample() {
            1 => 255,
            _ => 65_535,
        }
    }

    /// The format with the same colours and 8-bit samples.
    ///
    /// ```
    /// use taceva_core::PixelFormat;
    /// assert_eq!(PixelFormat::Rgb16.of_eight_bits(), PixelFormat::Rgb8);
    /// ```
    pub const fn of_eight_bits(self) -> PixelFormat {
        match self {
            PixelFormat::Gray8 | PixelFormat::Gray16 => PixelFormat::Gray8,
            PixelFormat::Rgb8 | PixelFormat::Rgb16 => PixelFormat::Rgb8,
        }
    }

    /// Name of the format in files.
    pub const fn name(self) -> &'static str {
        match self {
            PixelFormat::Gray8 => "gray8",
            PixelFormat::Gray16 => "gray16",
            PixelFormat::Rgb8 => "rgb8",
            PixelFormat::Rgb16 => "rgb16",
        }
    }
}

/// The size and the pixel format of a frame. This struct gets no further fields, because size and format determine the layout of the bytes.
///
/// ```
/// use taceva_core::{FrameInfo, PixelFormat};
/// let info = FrameInfo { width: 640, height: 480, format: PixelFormat::Gray8 };
/// assert_eq!(info.byte_len(), Some(307_200));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FrameInfo {
    /// Number of pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Storage format of one pixel.
    pub format: PixelFormat,
}

impl FrameInfo {
    /// Size of a whole frame in bytes, without padding; `None` if the size exceeds the address space.
    pub fn byte_len(&self) -> Option<usize> {
        let pixels = usize::try_from(self.width)
            .ok()?
            .checked_mul(usize::try_from(self.height).ok()?)?;
        pixels
            .checked_mul(self.format.samples())?
            .checked_mul(self.format.bytes_per_sample())
    }
}

impl fmt::Display for FrameInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{} {}", self.width, self.height, self.format.name())
    }
}
