//! Division of the outputs of one picture among threads. Every output is the same sum in the same order. A division therefore affects only the run time, not
//! the result.

use crate::panel::PANEL;

/// Minimum number of products in a part, which is about ten microseconds of work.
const PRODUCTS_WORTH_A_PART: usize = 1 << 18;

/// Time to read a row of weights from the second- or third-level cache. The unit is the time to multiply one pixel with this row.
const PIXELS_OF_A_READ: usize = 8;

/// Division of the outputs of one picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Division {
    /// No division.
    Whole,
    /// Division into this number of ranges of pixels. Each part reads all weights.
    Pixels(usize),
    /// Division into this number of groups of channel panels. Each part reads the whole picture.
    Panels(usize),
}

/// Size of the work to divide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outputs {
    /// Number of pixels, or of tiles in Winograd's algorithm.
    pub(super) pixels: usize,
    /// Number of pixels in a group that is never divided.
    pub(super) together: usize,
    /// Number of panels of output channels.
    pub(super) panels: usize,
    /// Number of products per pixel and output channel.
    pub(super) products: usize,
    /// Number of points per tile in Winograd's algorithm, otherwise 1.
    pub(super) points: usize,
}

impl Outputs {
    /// Division into at most `parts` parts with the least estimated time.
    pub(super) fn divided(self, parts: usize) -> Division {
        let all = self.pixels * self.points * self.products * self.panels * PANEL;
        let parts = parts.min(all / PRODUCTS_WORTH_A_PART);
        if parts < 2 {
            return Division::Whole;
        }
        let pixels = self.pixels.div_ceil(parts).next_multiple_of(self.together);
        let pixels = pixels.min(self.pixels);
        let panels = self.panels.div_ceil(parts);
        if time(self.pixels, panels) < time(pixels, self.panels) {
            Division::Panels(self.panels.div_ceil(panels))
        } else if pixels < self.pixels {
            Division::Pixels(self.pixels.div_ceil(pixels))
        } else {
            Division::Whole
        }
    }
}

/// Estimated time of a part. The unit is a quarter of the time that one pixel of one panel takes. A tile of sums contains at most four panels. With
/// fewer panels, each loaded value is used for fewer products.
fn time(pixels: usize, panels: usize) -> usize {
    let effort = 4 * panels + if panels.is_multiple_of(4) { 0 } else { 2 };
    pixels * effort + PIXELS_OF_A_READ * 4 * panels
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direct(side: usize, channels: usize) -> Outputs {
        Outputs {
            pixels: side * side,
            together: 6,
            panels: channels / PANEL,
            products: 9 * channels,
            points: 1,
        }
    }

    #[test]
    fn large_pictures_are_divided_by_pixels_and_those_with_many_channels_by_panels() {
        let two = |side, channels| direct(side, channels).divided(2);
        assert_eq!(two(32, 64), Division::Pixels(2));
        assert_eq!(two(16, 64), Division::Pixels(2));
        assert_eq!(two(8, 128), Division::Panels(2));
        assert_eq!(two(2, 512), Division::Panels(2));
        assert_eq!(direct(4, 256).divided(8), Division::Panels(8));
        assert_eq!(direct(16, 64).divided(8), Division::Pixels(8));
    }

    #[test]
    fn what_is_little_or_for_one_thread_or_cannot_be_divided_stays_whole() {
        assert_eq!(direct(32, 64).divided(1), Division::Whole);
        assert_eq!(direct(4, 16).divided(8), Division::Whole);
        let one = Outputs {
            products: 1 << 20,
            ..direct(1, 16)
        };
        assert_eq!(one.divided(4), Division::Whole);
    }
}
