//! The forward pass.

use super::products::Products;
use super::rooms::TileRooms;
use super::weights::to_points;
use crate::convolution::ending::Epilogue;
use crate::convolution::source::Source;
use crate::machine::Machine;
use crate::planes::{Layout, Planes};

/// A forward pass over pictures of one layout, ready to be run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forward {
    products: Products,
}

impl Forward {
    /// The pass from pictures of layout `input` to those of layout `output`.
    pub(crate) fn new(input: Layout, output: Layout) -> Forward {
        Forward {
            products: Products::new(input, output),
        }
    }

    /// Numbers of transformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        self.products.transformed_len()
    }

    /// Transforms weights into the first numbers of `room`, and gives these.
    pub(crate) fn transform<'a>(
        &self,
        machine: Machine,
        weights: &[f32],
        room: &'a mut [f32],
    ) -> &'a [f32] {
        let room = &mut room[..self.transformed_len()];
        let inputs = self.products.input.picture.channels;
        to_points(machine, (weights, inputs), false, room);
        room
    }

    /// Runs it with transformed weights, into the first pictures of `output`; `each` of a picture sees its output while that is still
    /// in a cache.
    pub(crate) fn run<E: Send>(
        &self,
        machine: Machine,
        source: Source<'_>,
        (output, epilogue): (&mut Planes, Epilogue<'_>),
        each: (&mut [E], impl Fn(&mut E, &[f32]) + Sync),
        rooms: &TileRooms,
    ) {
        let read = (source.pictures(), source.weights);
        let written = (output.first_mut(source.count), |range| {
            epilogue.within(range)
        });
        self.products.run(machine, read, written, each, rooms);
    }
}
