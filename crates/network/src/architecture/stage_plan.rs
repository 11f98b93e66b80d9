//! Plan of the stages of a network, without weights.

use super::PlainLayer;
use crate::convolution::Convolution;
use crate::max_pool;
use crate::picture::Picture;
use crate::planes::Layout;

/// Layers that are computed together, as one stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StagePlan {
    /// A convolution of 7 × 7 with stride 2, then max pooling over 3 × 3 with stride 2.
    Stem {
        /// Number of output channels.
        channels: usize,
    },
    /// A single convolution.
    Plain(PlainLayer),
    /// Two convolutions of 3 × 3 and a shortcut. The shortcut is the input itself, or a convolution of 1 × 1 if the picture shape changes.
    Block {
        /// Number of output channels.
        channels: usize,
        /// Stride of the first convolution, in pixels.
        stride: usize,
    },
}

impl StagePlan {
    /// First convolution of the stage, for pictures with `inputs` channels.
    pub(crate) const fn first(&self, inputs: usize) -> Convolution {
        match *self {
            StagePlan::Stem { channels } => Convolution {
                inputs,
                outputs: channels,
                kernel: 7,
                stride: 2,
            },
            StagePlan::Plain(PlainLayer {
                channels,
                kernel,
                stride,
            }) => Convolution {
                inputs,
                outputs: channels,
                kernel,
                stride,
            },
            StagePlan::Block { channels, stride } => Convolution {
                inputs,
                outputs: channels,
                kernel: 3,
                stride,
            },
        }
    }

    /// Number of trainable parameters of the stage, for pictures with `inputs` channels.
    pub(super) fn parameters(&self, inputs: usize) -> u128 {
        let first = self.first(inputs);
        let normed = |inputs: usize, taps: usize| {
            (inputs as u128 * taps as u128 + 2) * first.outputs as u128
        };
        let past = match *self {
            StagePlan::Stem { .. } | StagePlan::Plain(_) => 0,
            StagePlan::Block { channels, stride } => {
                let changes = stride != 1 || inputs != channels;
                normed(channels, 9) + if changes { normed(inputs, 1) } else { 0 }
            }
        };
        normed(inputs, first.taps()) + past
    }

    /// Shape of the stage's output for an input of shape `input`.
    pub(crate) const fn output(&self, input: Picture) -> Picture {
        let convolved = self.first(input.channels).output(input);
        match self {
            StagePlan::Stem { .. } => max_pool::output(convolved),
            StagePlan::Plain(_) | StagePlan::Block { .. } => convolved,
        }
    }

    /// Memory layout of the input pictures, including the border that the first convolution reads.
    pub(crate) fn input_layout(&self, picture: Picture) -> Layout {
        let padding = self.first(picture.channels).padding();
        Layout {
            picture,
            border: padding.max(1),
        }
    }
}
