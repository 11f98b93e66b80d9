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

/// Window that contains a row (or column), with the position of the row in it.
#[derive(Clone, Copy)]
struct CoveringWindow {
    place: u32,
    window: usize,
}

impl CoveringWindow {
    /// True if the window exists.
    #[inline(always)]
    fn is_there(&self) -> bool {
        self.place != NOWHERE
    }
}

/// Windows that contain row (or column) `at`, each with the position of `at` in it, in a picture with `windows` windows. A missing second window has
/// position [`NOWHERE`] and an arbitrary valid index.
#[inline(always)]
fn windows(at: usize, windows: usize) -> [CoveringWindow; 2] {
    let covering = |place, window| CoveringWindow { place, window };
    let before = at / STRIDE;
    if at.is_multiple_of(STRIDE) {
        [covering(1, before), covering(NOWHERE, before)]
    } else {
        let after = before + 1;
        let first = if after < windows { 0 } else { NOWHERE };
        [covering(first, after.min(windows - 1)), covering(2, before)]
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
