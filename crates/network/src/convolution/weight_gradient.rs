//! Weight gradient of a convolution, directly or by Winograd's algorithm.

use super::form::ConvolutionForm;
use super::winograd;
use super::workspace::Rooms;
use super::{Convolution, direct};
use crate::machine::Machine;
use crate::planes::{Layout, Planes};

/// Weight-gradient pass, prepared for pictures of one memory layout.
#[derive(Clone, Debug)]
pub(crate) enum WeightGradient {
    Direct(direct::WeightGradient),
    Winograd(winograd::WeightGradient),
}

impl WeightGradient {
    /// Prepares the pass for inputs of layout `input` and output gradients of layout `output`.
    pub(crate) fn new(
        convolution: Convolution,
        input: Layout,
        output: Layout,
        form: ConvolutionForm,
    ) -> WeightGradient {
        match form.is_winograd(convolution, output.picture) {
            true => WeightGradient::Winograd(winograd::WeightGradient::new(input, output)),
            false => {
                WeightGradient::Direct(direct::WeightGradient::new(convolution, input, output))
            }
        }
    }

    /// Length of the gradient of transformed weights; 0 in the direct algorithm.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            WeightGradient::Direct(_) => 0,
            WeightGradient::Winograd(pass) => pass.transformed_len(),
        }
    }

    /// Runs the pass on the first `count` pictures.
    ///
    /// # Shapes
    /// `into`: same shape as the weights.
    pub(crate) fn run(
        &self,
        machine: Machine,
        input: &Planes,
        gradient: &Planes,
        count: usize,
        into: &mut [f32],
        rooms: Rooms<'_>,
    ) {
        match self {
            WeightGradient::Direct(pass) => pass.run(machine, input, gradient, count, into),
            WeightGradient::Winograd(pass) => {
                pass.run(machine, input, gradient, count, into, rooms);
            }
        }
    }
}
