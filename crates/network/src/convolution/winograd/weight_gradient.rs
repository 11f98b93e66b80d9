//! Weight gradient: products of transformed inputs and transformed output gradients, summed over tiles at each point.
//!
//! Tiles are transformed piece by piece. One thread computes each sum, for one point and a few panels, tile after tile. No reduction is needed, and the order
//! is the same for any number of threads.

use std::ops::Range;

use rayon::prelude::*;

use super::sums::{PIECE, Pieces};
use super::tiles::{PictureValues, Stretch};
use super::weights;
use super::{POINTS, Tiles, slab, transformed_len};
use crate::convolution::workspace::Rooms;
use crate::machine::Machine;
use crate::planes::{Layout, Planes};
use crate::simd::{Job, Vector};

/// Minimum number of pieces in memory at once.
const PIECES_AT_ONCE: usize = 4;

/// Size of pieces in memory at once, in bytes, if this allows more than [`PIECES_AT_ONCE`] pieces.
const BYTES_AT_ONCE: usize = 2 << 20;

/// Weight-gradient pass, prepared for pictures of one memory layout.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WeightGradient {
    input: Layout,
    output: Layout,
}

impl WeightGradient {
    /// Prepares the pass for inputs of layout `input` and output gradients of layout `output`.
    pub(crate) fn new(input: Layout, output: Layout) -> WeightGradient {
        WeightGradient { input, output }
    }

    /// Length of the gradient of transformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        transformed_len(self.input.picture.channels, self.output.picture.channels)
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
        let channels = [self.input, self.output].map(|layout| layout.picture.channels);
        let tiles = Tiles::of(self.output.picture);
        let total = tiles.per_picture * count;
        let piece = Pieces::length(channels);
        let pieces = (BYTES_AT_ONCE / (piece * size_of::<f32>()))
            .max(PIECES_AT_ONCE)
            .max(rayon::current_num_threads())
            .min(total.div_ceil(PIECE));
        let sums = &mut rooms.transformed[..self.transformed_len()];
        rooms.tiles.with(pieces * piece, |room| {
            for first in (0..total).step_by(pieces * PIECE) {
                let range = first..(first + pieces * PIECE).min(total);
                let room = &mut room[..range.len().div_ceil(PIECE) * piece];
                let parts = room.par_chunks_mut(piece).enumerate();
                parts.for_each(|(index, room)| {
                    let first = range.start + index * PIECE;
                    machine.run(Piece {
                        tiles,
                        range: first..(first + PIECE).min(range.end),
                        pictures: PictureValues {
                            values: input.first(count),
                            layout: self.input,
                        },
                        gradients: PictureValues {
                            values: gradient.first(count),
                            layout: self.output,
                        },
                        room,
                    });
                });
                let pieces = Pieces::new(channels, range.len(), room);
                pieces.add(machine, first == 0, sums);
            }
        });
        weights::from_points(machine, sums, channels[0], into);
    }
}

/// One piece: tiles of inputs and of output gradients to transform.
struct Piece<'a> {
    tiles: Tiles,
    range: Range<usize>,
    pictures: PictureValues<'a>,
    gradients: PictureValues<'a>,
    /// Buffer of inputs, then of output gradients, both of shape `[point, tile, channel]`.
    room: &'a mut [f32],
}

impl Job for Piece<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) {
        let stretch = |layout: Layout| Stretch {
            tiles: self.tiles,
            range: self.range.clone(),
            slab: slab(PIECE, layout.picture.channels),
        };
        let (inputs, outputs) = (
            stretch(self.pictures.layout),
            stretch(self.gradients.layout),
        );
        let (at_points, gradients) = self.room.split_at_mut(POINTS * inputs.slab);
        inputs.read_inputs::<V>(proof, self.pictures, at_points);
        outputs.read_gradients::<V>(proof, self.gradients, gradients);
    }
}
