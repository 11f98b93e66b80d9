//! The gradient of the weights, in the form that goes with its shape.

use super::form::ConvolutionForm;
use super::winograd;
use super::workspace::Rooms;
use super::{Convolution, direct};
use crate::machine::Machine;
use crate::planes::{Layout, Planes};

/// The pass that gives the gradient of the weights, ready to be run.
#[derive(Clone, Debug)]
pub(crate) enum WeightGradient {
    Direct(direct::WeightGradient),
    Winograd(winograd::WeightGradient),
}

impl WeightGradient {
    /// The pass from pictures of layout `input` and gradients of layout `output`.
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

    /// Numbers that the gradient of transformed weights takes; none where there are no such weights.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            WeightGradient::Direct(_) => 0,
            WeightGradient::Winograd(pass) => pass.transformed_len(),
        }
    }

    /// Runs it on the first `count` pictures.
    ///
    /// # Shapes
    /// `into`: that of the weights.
    pub(crate) fn run(
        &self,
        machine: Machine,
        (input, gradient): (&Planes, &Planes),
        count: usize,
        into: &mut [f32],
        rooms: Rooms<'_>,
    ) {
        match self {
            WeightGradient::Direct(pass) => pass.run(machine, input, gradient, count, into),
            WeightGradient::Winograd(pass) => {
                pass.run(machine, (input, gradient), count, into, rooms);
            }
        }
    }
}
