//! Max pooling over 3 × 3 pixels with stride 2, of pictures that are normalised and passed through ReLU on the way: neither the
//! normalised pictures nor their gradients are ever written.

mod backward;
mod forward;
mod greatest;

pub(crate) use backward::{Pooled, gradient_sums, input_gradient};
pub(crate) use forward::pool_normalised;
pub(crate) use greatest::pool;

use crate::picture::Picture;

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

/// The rows (or columns) that window `position` compares, of a picture that has `length`. One beside the picture is replaced by one
/// within it, which the window has already: loops of a fixed length stay in registers.
#[inline(always)]
fn window(position: usize, length: usize) -> [usize; KERNEL] {
    let middle = position * STRIDE;
    [
        middle.saturating_sub(PADDING),
        middle,
        (middle + 1).min(length - 1),
    ]
}

/// The windows that compare row (or column) `at`, each with the place of `at` in it, of a picture with `windows`; nowhere and any window
/// where there is no second.
#[inline(always)]
fn windows(at: usize, windows: usize) -> [(u32, usize); 2] {
    let before = at / STRIDE;
    if at.is_multiple_of(STRIDE) {
        [(1, before), (NOWHERE, before)]
    } else {
        let after = before + 1;
        let first = if after < windows { 0 } else { NOWHERE };
        [(first, after.min(windows - 1)), (2, before)]
    }
}

/// A row or column of a window that no output came from.
const NOWHERE: u32 = 1 << 8;

/// The number of a place in a window.
#[inline(always)]
fn place(row: u32, column: u32) -> u32 {
    const ROW: u32 = 3;
    row * ROW + column
}

/// Rows (or columns) of a window, in order.
const PLACES: [u32; KERNEL] = [0, 1, 2];
