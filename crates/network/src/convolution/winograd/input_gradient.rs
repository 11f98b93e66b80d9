//! Input gradient: the forward pass applied to the output gradient, with inputs and outputs of the weights exchanged and
//! kernels rotated by 180°.

use super::products::Products;
use super::weights::to_points;
use crate::convolution::ending::{Finish, Onto};
use crate::convolution::workspace::Rooms;
use crate::machine::Machine;
use crate::planes::{Layout, Planes};

/// Input-gradient pass, prepared for pictures of one layout.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InputGradient {
    products: Products,
}

impl InputGradient {
    /// Pass from output gradients of layout `output` to input gradients of layout `input`.
    pub(crate) fn new(output: Layout, input: Layout) -> InputGradient {
        InputGradient {
            products: Products::new(output, input),
        }
    }

    /// Length of the transformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        self.products.transformed_len()
    }

    /// Runs the pass on the first `count` pictures with exchanged weights.
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
        // No callback reads the gradients.
        let each = (&mut vec![(); count][..], |(): &mut (), _: &[f32]| {});
        self.products.run(machine, read, written, each, rooms.tiles);
    }
}
