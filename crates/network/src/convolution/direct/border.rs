//! Kernel positions that overlap the picture. The border is zero, so the result has the same bits if border positions are skipped. Tiny pictures are
//! mostly border, so skipping saves more time than its shorter inner loops cost.

use std::ops::Range;

use crate::convolution::Convolution;
use crate::picture::Picture;

/// Largest side of a picture whose border is skipped, in pixels. For 2 × 2 pixels, five of the nine positions of a 3 × 3 kernel are in the border.
const SIDE: usize = 2;

/// True if the border of `picture` is skipped.
pub(super) fn is_left_out(picture: Picture) -> bool {
    picture.height.max(picture.width) <= SIDE
}

/// Output positions along one side, and the kernel positions that these outputs read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Reach {
    pub(super) positions: Range<usize>,
    pub(super) places: Range<usize>,
}

impl Reach {
    /// Reach of all `positions` outputs, each with all kernel positions.
    pub(super) fn all(convolution: Convolution, positions: usize) -> Reach {
        Reach {
            positions: 0..positions,
            places: 0..convolution.kernel,
        }
    }
}

/// One reach per output position. Contains only kernel positions inside a picture of `length` pixels along this side.
pub(super) fn reaches(convolution: Convolution, positions: usize, length: usize) -> Vec<Reach> {
    let padding = convolution.padding();
    let reach = |position: usize| {
        let first = position * convolution.stride;
        let end = (length + padding - first).min(convolution.kernel);
        Reach {
            positions: position..position + 1,
            places: padding.saturating_sub(first)..end,
        }
    };
    (0..positions).map(reach).collect()
}

/// Output positions that read the kernel position `place`, in order.
pub(super) fn positions(reaches: &[Reach], place: usize) -> impl Iterator<Item = usize> {
    let reading = reaches
        .iter()
        .filter(move |reach| reach.places.contains(&place));
    reading.flat_map(|reach| reach.positions.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_beyond_the_picture_are_left_out() {
        let convolution = |kernel, stride| Convolution {
            inputs: 16,
            outputs: 16,
            kernel,
            stride,
        };
        let places = |kernel, stride, positions, length| -> Vec<Range<usize>> {
            let reaches = reaches(convolution(kernel, stride), positions, length);
            reaches.into_iter().map(|reach| reach.places).collect()
        };
        assert_eq!(places(3, 1, 1, 1), std::slice::from_ref(&(1..2)));
        assert_eq!(places(3, 1, 2, 2), [1..3, 0..2]);
        assert_eq!(places(3, 2, 2, 4), [1..3, 0..3]);
        assert_eq!(places(7, 2, 2, 3), [3..6, 1..4]);
        assert_eq!(places(1, 2, 2, 4), [0..1, 0..1]);
    }
}
