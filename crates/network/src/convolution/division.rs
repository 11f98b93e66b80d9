//! How the outputs of one picture are divided among threads. Each is the same sum in the same order wherever it is made, so that
//! a division changes the time that a pass takes, and no bit.

use crate::panel::PANEL;

/// Products that are worth a part of their own: about ten microseconds.
const PRODUCTS_WORTH_A_PART: usize = 1 << 18;

/// Pixels that take as long to multiply with a row of weights as the row takes to come from a cache of the second or third level.
const PIXELS_OF_A_READ: usize = 8;

/// How the outputs of one picture are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Division {
    /// Not at all.
    Whole,
    /// Into so many stretches of pixels: all parts read all weights.
    Pixels(usize),
    /// Into so many groups of panels of channels: all parts read all of the picture.
    Panels(usize),
}

/// What there is to be divided.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outputs {
    /// Pixels that are summed one by one: of tiles, those of one point.
    pub(super) pixels: usize,
    /// Such pixels that stay together.
    pub(super) together: usize,
    /// Panels of channels that are written.
    pub(super) panels: usize,
    /// Products of one pixel and channel.
    pub(super) products: usize,
    /// Of how many such sums: the points of tiles.
    pub(super) points: usize,
}

impl Outputs {
    /// Into as many as `parts` parts, as will be done first.
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

/// About how long a part of so many pixels and panels takes, in quarters of what a pixel and a panel do. Four panels at once are as many as tiles of
/// sums have at most; with fewer of them a number is loaded for fewer products.
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
