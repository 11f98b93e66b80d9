//! Image formats of a camera: size, pixel format and colour coding.

use std::fmt;

use super::ioctls::Format;

/// Code of a pixel format: four letters packed in a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FourCc(u32);

impl FourCc {
    /// Format with two bytes per pixel: one luminance for each pixel, two colour values for each pair of pixels.
    pub const YUYV: FourCc = FourCc::new(*b"YUYV");
    /// Format in which each image is a JPEG file.
    pub const MJPG: FourCc = FourCc::new(*b"MJPG");

    /// Creates the code from the kernel's number of a pixel format.
    pub(crate) const fn of(number: u32) -> FourCc {
        FourCc(number)
    }

    pub(crate) const fn number(self) -> u32 {
        self.0
    }

    /// Creates the code of a pixel format from its four letters.
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

/// Requested image size and pixel format. This struct gets no further field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureFormat {
    /// Width of the image, pixels.
    pub width: u32,
    /// Height of the image, pixels.
    pub height: u32,
    /// Pixel format of the image.
    pub pixels: FourCc,
}

impl fmt::Display for PictureFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{} {}", self.width, self.height, self.pixels)
    }
}

/// Standard for the conversion of YUYV pixels to RGB.
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

/// Image format that the camera has set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GivenFormat {
    /// Size and pixel format, as requested.
    pub picture: PictureFormat,
    /// Distance between the starts of two rows, bytes; 0 for compressed images.
    pub stride: u32,
    /// Size of an uncompressed image, bytes. For compressed images, the maximum size.
    pub bytes: u32,
    /// Standard for the conversion of YUYV pixels to RGB.
    pub coding: Coding,
}

const COLOURS_709: u32 = 3;
const CODING_601: u32 = 1;
const CODING_709: u32 = 2;
const RANGE_FULL: u32 = 1;
impl Coding {
    /// Conversion standard that `format` of the kernel states. An unknown coding follows the colour space. An unknown range counts as limited.
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
