//! Inner loop of the forward pass and of the input gradient: sums of runs of pixels times rows of weights.

use std::ops::Range;

use crate::constant::with_constant;
use crate::convolution::ending::{Finish, Start, SumRule};
use crate::panel::PANEL;
use crate::simd::{Job, Pixels, Tile, Vector};

/// Size of weights that fit into the second-level cache together with their pixels, in bytes.
const WEIGHTS_AT_ONCE: usize = 700 << 10;

/// A run of consecutive input values, and the rows of weights that multiply these values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tap {
    /// Offset of the run from the first value that the kernel reads.
    pub(crate) offset: usize,
    /// Index of the first row of weights.
    pub(crate) row: usize,
}

/// Memory layout of the outputs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum OutputLayout {
    /// Pictures of `image` values each. The buffer begins `skipped` values after the start of the first picture.
    Pictures { image: usize, skipped: usize },
    /// Only the pixels of `range`, contiguous, with `channels` values each.
    Packed { channels: usize },
}

/// Computes output[pixel, channel] = finish(start + Σ input · weights), summed over the runs of all taps. `rule` contains start and finish.
pub(crate) struct Correlation<'a> {
    /// Offsets of each pixel of a picture in input and output.
    pub(crate) pixels: &'a Pixels,
    /// Pixels to compute, counted over all pictures.
    pub(crate) range: Range<usize>,
    /// Input pictures of `input_image` values each.
    pub(crate) input: &'a [f32],
    pub(crate) input_image: usize,
    pub(crate) taps: &'a [Tap],
    /// Number of values in the run of each tap.
    pub(crate) run: usize,
    /// Weights, shape `[panels, rows, PANEL]`.
    pub(crate) weights: &'a [f32],
    pub(crate) rows: usize,
    pub(crate) output: &'a mut [f32],
    pub(crate) layout: OutputLayout,
    pub(crate) rule: SumRule<'a>,
}

/// Part of a correlation that is computed in one pass over the pixels.
#[derive(Clone, Copy)]
struct Round<'a> {
    taps: &'a [Tap],
    panel: usize,
    is_first: bool,
    is_last: bool,
}

/// True if the weights of one tile of sums, with `rows` rows for each panel, exceed their share of the cache.
///
/// Assumes tiles of at most four panels on every machine, so that the division of work depends only on shapes.
pub(crate) fn are_weights_many(rows: usize, panels: usize) -> bool {
    rows * panels.min(4) * PANEL * size_of::<f32>() > WEIGHTS_AT_ONCE
}

impl Job for Correlation<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(mut self, proof: V::Proof) {
        let panels = self.weights.len() / (self.rows * PANEL);
        let pieces = if are_weights_many(self.rows, panels) {
            3
        } else {
            1
        };
        let piece = self.taps.len().div_ceil(pieces).max(1);
        let taps = self.taps;
        let mut panel = 0;
        while panel < panels {
            let width = (panels - panel).min(V::PANELS);
            // At least one round, even without taps: it writes the start of the sums.
            for index in 0..taps.len().div_ceil(piece).max(1) {
                let end = ((index + 1) * piece).min(taps.len());
                let round = Round {
                    taps: &taps[index * piece..end],
                    panel,
                    is_first: index == 0,
                    is_last: end == taps.len(),
                };
                with_constant!(
                    VECTORS = width * PANEL / V::LANES, one of [1, 2, 3, 4] =>
                    self.round::<V, VECTORS>(proof, round)
                );
            }
            panel += width;
        }
    }
}

impl Correlation<'_> {
    #[inline(always)]
    fn round<V: Vector, const VECTORS: usize>(&mut self, proof: V::Proof, round: Round<'_>) {
        let Range { start, end } = self.range;
        let mut first = start;
        while first < end {
            let count = (end - first).min(V::ROWS);
            with_constant!(
                ROWS = count, one of [1, 2, 3, 4, 5, 6] =>
                self.tile::<V, ROWS, VECTORS>(proof, round, first)
            );
            first += count;
        }
    }

    #[inline(always)]
    fn tile<V: Vector, const ROWS: usize, const VECTORS: usize>(
        &mut self,
        proof: V::Proof,
        round: Round<'_>,
        first: usize,
    ) {
        let places: [(usize, usize); ROWS] = std::array::from_fn(|row| self.place(first + row));
        let outputs = places.map(|(_, output)| output + round.panel * PANEL);
        let mut tile: Tile<V, ROWS, VECTORS> = match self.rule.start {
            Start::Zero if round.is_first => Tile::zero(proof),
            Start::Bias(bias) if round.is_first => {
                Tile::load(proof, bias, [round.panel * PANEL; ROWS], PANEL)
            }
            _ => Tile::load(proof, self.output, outputs, PANEL),
        };
        self.prefetch::<V, ROWS, VECTORS>(proof, round, outputs, first + ROWS);
        let stride = self.rows * PANEL;
        let panels = &self.weights[round.panel * stride..];
        for tap in round.taps {
            let inputs = places.map(|(input, _)| input + tap.offset);
            tile.add_runs(
                self.input,
                inputs,
                &panels[tap.row * PANEL..],
                stride,
                self.run,
            );
        }
        if round.is_last {
            tile = match self.rule.finish {
                Finish::Keep => tile,
                Finish::Relu => tile.positive_part(),
                Finish::AddThenRelu(other) => tile
                    .plus(Tile::load(proof, other, outputs, PANEL))
                    .positive_part(),
            };
        }
        tile.store(self.output, outputs, PANEL);
    }

    /// Prefetches the outputs of the present tile of sums, and the end of each pixel's last run for the next tile. Both loads complete during the
    /// present summation.
    #[inline(always)]
    fn prefetch<V: Vector, const ROWS: usize, const VECTORS: usize>(
        &self,
        proof: V::Proof,
        round: Round<'_>,
        outputs: [usize; ROWS],
        next: usize,
    ) {
        Tile::<V, ROWS, VECTORS>::prefetch(proof, self.output, outputs, PANEL);
        if let Finish::AddThenRelu(other) = self.rule.finish {
            Tile::<V, ROWS, VECTORS>::prefetch(proof, other, outputs, PANEL);
        }
        let is_next = next + ROWS <= self.range.end;
        if let (Some(last), 0, true) = (round.taps.last(), round.panel, is_next) {
            let end = last.offset + self.run;
            let ends = std::array::from_fn(|row| self.place(next + row).0 + end);
            let starts = ends.map(|end| end.saturating_sub(VECTORS * V::LANES));
            Tile::<V, ROWS, VECTORS>::prefetch(proof, self.input, starts, PANEL);
        }
    }

    /// Offsets of the pixel `position`, counted over all pictures, in input and output.
    #[inline(always)]
    fn place(&self, position: usize) -> (usize, usize) {
        let image = position / self.pixels.len();
        let (input, output) = self.pixels.at(position % self.pixels.len());
        let output = match self.layout {
            OutputLayout::Pictures {
                image: length,
                skipped,
            } => image * length + output - skipped,
            OutputLayout::Packed { channels } => (position - self.range.start) * channels,
        };
        (image * self.input_image + input, output)
    }
}
