//! Winograd's minimal filtering F(4 × 4, 3 × 3) of convolutions with stride 1. Tiles of 6 × 6 inputs and 3 × 3 kernels are transformed to 36 points. At each
//! point, the convolution becomes a product. The sums of products are transformed back to tiles of 4 × 4 outputs.
//!
//! Every tile and channel has the same operations in the same order. The result therefore has the same bits for any number of threads and any vector width.
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

/// Side of a tile of outputs, in pixels.
const TILE: usize = 4;

/// Number of points along one dimension, which is also the side of a tile of inputs.
const SIDE: usize = TILE + 2;

/// Number of points of a tile.
const POINTS: usize = SIDE * SIDE;

/// True if this algorithm supports the convolution into pictures of shape `output`, and saves products. For 2 × 2 pixels it saves none, because a tile then
/// computes twelve unused outputs.
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

/// Stride between points, in values. The stride is one panel longer than needed, because strides of powers of two would map all points to the same cache lines.
const fn slab(rows: usize, width: usize) -> usize {
    rows * width + PANEL
}

/// Length of the transformed weights, and of their gradient.
pub(super) const fn transformed_len(inputs: usize, outputs: usize) -> usize {
    outputs / PANEL * POINTS * slab(inputs, PANEL)
}

/// Tiles of outputs, counted row by row, and picture by picture.
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
    /// First row and first column of the tile in the picture.
    y: usize,
    x: usize,
    /// Number of rows and columns from the tile's start to the end of the picture.
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
