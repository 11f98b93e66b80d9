//! Forward pass of Winograd's algorithm.

use std::ops::Range;

use rayon::prelude::*;

use super::products::{Products, RunValues};
use super::single_picture::Divided;
use super::weights::to_points;
use crate::convolution::division::{Division, Outputs};
use crate::convolution::source::Source;
use crate::convolution::target::Target;
use crate::convolution::workspace::TileRooms;
use crate::machine::Machine;
use crate::planes::Layout;
use crate::team;

/// Forward pass, prepared for pictures of one memory layout.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Forward {
    products: Products,
}

impl Forward {
    /// Prepares the pass from pictures of layout `input` to pictures of layout `output`.
    pub(crate) fn new(input: Layout, output: Layout) -> Forward {
        Forward {
            products: Products::new(input, output),
        }
    }

    /// Size of the work for one picture, for its division among threads.
    pub(in crate::convolution) fn outputs(&self) -> Outputs {
        self.products.outputs()
    }

    /// Length of the transformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        self.products.transformed_len()
    }

    /// Transforms the weights into the start of `room`, and returns the transformed weights.
    pub(crate) fn transform<'a>(
        &self,
        machine: Machine,
        weights: &[f32],
        room: &'a mut [f32],
    ) -> &'a [f32] {
        let room = &mut room[..self.transformed_len()];
        let inputs = self.products.input.picture.channels;
        to_points(machine, weights, inputs, false, room);
        room
    }

    /// Runs the pass with transformed weights, and writes to the first pictures of `output`. `see` is called for each picture while its output is in cache.
    /// `see` receives the item of `each` for this picture, and the output.
    pub(crate) fn run<E: Send>(
        &self,
        machine: Machine,
        source: Source<'_>,
        target: Target<'_>,
        each: &mut [E],
        see: impl Fn(&mut E, &[f32]) + Sync,
        rooms: &TileRooms,
    ) {
        let Target {
            pictures: output,
            epilogue,
        } = target;
        let count = source.count;
        let division = self.outputs().divided(team::parts(count));
        if division != Division::Whole {
            let lengths = [self.products.input, self.products.output].map(|layout| layout.len());
            let images = output.first_mut(count).par_chunks_mut(lengths[1]);
            let images = images.zip(source.pictures().par_chunks(lengths[0]));
            let images = images.zip(&mut each[..count]).enumerate();
            images.for_each(|(index, ((output, input), item))| {
                let divided = Divided {
                    products: self.products,
                    input,
                    weights: source.weights,
                };
                let first = index * lengths[1];
                let ending =
                    |part: Range<usize>| epilogue.within(first + part.start..first + part.end);
                divided.run(machine, division, &mut *output, ending, rooms);
                see(item, output);
            });
            return;
        }
        let values = RunValues {
            pictures: source.pictures(),
            weights: source.weights,
            output: output.first_mut(count),
        };
        let ending = |range: Range<usize>| epilogue.within(range);
        self.products.run(machine, values, ending, each, see, rooms);
    }
}
