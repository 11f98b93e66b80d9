//! Crop that removes the borders of an image.

use taceva_core::FrameInfo;

/// Crop that removes equal borders on the left and right, and equal borders at the top and bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Crop {
    /// Number of columns removed on the left, and also on the right.
    pub(super) left: u32,
    pub(super) top: u32,
}

impl Crop {
    /// Crop that removes nothing.
    pub(super) const NONE: Crop = Crop { left: 0, top: 0 };

    /// Crop that removes the fraction `share` of the width or height at each side, rounded down to whole pixels.
    pub(super) fn border(width: u32, height: u32, share: f64) -> Crop {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "less than half of a 32-bit number fits 32 bits"
        )]
        let pixels = |side: u32| (f64::from(side) * share).floor() as u32;
        Crop {
            left: pixels(width),
            top: pixels(height),
        }
    }

    /// Size and format of an image of `whole` after the crop.
    pub(super) fn of(self, whole: FrameInfo) -> FrameInfo {
        FrameInfo {
            width: whole.width.saturating_sub(2 * self.left),
            height: whole.height.saturating_sub(2 * self.top),
            format: whole.format,
        }
    }

    /// Copies the pixels that the crop keeps to `into`. `pixels` is an image with the size and format `whole`.
    pub(super) fn copy(self, whole: FrameInfo, pixels: &[u8], into: &mut [u8]) {
        let bytes = whole.format.samples() * whole.format.bytes_per_sample();
        let size = |pixels: u32| usize::try_from(pixels).unwrap_or(usize::MAX);
        let left = self.of(whole);
        let rows = pixels
            .chunks_exact(size(whole.width) * bytes)
            .skip(size(self.top));
        let kept = into.chunks_exact_mut((size(left.width) * bytes).max(1));
        for (row, kept) in rows.zip(kept) {
            let begin = size(self.left) * bytes;
            kept.copy_from_slice(&row[begin..begin + kept.len()]);
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::PixelFormat;

    use super::*;

    #[test]
    fn a_border_is_cut_off_at_every_side() {
        let whole = FrameInfo {
            width: 8,
            height: 5,
            format: PixelFormat::Rgb8,
        };
        let crop = Crop::border(8, 5, 0.25);
        assert_eq!(crop, Crop { left: 2, top: 1 });
        let left = crop.of(whole);
        assert_eq!((left.width, left.height), (4, 3));
        let pixels: Vec<u8> = (0..120).collect();
        let mut kept = vec![0; 36];
        crop.copy(whole, &pixels, &mut kept);
        assert_eq!(kept[..12], pixels[24 + 6..24 + 18]);
        assert_eq!(kept[24..], pixels[72 + 6..72 + 18]);
        let mut all = vec![0; 120];
        Crop::NONE.copy(whole, &pixels, &mut all);
        assert_eq!(all, pixels);
    }

    #[test]
    fn the_border_of_a_large_picture_is_whole_pixels() {
        let crop = Crop::border(3280, 2464, 0.15);
        assert_eq!(
            crop,
            Crop {
                left: 492,
                top: 369
            }
        );
    }
}
