//! Input gradient of a convolution, directly or by Winograd's algorithm.

use super::form::ConvolutionForm;
use super::target::GradientTarget;
use super::weights::ConvolutionWeights;
use super::winograd;
use super::workspace::Rooms;
use super::{Convolution, direct};
use crate::machine::Machine;
use crate::planes::{Layout, Pictures};

/// Input-gradient pass, prepared for pictures of one memory layout.
#[derive(Clone, Debug)]
pub(crate) enum InputGradient {
    Direct(direct::InputGradient),
    Winograd(winograd::InputGradient),
}

impl InputGradient {
    /// Prepares the pass from output gradients of layout `output` to input gradients of layout `input`.
    ///
    /// The border of `output` must be at least as wide as the padding.
    pub(crate) fn new(
        convolution: Convolution,
        output: Layout,
        input: Layout,
        form: ConvolutionForm,
    ) -> InputGradient {
        // The picture keeps its size where the stride is 1.
        match form.is_winograd(convolution, output.picture) {
            true => InputGradient::Winograd(winograd::InputGradient::new(output, input)),
            false => InputGradient::Direct(direct::InputGradient::new(convolution, output, input)),
        }
    }

    /// Length of the transformed weights; 0 if the pass reads untransformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            InputGradient::Direct(_) => 0,
            InputGradient::Winograd(pass) => pass.transformed_len(),
        }
    }

    /// Runs the pass on the first `count` pictures. `exchanged` is a buffer for the weights with inputs and outputs exchanged.
    pub(crate) fn run(
        &self,
        machine: Machine,
        weights: &ConvolutionWeights,
        exchanged: &mut [f32],
        gradient: Pictures<'_>,
        into: GradientTarget<'_>,
        rooms: Rooms<'_>,
    ) {
        weights.exchange(machine, exchanged);
        match self {
            InputGradient::Direct(pass) => pass.run(machine, exchanged, gradient, into),
            InputGradient::Winograd(pass) => pass.run(machine, exchanged, gradient, into, rooms),
        }
    }
}
