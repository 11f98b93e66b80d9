//! Convolution: its shape, its weights, and its three passes.

mod direct;
mod division;
mod ending;
mod form;
mod forward;
mod gathering;
mod input_gradient;
mod source;
mod weight_gradient;
mod weights;
mod winograd;
mod workspace;

pub(crate) use ending::{Epilogue, Onto};
pub use form::ConvolutionForm;
pub(crate) use forward::Forward;
pub(crate) use input_gradient::InputGradient;
pub(crate) use source::Source;
pub(crate) use weight_gradient::WeightGradient;
pub(crate) use weights::{ConvolutionWeights, plain};
pub(crate) use workspace::{Rooms, TileRooms};

use crate::picture::Picture;
use crate::planes::Layout;

/// The shape of a convolution without a bias: a square kernel, padded by half of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Convolution {
    /// Channels read.
    pub(crate) inputs: usize,
    /// Channels written: a multiple of a panel.
    pub(crate) outputs: usize,
    /// Rows and columns of the kernel: odd.
    pub(crate) kernel: usize,
    /// Pixels from one place of the kernel to the next.
    pub(crate) stride: usize,
}

impl Convolution {
    /// Rows and columns of zeros around the input.
    pub(crate) const fn padding(&self) -> usize {
        self.kernel / 2
    }

    /// Places of the kernel.
    pub(crate) const fn taps(&self) -> usize {
        self.kernel * self.kernel
    }

    /// The picture that comes of `input`.
    pub(crate) const fn output(&self, input: Picture) -> Picture {
        // The padding is half an odd kernel, so h + 2p − k = h − 1.
        Picture {
            height: (input.height - 1) / self.stride + 1,
            width: (input.width - 1) / self.stride + 1,
            channels: self.outputs,
        }
    }

    /// Where the kernel of output pixel (y, x) begins in an input of `layout`.
    fn corner(&self, layout: Layout, y: usize, x: usize) -> usize {
        let shift = layout.border - self.padding();
        (y * self.stride + shift) * layout.row()
            + (x * self.stride + shift) * layout.picture.channels
    }
}

/// An offset as tables of pixels keep it.
fn offset(value: usize) -> u32 {
    u32::try_from(value)
        .expect("a picture has fewer numbers than 2^32, as the architecture was checked")
}

#[cfg(test)]
mod tests;
