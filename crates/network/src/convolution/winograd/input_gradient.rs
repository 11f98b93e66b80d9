//! Input gradient: the forward pass applied to the output gradient. Inputs and outputs of the weights are exchanged, and kernels are rotated by 180°.

use super::products::{Products, RunValues};
use super::weights::to_points;
use crate::convolution::target::GradientTarget;
use crate::convolution::workspace::Rooms;
use crate::machine::Machine;
use crate::planes::{Layout, Pictures};

/// Input-gradient pass, prepared for pictures of one memory layout.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InputGradient {
    products: Products,
}

impl InputGradient {
    /// Prepares the pass from output gradients of layout `output` to input gradients of layout `input`.
    pub(crate) fn new(output: Layout, input: Layout) -> InputGradient {
        InputGradient {
            products: Products::new(output, input),
        }
    }

    /// Length of the transformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        self.products.transformed_len()
    }

    /// Runs the pass on the first `count` pictures. Inputs and outputs of the weights are exchanged.
    pub(crate) fn run(
        &self,
        machine: Machine,
        exchanged: &[f32],
        gradient: Pictures<'_>,
        into: GradientTarget<'_>,
        rooms: Rooms<'_>,
    ) {
        let weights = &mut rooms.transformed[..self.transformed_len()];
        let outputs = self.products.input.picture.channels;
        to_points(machine, exchanged, outputs, true, weights);
        let count = gradient.count;
        let values = RunValues {
            pictures: gradient.planes.first(count),
            weights,
            output: into.gradient.first_mut(count),
        };
        let rule = into.onto.rule();
        // No callback reads the gradients.
        let each = &mut vec![(); count][..];
        let see = |(): &mut (), _: &[f32]| {};
        self.products
            .run(machine, values, |_| rule, each, see, rooms.tiles);
    }
}
