//! Winograd's minimal filtering F(4 × 4, 3 × 3) of convolutions with a stride of 1: tiles of 6 × 6 inputs and kernels of 3 × 3 become
//! values at 36 points, where a product is all that a convolution takes, and of their sums become tiles of 4 × 4 outputs.
//!
//! Tile by tile and channel by channel the same operations in the same order, so that neither threads nor vectors change a bit.
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

/// Rows and columns of a tile of outputs.
const TILE: usize = 4;

/// Points of one dimension: as many as a tile of inputs has rows.
const SIDE: usize = TILE + 2;

/// Points of both.
const POINTS: usize = SIDE * SIDE;

/// Whether this form takes a convolution into pictures of `output`, and multiplies less there: not at 2 × 2 pixels, of which a tile
/// has all and twelve more.
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

/// Tiles of a picture of outputs.
pub(super) fn tiles(output: Picture) -> usize {
    Tiles::of(output).per_picture
}

/// Numbers from what lies at one point to what lies at the next: a panel more than needed, as powers of two would send all of them to
/// the same lines of a cache.
const fn slab(rows: usize, width: usize) -> usize {
    rows * width + PANEL
}

/// Numbers of transformed weights, or of their gradient.
pub(super) const fn transformed_len(inputs: usize, outputs: usize) -> usize {
    outputs / PANEL * POINTS * slab(inputs, PANEL)
}

/// Tiles of outputs, counted row by row and picture after picture.
#[derive(Clone, Copy, Debug)]
struct Tiles {
    height: usize,
    width: usize,
    across: usize,
    per_picture: usize,
}

/// Where a tile lies.
#[derive(Clone, Copy, Debug)]
struct TilePlace {
    image: usize,
    /// Its first row and column.
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
