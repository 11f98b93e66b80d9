//! Image formats of a camera: size, pixel format and colour coding.

use std::fmt;

use super::ioctls::Format;

/// Pixel format, as four letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FourCc(u32);

impl FourCc {
    /// Two bytes per pixel: a luminance for each, a colour for each pair.
    pub const YUYV: FourCc = FourCc::new(*b"YUYV");
    /// One JPEG file per image.
    pub const MJPG: FourCc = FourCc::new(*b"MJPG");

    /// Converts the kernel's number.
    pub(crate) const fn of(number: u32) -> FourCc {
        FourCc(number)
    }

    pub(crate) const fn number(self) -> u32 {
        self.0
    }

    /// Creates the code from four letters.
    pub const fn new(letters: [u8; 4]) -> FourCc {
        FourCc(u32::from_le_bytes(letters))
    }
}

impl fmt::Display for FourCc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters = self.0.to_le_bytes();
        write!(f, "{}", letters.escape_ascii())
    }
}

/// Requested image format: a plain value that gets no further fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureFormat {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pixel format.
    pub pixels: FourCc,
}

impl fmt::Display for PictureFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{} {}", self.width, self.height, self.pixels)
    }
}

/// Conversion from YUYV to colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// ITU-R BT.601, luminance 16 to 235.
    Limited601,
    /// ITU-R BT.601, luminance 0 to 255.
    Full601,
    /// ITU-R BT.709, luminance 16 to 235.
    Limited709,
    /// ITU-R BT.709, luminance 0 to 255.
    Full709,
}

/// Image format set at a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GivenFormat {
    /// Size and pixel format, as requested.
    pub picture: PictureFormat,
    /// Row stride, bytes; 0 for compressed images.
    pub stride: u32,
    /// Size of an image, bytes; the maximum size for compressed images.
    pub bytes: u32,
    /// Colour coding.
    pub coding: Coding,
}

const COLOURS_709: u32 = 3;
const CODING_601: u32 = 1;
const CODING_709: u32 = 2;
const RANGE_FULL: u32 = 1;
impl Coding {
    /// Coding of the kernel's image format.
    pub(crate) fn of(format: &Format) -> Coding {
        let is_709 = match format.coding {
            CODING_709 => true,
            CODING_601 => false,
            _ => format.colours == COLOURS_709,
        };
        match (is_709, format.range == RANGE_FULL) {
            (false, false) => Coding::Limited601,
            (false, true) => Coding::Full601,
            (true, false) => Coding::Limited709,
            (true, true) => Coding::Full709,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_pixels_are_shown_by_their_letters() {
        assert_eq!(FourCc::YUYV.to_string(), "YUYV");
        assert_eq!(FourCc::new(*b"A\x1b\0 ").to_string(), "A\\x1b\\x00 ");
    }

    #[test]
    fn colours_are_made_as_the_camera_says() {
        let with = |colours, coding, range| {
            Coding::of(&Format {
                colours,
                coding,
                range,
                ..Format::default()
            })
        };
        assert_eq!(with(8, 0, 0), Coding::Limited601);
        assert_eq!(with(3, 0, 2), Coding::Limited709);
        assert_eq!(with(3, 1, 1), Coding::Full601);
        assert_eq!(with(8, 2, 1), Coding::Full709);
    }
}
