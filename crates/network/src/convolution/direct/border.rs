//! Places of a kernel that meet the picture and not its border. What they do not meet is zero and adds nothing, so that leaving it out changes
//! no bit; it is worth the shorter runs where nearly everything is border.

use std::ops::Range;

use crate::convolution::Convolution;
use crate::picture::Picture;

/// Rows and columns up to which the border is left out: at 2 × 2 a kernel of 3 × 3 meets it with five of its nine places.
const SIDE: usize = 2;

/// Whether the border of `picture` is left out.
pub(super) fn is_left_out(picture: Picture) -> bool {
    picture.height.max(picture.width) <= SIDE
}

/// Positions along one side, and the places of the kernel that they read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Reach {
    pub(super) positions: Range<usize>,
    pub(super) places: Range<usize>,
}

impl Reach {
    /// All of so many positions with all places.
    pub(super) fn all(convolution: Convolution, positions: usize) -> Reach {
        Reach {
            positions: 0..positions,
            places: 0..convolution.kernel,
        }
    }
}

/// Each of so many positions with the places that meet a picture of `length` pixels along that side.
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

/// The positions that read `place`, in their order.
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
