//! The gradient of the input, in the form that goes with its shape.

use super::ending::Onto;
use super::form::ConvolutionForm;
use super::weights::ConvolutionWeights;
use super::winograd;
use super::workspace::Rooms;
use super::{Convolution, direct};
use crate::machine::Machine;
use crate::planes::{Layout, Planes};

/// The pass that gives the gradient of the input, ready to be run.
#[derive(Clone, Debug)]
pub(crate) enum InputGradient {
    Direct(direct::InputGradient),
    Winograd(winograd::InputGradient),
}

impl InputGradient {
    /// The pass from gradients of the output, of layout `output`, to those of the input, of layout `input`.
    ///
    /// The border of `output` is at least the padding.
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

    /// Numbers that transformed weights take; none where they are read as they are.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            InputGradient::Direct(_) => 0,
            InputGradient::Winograd(pass) => pass.transformed_len(),
        }
    }

    /// Runs it on the first `count` pictures; `exchanged` is room for as many numbers as there are weights.
    pub(crate) fn run(
        &self,
        machine: Machine,
        (weights, exchanged): (&ConvolutionWeights, &mut [f32]),
        gradient: (&Planes, usize),
        into: (&mut Planes, Onto),
        rooms: Rooms<'_>,
    ) {
        weights.exchange(machine, exchanged);
        match self {
            InputGradient::Direct(pass) => pass.run(machine, exchanged, gradient, into),
            InputGradient::Winograd(pass) => pass.run(machine, exchanged, gradient, into, rooms),
        }
    }
}
