//! Sums over tiles at each point of Winograd's algorithm. One task computes the sums of one point and a few panels, tile after tile.

use rayon::prelude::*;

use super::{POINTS, slab};
use crate::constant::with_constant;
use crate::convolution::offset;
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::simd::{Job, Pixels, Tile, Vector};

/// Number of tiles of a piece, which is transformed as a whole.
pub(super) const PIECE: usize = 16;

/// Number of channel panels per task, the greatest number that the widest machine sums at once.
const PANELS_AT_ONCE: usize = 4;

/// Transformed tiles, in pieces of [`PIECE`] tiles.
pub(super) struct Pieces<'a> {
    /// Numbers of input and output channels.
    channels: [usize; 2],
    values: &'a [f32],
    /// Length of a piece, in values.
    piece: usize,
    /// Offsets of the tiles of a full piece, and of the last piece if it is shorter.
    whole: Pixels,
    rest: Pixels,
}

impl<'a> Pieces<'a> {
    /// Divides `tiles` tiles into pieces.
    pub(super) fn new(channels: [usize; 2], tiles: usize, values: &'a [f32]) -> Pieces<'a> {
        Pieces {
            channels,
            values,
            piece: Pieces::length(channels),
            whole: pixels(PIECE, channels),
            rest: pixels(tiles % PIECE, channels),
        }
    }

    /// Length of a piece, in values.
    pub(super) fn length(channels: [usize; 2]) -> usize {
        POINTS * (slab(PIECE, channels[0]) + slab(PIECE, channels[1]))
    }

    /// Adds the products of inputs and gradients to `sums`, or overwrites `sums` if `is_first`.
    ///
    /// # Shapes
    /// `sums`: `[point, panel, input, PANEL]`, with one unused panel after the inputs of each panel.
    pub(super) fn add(&self, machine: Machine, is_first: bool, sums: &mut [f32]) {
        let [read, written] = self.channels;
        let slab = slab(read, PANEL);
        let points = sums.chunks_mut(written / PANEL * slab).enumerate();
        let mut tasks: Vec<Sums<'_>> = points
            .flat_map(|(point, sums)| {
                let groups = sums.chunks_mut(PANELS_AT_ONCE * slab).enumerate();
                groups.map(move |(group, sums)| Sums {
                    pieces: self,
                    point,
                    channel: group * PANELS_AT_ONCE * PANEL,
                    is_first,
                    slab,
                    sums,
                })
            })
            .collect();
        tasks.par_iter_mut().for_each(|task| machine.run(task));
    }
}

/// Offsets of the channels of `tiles` tiles at one point.
fn pixels(tiles: usize, [read, written]: [usize; 2]) -> Pixels {
    let places = (0..tiles).map(|tile| (offset(tile * read), offset(tile * written)));
    Pixels::new(places.collect())
}

/// Task that computes the sums of one point and some panels.
struct Sums<'a> {
    pieces: &'a Pieces<'a>,
    point: usize,
    /// Index of the first channel of the first panel.
    channel: usize,
    is_first: bool,
    /// Stride between panels, in values.
    slab: usize,
    sums: &'a mut [f32],
}

impl Job for &mut Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) {
        let panels = self.sums.len() / self.slab;
        let mut panel = 0;
        while panel < panels {
            let width = (panels - panel).min(V::PANELS);
            with_constant!(
                VECTORS = width * PANEL / V::LANES, one of [1, 2, 3, 4] =>
                self.panels::<V, VECTORS>(proof, panel)
            );
            panel += width;
        }
    }
}

impl Sums<'_> {
    #[inline(always)]
    fn panels<V: Vector, const VECTORS: usize>(&mut self, proof: V::Proof, panel: usize) {
        let rows = self.pieces.channels[0];
        let mut first = 0;
        while first < rows {
            let count = (rows - first).min(V::ROWS);
            with_constant!(
                ROWS = count, one of [1, 2, 3, 4, 5, 6] =>
                self.tile::<V, ROWS, VECTORS>(proof, panel, first)
            );
            first += count;
        }
    }

    #[inline(always)]
    fn tile<V: Vector, const ROWS: usize, const VECTORS: usize>(
        &mut self,
        proof: V::Proof,
        panel: usize,
        first: usize,
    ) {
        let [read, written] = self.pieces.channels.map(|channels| slab(PIECE, channels));
        let sums = &mut self.sums[panel * self.slab..];
        let starts = std::array::from_fn(|row| (first + row) * PANEL);
        let mut tile: Tile<V, ROWS, VECTORS> = if self.is_first {
            Tile::zero(proof)
        } else {
            Tile::load(proof, sums, starts, self.slab)
        };
        let input = self.point * read + first;
        let output = POINTS * read + self.point * written + self.channel + panel * PANEL;
        let mut pieces = self
            .pieces
            .values
            .chunks_exact(self.pieces.piece)
            .peekable();
        while let Some(piece) = pieces.next() {
            let is_short = pieces.peek().is_none() && self.pieces.rest.len() > 0;
            let pixels = match is_short {
                true => &self.pieces.rest,
                false => &self.pieces.whole,
            };
            tile.add_pixels(pixels, &piece[input..], &piece[output..]);
        }
        tile.store(sums, starts, self.slab);
    }
}
