//! The gradient of the input: the forward pass from the gradient of the output, with inputs and outputs of the weights exchanged and
//! kernels turned.

use super::products::Products;
use super::weights::to_points;
use crate::convolution::ending::{Finish, Onto};
use crate::convolution::workspace::Rooms;
use crate::machine::Machine;
use crate::planes::{Layout, Planes};

/// The pass that gives the gradient of the input, ready to be run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InputGradient {
    products: Products,
}

impl InputGradient {
    /// The pass from gradients of the output, of layout `output`, to those of the input, of layout `input`.
    pub(crate) fn new(output: Layout, input: Layout) -> InputGradient {
        InputGradient {
            products: Products::new(output, input),
        }
    }

    /// Numbers of transformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        self.products.transformed_len()
    }

    /// Runs it on the first `count` pictures with exchanged weights.
    pub(crate) fn run(
        &self,
        machine: Machine,
        exchanged: &[f32],
        (gradient, count): (&Planes, usize),
        (into, onto): (&mut Planes, Onto),
        rooms: Rooms<'_>,
    ) {
        let weights = &mut rooms.transformed[..self.transformed_len()];
        let outputs = self.products.input.picture.channels;
        to_points(machine, exchanged, outputs, true, weights);
        let read = (gradient.first(count), &*weights);
        let written = (into.first_mut(count), |_| (onto.start(), Finish::Keep));
        // Nobody looks at the gradients on the way.
        let each = (&mut vec![(); count][..], |(): &mut (), _: &[f32]| {});
        self.products.run(machine, read, written, each, rooms.tiles);
    }
}
