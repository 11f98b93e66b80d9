//! Which pictures a camera gives: their size, how their pixels are sent, and how colours are made of them.

use std::fmt;

use super::ioctls::Format;

/// How the pixels of a picture are sent, as four letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FourCc(u32);

impl FourCc {
    /// Two bytes a pixel: brightness of each, colour of two together.
    pub const YUYV: FourCc = FourCc::new(*b"YUYV");
    /// A JPEG file a picture.
    pub const MJPG: FourCc = FourCc::new(*b"MJPG");

    /// The code that the kernel writes as a number.
    pub(crate) const fn of(number: u32) -> FourCc {
        FourCc(number)
    }

    pub(crate) const fn number(self) -> u32 {
        self.0
    }

    /// The code of four letters.
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

/// The pictures that are wanted of a camera. A plain value, which gets no further fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureFormat {
    /// Pixels of a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// How they are sent.
    pub pixels: FourCc,
}

impl fmt::Display for PictureFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{} {}", self.width, self.height, self.pixels)
    }
}

/// How colours are made of YUYV.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// ITU-R BT.601, of brightness 16 to 235.
    Limited601,
    /// ITU-R BT.601, of brightness 0 to 255.
    Full601,
    /// ITU-R BT.709, of brightness 16 to 235.
    Limited709,
    /// ITU-R BT.709, of brightness 0 to 255.
    Full709,
}

/// The pictures that a camera gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GivenFormat {
    /// Size and kind, as they were wanted.
    pub picture: PictureFormat,
    /// Bytes from one row to the next; 0 where pictures are compressed.
    pub stride: u32,
    /// The size of a picture, in bytes; the greatest size where pictures are compressed.
    pub bytes: u32,
    /// How colours are made of it.
    pub coding: Coding,
}

const COLOURS_709: u32 = 3;
const CODING_601: u32 = 1;
const CODING_709: u32 = 2;
const RANGE_FULL: u32 = 1;
impl Coding {
    /// The coding of the pictures of `format`, as the kernel describes it.
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
