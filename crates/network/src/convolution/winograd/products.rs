//! Products of tiles and transformed weights, which compute the forward pass. If inputs and outputs of the weights are exchanged, they compute the
//! input gradient.

use std::ops::Range;

use rayon::prelude::*;

use super::tiles::{OutputBuffer, PictureValues, Stretch};
use super::{POINTS, Tiles, slab, transformed_len};
use crate::constant::with_constant;
use crate::convolution::ending::SumRule;
use crate::convolution::workspace::TileRooms;
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::Layout;
use crate::simd::{Job, Tile, Vector};

/// Number of tiles per step of a thread.
const TILES_AT_ONCE: usize = 32;

/// Number of tiles per step if the weights exceed the cache. Each step reads the weights once.
const TILES_AT_ONCE_OF_MANY_WEIGHTS: usize = 48;

/// Number of channels per partial sum. Without partial sums, rounding errors would grow with the number of channels, and exceed the errors of the
/// transforms. Errors are smallest if inner and outer sums have equally many terms. The count is therefore the square root of the number of channels,
/// or the next larger power of two: 8 for 64 channels, 16 for 128 and 256, 32 for 512.
///
/// In each layer of a ResNet, this count has the smallest error of 4, 8, 16, 32 and all channels, to within a few percent. `tests/blocks.rs` prints
/// and checks the errors against double precision. A single count for all layers has larger errors: 8 by a fifth at 512 channels, 16 by a twentieth
/// at 64. Errors were not the only criterion. With 16 everywhere, `two_hundred_steps_go_as_pytorch_s` diverges from PyTorch at step 11, perhaps at a
/// ReLU whose input is near zero. Of five tested settings, only 8 everywhere and this count pass the test.
pub(super) const fn channels_at_once(channels: usize) -> usize {
    1 << channels.next_power_of_two().ilog2().div_ceil(2)
}

/// Size of transformed weights that fit into the cache, in bytes.
const WEIGHTS_IN_CACHE: usize = 4 << 20;

/// Number of tiles per step for `weights`.
pub(super) fn tiles_at_once(weights: &[f32]) -> usize {
    let are_many = size_of_val(weights) > WEIGHTS_IN_CACHE;
    if are_many {
        TILES_AT_ONCE_OF_MANY_WEIGHTS
    } else {
        TILES_AT_ONCE
    }
}

/// Number of tiles per range, if `total` tiles are divided into nearly equal ranges of at most about `most` tiles. Rounded up to a multiple of 6, the
/// number of rows in a tile of sums.
pub(super) fn stretch(total: usize, most: usize) -> usize {
    total.div_ceil(total.div_ceil(most)).next_multiple_of(6)
}

/// Values that a run of the pass reads and writes.
pub(super) struct RunValues<'a> {
    pub(super) pictures: &'a [f32],
    /// Weights that [`to_points`](super::weights::to_points) has written.
    pub(super) weights: &'a [f32],
    pub(super) output: &'a mut [f32],
}

/// Products for one pair of memory layouts of input and output pictures.
#[derive(Clone, Copy, Debug)]
pub(super) struct Products {
    pub(super) input: Layout,
    pub(super) output: Layout,
    /// Number of input channels per partial sum.
    pub(super) channels_at_once: usize,
}

impl Products {
    /// Prepares the products for pictures of layout `input` and outputs of layout `output`.
    pub(super) fn new(input: Layout, output: Layout) -> Products {
        Products {
            input,
            output,
            channels_at_once: channels_at_once(input.picture.channels),
        }
    }

    /// Length of the transformed weights.
    pub(super) fn transformed_len(&self) -> usize {
        transformed_len(self.input.picture.channels, self.output.picture.channels)
    }

    /// Computes and writes the outputs of pictures. `ending` returns the start values of the sums and the operation on finished sums, for a range of
    /// values. `see` is called for each picture while its output is in cache. `see` receives the item of `each` for this picture, and the output.
    pub(super) fn run<'a, E: Send>(
        &self,
        machine: Machine,
        values: RunValues<'_>,
        ending: impl Fn(Range<usize>) -> SumRule<'a> + Sync,
        each: &mut [E],
        see: impl Fn(&mut E, &[f32]) + Sync,
        rooms: &TileRooms,
    ) {
        let RunValues {
            pictures,
            weights,
            output,
        } = values;
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
                let rule = ending(first..first + output.len());
                rooms.with(POINTS * (slabs[0] + slabs[1]), |room| {
                    let (at_points, sums) = room.split_at_mut(POINTS * slabs[0]);
                    machine.run(Group {
                        tiles,
                        range: 0..output.len() / output_image * tiles.per_picture,
                        at_once,
                        channels,
                        channels_at_once: self.channels_at_once,
                        pictures: PictureValues {
                            values: pictures,
                            layout: self.input,
                        },
                        weights,
                        output: OutputBuffer {
                            values: &mut *output,
                            layout: self.output,
                            skipped: 0,
                        },
                        rule,
                        room: [at_points, sums],
                    });
                });
                for (each, output) in each.iter_mut().zip(output.chunks_exact(output_image)) {
                    see(each, output);
                }
            });
    }
}

/// Work of one thread on some pictures.
pub(super) struct Group<'a> {
    pub(super) tiles: Tiles,
    /// Tiles to compute, counted over all the pictures.
    pub(super) range: Range<usize>,
    pub(super) at_once: usize,
    /// Numbers of input and output channels.
    pub(super) channels: [usize; 2],
    pub(super) channels_at_once: usize,
    pub(super) pictures: PictureValues<'a>,
    pub(super) weights: &'a [f32],
    pub(super) output: OutputBuffer<'a>,
    pub(super) rule: SumRule<'a>,
    /// Buffers of inputs and of sums, each of shape `[point, tile, channel]`.
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
            outputs.write_outputs::<V>(proof, self.room[1], &mut self.output, self.rule);
            first = range.end;
        }
    }
}

impl Group<'_> {
    /// Sums the products of `tiles` tiles at one point.
    #[inline(always)]
    fn point<V: Vector>(&mut self, proof: V::Proof, point: usize, tiles: usize) {
        let panels = self.channels[1] / PANEL;
        let mut panel = 0;
        while panel < panels {
            let width = (panels - panel).min(V::PANELS);
            with_constant!(
                VECTORS = width * PANEL / V::LANES, one of [1, 2, 3, 4] =>
                self.panels::<V, VECTORS>(proof, point, panel, tiles)
            );
            panel += width;
        }
    }

    #[inline(always)]
    fn panels<V: Vector, const VECTORS: usize>(
        &mut self,
        proof: V::Proof,
        point: usize,
        panel: usize,
        tiles: usize,
    ) {
        let mut first = 0;
        while first < tiles {
            let count = (tiles - first).min(V::ROWS);
            with_constant!(
                ROWS = count, one of [1, 2, 3, 4, 5, 6] =>
                self.tile::<V, ROWS, VECTORS>(proof, point, panel, first)
            );
            first += count;
        }
    }

    #[inline(always)]
    fn tile<V: Vector, const ROWS: usize, const VECTORS: usize>(
        &mut self,
        proof: V::Proof,
        point: usize,
        panel: usize,
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
