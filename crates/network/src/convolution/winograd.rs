//! Winograd's minimal filtering F(4 × 4, 3 × 3) of convolutions with stride 1. Tiles of 6 × 6 inputs and 3 × 3 kernels are transformed
//! to 36 points. At each point the convolution is a product. The sums are transformed back to tiles of 4 × 4 outputs.
//!
//! Every tile and channel has the same operations in the same order, so threads and vectors change no bit of the result.
//!
//! # Reference
//! A. Lavin, S. Gray, "Fast algorithms for convolutional neural networks", CVPR 2016.

mod forward;
mod input_gradient;
mod products;
mod single_picture;
mod sums;
mod tiles;
mod transform;
mod weight_gradient;
mod weights;

pub(super) use forward::Forward;
pub(super) use input_gradient::InputGradient;
pub(super) use weight_gradient::WeightGradient;

use super::Convolution;
use crate::panel::PANEL;
use crate::picture::Picture;

/// Side of a tile of outputs, pixels.
const TILE: usize = 4;

/// Points along one dimension, and the side of a tile of inputs.
const SIDE: usize = TILE + 2;

/// Points of a tile.
const POINTS: usize = SIDE * SIDE;

/// True if this form supports the convolution into pictures of shape `output` and saves products. At 2 × 2 pixels it saves none,
/// because a tile computes twelve outputs more.
pub(super) fn is_for(convolution: Convolution, output: Picture) -> bool {
    let Convolution {
        inputs,
        kernel,
        stride,
        ..
    } = convolution;
    kernel == 3
        && stride == 1
        && inputs.is_multiple_of(PANEL)
        && POINTS * tiles(output) < convolution.taps() * output.pixels()
}

/// Number of tiles of one output picture.
pub(super) fn tiles(output: Picture) -> usize {
    Tiles::of(output).per_picture
}

/// Stride between points, values. One panel longer than needed: strides of powers of two would map all points to the same cache
/// lines.
const fn slab(rows: usize, width: usize) -> usize {
    rows * width + PANEL
}

/// Length of the transformed weights or their gradient.
pub(super) const fn transformed_len(inputs: usize, outputs: usize) -> usize {
    outputs / PANEL * POINTS * slab(inputs, PANEL)
}

/// Tiles of outputs, counted row by row and picture by picture.
#[derive(Clone, Copy, Debug)]
struct Tiles {
    height: usize,
    width: usize,
    across: usize,
    per_picture: usize,
}

/// Position of a tile.
#[derive(Clone, Copy, Debug)]
struct TilePlace {
    image: usize,
    /// First row and column.
    y: usize,
    x: usize,
    /// Rows and columns from there to the end of the picture.
    below: usize,
    beside: usize,
}

impl Tiles {
    fn of(output: Picture) -> Tiles {
        let across = output.width.div_ceil(TILE);
        Tiles {
            height: output.height,
            width: output.width,
            across,
            per_picture: output.height.div_ceil(TILE) * across,
        }
    }

    #[inline(always)]
    fn place(&self, tile: usize) -> TilePlace {
        let (image, tile) = (tile / self.per_picture, tile % self.per_picture);
        let (y, x) = (tile / self.across * TILE, tile % self.across * TILE);
        TilePlace {
            image,
            y,
            x,
            below: self.height - y,
            beside: self.width - x,
        }
    }
}

#[cfg(test)]
mod tests;
