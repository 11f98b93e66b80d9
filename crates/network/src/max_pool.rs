//! Max pooling over 3 × 3 pixels with stride 2, fused with normalisation and ReLU. The normalised pictures and their gradients are never stored.

mod backward;
mod forward;
mod greatest;

pub(crate) use backward::{Pooled, gradient_sums, input_gradient};
pub(crate) use forward::pool_normalised;
pub(crate) use greatest::pool;

use crate::picture::Picture;

/// Side of a window, pixels.
const KERNEL: usize = 3;
/// Stride, pixels.
const STRIDE: usize = 2;
/// Rows and columns of the first window outside the picture.
const PADDING: usize = 1;

/// Shape of the output for an input of shape `input`.
pub(crate) const fn output(input: Picture) -> Picture {
    Picture {
        height: (input.height - 1) / STRIDE + 1,
        width: (input.width - 1) / STRIDE + 1,
        channels: input.channels,
    }
}

/// Rows (or columns) of window `position` in a picture of `length` rows. The nearest row of the window replaces a row outside the picture, because
/// loops of fixed length stay in registers.
#[inline(always)]
fn window(position: usize, length: usize) -> [usize; KERNEL] {
    let middle = position * STRIDE;
    [
        middle.saturating_sub(PADDING),
        middle,
        (middle + 1).min(length - 1),
    ]
}

/// Windows that contain row (or column) `at`, each with the position of `at` in it, in a picture with `windows` windows. A missing second window has
/// position [`NOWHERE`] and an arbitrary valid index.
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

/// Window position of a missing window; no output has it.
const NOWHERE: u32 = 1 << 8;

/// Index of a position in a window.
#[inline(always)]
fn place(row: u32, column: u32) -> u32 {
    const ROW: u32 = 3;
    row * ROW + column
}

/// Rows (or columns) of a window, in order.
const PLACES: [u32; KERNEL] = [0, 1, 2];
