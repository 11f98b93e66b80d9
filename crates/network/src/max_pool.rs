//! Max pooling over 3 × 3 pixels with stride 2, fused with normalisation and ReLU. Normalised pictures and their gradients are never stored.

mod backward;
mod forward;
mod greatest;

pub(crate) use backward::{Pooled, gradient_sums, input_gradient};
pub(crate) use forward::pool_normalised;
pub(crate) use greatest::pool;

use crate::picture::Picture;

/// Side of a pooling window, in pixels.
const KERNEL: usize = 3;
/// Distance between pooling windows, in pixels.
const STRIDE: usize = 2;
/// Number of rows and columns of the first window that are outside the picture.
const PADDING: usize = 1;

/// Shape of the output for an input of shape `input`.
pub(crate) const fn output(input: Picture) -> Picture {
    Picture {
        height: (input.height - 1) / STRIDE + 1,
        width: (input.width - 1) / STRIDE + 1,
        channels: input.channels,
    }
}

/// Rows (or columns) of window `position` in a picture of `length` rows. A row outside the picture is replaced by the nearest row of the window, because loops
/// of fixed length remain in registers.
#[inline(always)]
fn window(position: usize, length: usize) -> [usize; KERNEL] {
    let middle = position * STRIDE;
    [
        middle.saturating_sub(PADDING),
        middle,
        (middle + 1).min(length - 1),
    ]
}

/// A window that contains a given row (or column), and the position of the row in the window.
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

/// Windows that contain row (or column) `at` in a picture with `windows` windows, each with the position of `at`. A missing window has position
/// [`NOWHERE`] and an arbitrary valid index.
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

/// Position of a row in a missing window. No output has this position.
const NOWHERE: u32 = 1 << 8;

/// Index of a pixel of a window, from its row and column.
#[inline(always)]
fn place(row: u32, column: u32) -> u32 {
    const ROW: u32 = 3;
    row * ROW + column
}

/// Positions of rows (or columns) in a window, in order.
const PLACES: [u32; KERNEL] = [0, 1, 2];
