//! Convolution: its shape, its weights, and its three passes (forward, input gradient, weight gradient).

mod direct;
mod division;
mod ending;
mod form;
mod forward;
mod gathering;
mod input_gradient;
mod source;
mod target;
mod weight_gradient;
mod weights;
mod winograd;
mod workspace;

pub(crate) use ending::{Epilogue, Onto};
pub use form::ConvolutionForm;
pub(crate) use forward::Forward;
pub(crate) use input_gradient::InputGradient;
pub(crate) use source::Source;
pub(crate) use target::{GradientTarget, Target};
pub(crate) use weight_gradient::WeightGradient;
pub(crate) use weights::{ConvolutionWeights, plain};
pub(crate) use workspace::{Rooms, TileRooms};

use crate::picture::Picture;
use crate::planes::Layout;

/// Shape of a convolution without bias. The padding is half the side of the square kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Convolution {
    /// Number of input channels.
    pub(crate) inputs: usize,
    /// Number of output channels, a multiple of `PANEL`.
    pub(crate) outputs: usize,
    /// Side of the kernel, in pixels; an odd number.
    pub(crate) kernel: usize,
    /// Stride, in pixels.
    pub(crate) stride: usize,
}

impl Convolution {
    /// Number of rows and columns of zeros on each side of the input.
    pub(crate) const fn padding(&self) -> usize {
        self.kernel / 2
    }

    /// Number of kernel positions.
    pub(crate) const fn taps(&self) -> usize {
        self.kernel * self.kernel
    }

    /// Shape of the output for an input of shape `input`.
    pub(crate) const fn output(&self, input: Picture) -> Picture {
        // The padding is half an odd kernel, so h + 2p − k = h − 1.
        Picture {
            height: (input.height - 1) / self.stride + 1,
            width: (input.width - 1) / self.stride + 1,
            channels: self.outputs,
        }
    }

    /// Offset of the first value that the kernel reads for output pixel (y, x), in an input of `layout`.
    fn corner(&self, layout: Layout, y: usize, x: usize) -> usize {
        let shift = layout.border - self.padding();
        (y * self.stride + shift) * layout.row()
            + (x * self.stride + shift) * layout.picture.channels
    }
}

/// Converts an offset to 32 bits, for tables of pixels.
fn offset(value: usize) -> u32 {
    u32::try_from(value).expect("Architecture::check limits a picture to 2^28 values")
}

#[cfg(test)]
mod tests;
