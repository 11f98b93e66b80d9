//! The greatest of 3 × 3 pixels, every second pixel, of pictures that are normalised and cut at zero on the way: neither the
//! normalised pictures nor their gradients are ever written.

mod backward;
mod forward;
mod greatest;

pub(crate) use backward::{Pooled, gradient_sums, input_gradient};
pub(crate) use forward::pool_normalised;
pub(crate) use greatest::pool;

use crate::planes::Picture;

/// Rows and columns that are compared.
const KERNEL: usize = 3;
/// Pixels from one window to the next.
const STRIDE: usize = 2;
/// Rows and columns of the first window that lie outside the picture.
const PADDING: usize = 1;

/// The picture that comes of `input`.
pub(crate) const fn output(input: Picture) -> Picture {
    Picture {
        height: (input.height - 1) / STRIDE + 1,
        width: (input.width - 1) / STRIDE + 1,
        channels: input.channels,
    }
}

/// The rows (or columns) that window `position` compares, with their place in it, of a picture that has `length`.
#[inline(always)]
fn window(position: usize, length: usize) -> impl Iterator<Item = (usize, usize)> {
    let first = position * STRIDE;
    (0..KERNEL).filter_map(move |place| {
        let at = (first + place).checked_sub(PADDING)?;
        (at < length).then_some((place, at))
    })
}

/// The windows that compare row (or column) `at`, with its place in them, of a picture with `windows`.
#[inline(always)]
fn windows(at: usize, windows: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..KERNEL).filter_map(move |place| {
        let first = (at + PADDING).checked_sub(place)?;
        let window = first / STRIDE;
        (first.is_multiple_of(STRIDE) && window < windows).then_some((place, window))
    })
}
