//! Tiles times transformed weights: the forward pass, and with exchanged weights the gradient of the input.

use std::ops::Range;

use rayon::prelude::*;

use super::tiles::Stretch;
use super::{POINTS, Tiles, slab, transformed_len};
use crate::constant::with_constant;
use crate::convolution::ending::{Finish, Start};
use crate::convolution::workspace::TileRooms;
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::Layout;
use crate::simd::{Job, Tile, Vector};

/// Tiles that a thread takes at once.
const TILES_AT_ONCE: usize = 32;

/// The same where there are more weights than a cache holds, which are read once for all tiles that are taken at once.
const TILES_AT_ONCE_OF_MANY_WEIGHTS: usize = 48;

/// Channels that are summed by themselves before they are added to the sum of the others, so that errors hardly grow with channels: hundreds
/// in one row lose more digits than the transforms do. A sum of sums is most exact where either has as many terms, so that these are the root
/// of the channels, or the next larger power of two: 8 of 64, 16 of 128 and 256, 32 of 512.
///
/// Against double precision that is the most exact of 4, 8, 16, 32 and all, or within a few hundredths of it, in each layer of a ResNet
/// (`tests/blocks.rs` prints and holds it). One count for all layers is further from it: 8 by a fifth at 512 channels, 16 by a twentieth at
/// 64. Errors alone did not find it: with 16 everywhere, `two_hundred_steps_go_as_pytorch_s` parts from PyTorch at step 11, as if a gate of a
/// ReLU near zero opened otherwise (which one was not looked for). 8 everywhere, one of four settings that were tried, and then this fifth pass it.
pub(super) const fn channels_at_once(channels: usize) -> usize {
    1 << channels.next_power_of_two().ilog2().div_ceil(2)
}

/// Bytes of transformed weights that a cache holds.
const WEIGHTS_IN_CACHE: usize = 4 << 20;

/// How many tiles are taken at once that meet `weights`.
pub(super) fn tiles_at_once(weights: &[f32]) -> usize {
    let are_many = size_of_val(weights) > WEIGHTS_IN_CACHE;
    if are_many {
        TILES_AT_ONCE_OF_MANY_WEIGHTS
    } else {
        TILES_AT_ONCE
    }
}

/// Tiles of each stretch of `total`, of at most about `most`: of nearly the same length, which tiles of sums divide.
pub(super) fn stretch(total: usize, most: usize) -> usize {
    total.div_ceil(total.div_ceil(most)).next_multiple_of(6)
}

/// Pictures of one layout and the layout of what comes of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Products {
    pub(super) input: Layout,
    pub(super) output: Layout,
    /// Channels of the input that are summed by themselves.
    pub(super) channels_at_once: usize,
}

impl Products {
    /// The products from pictures of layout `input` to those of layout `output`.
    pub(super) fn new(input: Layout, output: Layout) -> Products {
        Products {
            input,
            output,
            channels_at_once: channels_at_once(input.picture.channels),
        }
    }

    /// Numbers of transformed weights.
    pub(super) fn transformed_len(&self) -> usize {
        transformed_len(self.input.picture.channels, self.output.picture.channels)
    }

    /// Writes the outputs of pictures; `ending` says what stands around the sums of some numbers of them, and `each` of a picture sees its
    /// output while that is still in a cache.
    ///
    /// # Shapes
    /// `weights`: as [`to_points`](super::weights::to_points) writes them.
    pub(super) fn run<'a, E: Send>(
        &self,
        machine: Machine,
        (pictures, weights): (&[f32], &[f32]),
        (output, ending): (
            &mut [f32],
            impl Fn(Range<usize>) -> (Start<'a>, Finish<'a>) + Sync,
        ),
        (each, see): (&mut [E], impl Fn(&mut E, &[f32]) + Sync),
        rooms: &TileRooms,
    ) {
        let tiles = Tiles::of(self.output.picture);
        let channels = [self.input, self.output].map(|layout| layout.picture.channels);
        let (input_image, output_image) = (self.input.len(), self.output.len());
        let most = tiles_at_once(weights);
        let count = output.len() / output_image;
        let share = count.div_ceil(rayon::current_num_threads()).max(1);
        let images = (most / tiles.per_picture).clamp(1, share);
        let at_once = stretch(images * tiles.per_picture, most);
        let slabs = channels.map(|channels| slab(at_once, channels));

        let inputs = pictures.par_chunks(images * input_image);
        let outputs = output.par_chunks_mut(images * output_image);
        let groups = outputs.zip(inputs).zip(each.par_chunks_mut(images));
        groups
            .enumerate()
            .for_each(|(index, ((output, pictures), each))| {
                let first = index * images * output_image;
                let ending = ending(first..first + output.len());
                rooms.with(POINTS * (slabs[0] + slabs[1]), |room| {
                    let (at_points, sums) = room.split_at_mut(POINTS * slabs[0]);
                    machine.run(Group {
                        tiles,
                        range: 0..output.len() / output_image * tiles.per_picture,
                        at_once,
                        channels,
                        channels_at_once: self.channels_at_once,
                        pictures: (pictures, self.input),
                        weights,
                        output: (&mut *output, self.output, 0),
                        ending,
                        room: [at_points, sums],
                    });
                });
                for (each, output) in each.iter_mut().zip(output.chunks_exact(output_image)) {
                    see(each, output);
                }
            });
    }
}

/// Some pictures.
pub(super) struct Group<'a> {
    pub(super) tiles: Tiles,
    /// Tiles that are written, counted over all the pictures.
    pub(super) range: Range<usize>,
    pub(super) at_once: usize,
    /// Read and written.
    pub(super) channels: [usize; 2],
    pub(super) channels_at_once: usize,
    pub(super) pictures: (&'a [f32], Layout),
    pub(super) weights: &'a [f32],
    /// The pictures that are written, and how many numbers of them are left out before the first.
    pub(super) output: (&'a mut [f32], Layout, usize),
    pub(super) ending: (Start<'a>, Finish<'a>),
    /// `[point, tile, channel]`: inputs and sums.
    pub(super) room: [&'a mut [f32]; 2],
}

impl Job for Group<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(mut self, proof: V::Proof) {
        let [read, written] = self.channels;
        let Range { start, end } = self.range;
        let mut first = start;
        while first < end {
            let range = first..(first + self.at_once).min(end);
            let stretch_of = |channels| Stretch {
                tiles: self.tiles,
                range: range.clone(),
                slab: slab(self.at_once, channels),
            };
            let (inputs, outputs) = (stretch_of(read), stretch_of(written));
            inputs.read_inputs::<V>(proof, self.pictures, self.room[0]);
            for point in 0..POINTS {
                self.point::<V>(proof, point, range.len());
            }
            let output = (&mut *self.output.0, self.output.1, self.output.2);
            outputs.write_outputs::<V>(proof, self.room[1], output, self.ending);
            first = range.end;
        }
    }
}

impl Group<'_> {
    /// Sums the products at one point, of so many tiles.
    #[inline(always)]
    fn point<V: Vector>(&mut self, proof: V::Proof, point: usize, tiles: usize) {
        let panels = self.channels[1] / PANEL;
        let mut panel = 0;
        while panel < panels {
            let width = (panels - panel).min(V::PANELS);
            with_constant!(
                VECTORS = width * PANEL / V::LANES, one of [1, 2, 3, 4] =>
                self.panels::<V, VECTORS>(proof, (point, panel), tiles)
            );
            panel += width;
        }
    }

    #[inline(always)]
    fn panels<V: Vector, const VECTORS: usize>(
        &mut self,
        proof: V::Proof,
        place: (usize, usize),
        tiles: usize,
    ) {
        let mut first = 0;
        while first < tiles {
            let count = (tiles - first).min(V::ROWS);
            with_constant!(
                ROWS = count, one of [1, 2, 3, 4, 5, 6] =>
                self.tile::<V, ROWS, VECTORS>(proof, place, first)
            );
            first += count;
        }
    }

    #[inline(always)]
    fn tile<V: Vector, const ROWS: usize, const VECTORS: usize>(
        &mut self,
        proof: V::Proof,
        (point, panel): (usize, usize),
        first: usize,
    ) {
        let [read, written] = self.channels;
        let slabs = self.channels.map(|channels| slab(self.at_once, channels));
        let weights = slab(read, PANEL);
        let runs = &self.room[0][point * slabs[0]..];
        let weights_of_point = &self.weights[(panel * POINTS + point) * weights..];
        let mut tile: Tile<V, ROWS, VECTORS> = Tile::zero(proof);
        for start in (0..read).step_by(self.channels_at_once) {
            let mut part: Tile<V, ROWS, VECTORS> = Tile::zero(proof);
            part.add_runs(
                runs,
                std::array::from_fn(|row| (first + row) * read + start),
                &weights_of_point[start * PANEL..],
                POINTS * weights,
                self.channels_at_once.min(read - start),
            );
            tile = tile.plus(part);
        }
        tile.store(
            &mut self.room[1][point * slabs[1] + panel * PANEL..],
            std::array::from_fn(|row| (first + row) * written),
            PANEL,
        );
    }
}
