//! Inner loops that sum a block of pairs in integer numbers of fixed units.
//!
//! A block is visited twice: once for the sums of residuals, truth − prediction, and once for the other sums. The sums of one visit then fit the
//! registers of any processor. Between the visits the block stays in the L1 cache. The first visit also checks that all pairs are within [`Bounds`].
//! If a pair is outside, the sums of this visit are discarded.

use super::bounds::{Bounds, Grids, TERMS};
use super::grid::{DEPTH, GridSum, ProductSum, ProductUnits};
use super::machine::Machine;
use super::vector::{Job, Vector};
use crate::exact::streams::{Stream, Streams};
use crate::pair::{EPSILON, Paired};

/// Greatest number of rows of a block.
pub(super) const BLOCK_ROWS: usize = 512;

/// A block of pairs with its streams, gate, grids and bounds.
#[derive(Clone, Copy)]
pub(super) struct Block<'a> {
    pub(super) pairs: Paired<&'a [f64]>,
    /// Pairs of the next block, prefetched while this block is summed.
    pub(super) next: Paired<&'a [f64]>,
    pub(super) streams: Streams,
    /// Threshold of the gated sum, which takes pairs whose truth has at least this magnitude; `None` without a gated sum.
    pub(super) gate: Option<f64>,
    pub(super) grids: Grids,
    pub(super) bounds: Bounds,
}

/// Numbers of units in the sums of residuals, truth − prediction.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ErrorUnits {
    pub(super) absolute: [i64; 2],
    pub(super) residual: [i64; 2],
    pub(super) squared: ProductUnits,
}

impl ErrorUnits {
    /// Adds the units of another block.
    #[inline]
    pub(super) fn add(&mut self, other: &ErrorUnits) {
        add(&mut self.absolute, other.absolute);
        add(&mut self.residual, other.residual);
        add_products(&mut self.squared, other.squared);
    }
}

/// Numbers of units in the sums of truths and in the sums of sMAPE terms, with the number of gated pairs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ValueUnits {
    pub(super) truth: [i64; 2],
    pub(super) squared: ProductUnits,
    pub(super) symmetric: [i64; 2],
    pub(super) gated: [i64; 2],
    pub(super) n_gated: u32,
}

impl ValueUnits {
    /// Adds the units of another block.
    #[inline]
    pub(super) fn add(&mut self, other: &ValueUnits) {
        add(&mut self.truth, other.truth);
        add_products(&mut self.squared, other.squared);
        add(&mut self.symmetric, other.symmetric);
        add(&mut self.gated, other.gated);
    }
}

pub(super) fn add(units: &mut [i64; 2], other: [i64; 2]) {
    units[0] += other[0];
    units[1] += other[1];
}

pub(super) fn add_products(units: &mut ProductUnits, [rounded, lost]: ProductUnits) {
    add(&mut units[0], rounded);
    add(&mut units[1], lost);
}

impl Block<'_> {
    /// Greatest number of rows of a block on `machine`, limited by the lanes of a vector.
    pub(super) fn rows_on(machine: Machine) -> usize {
        /// Job that returns the number of lanes of a vector.
        struct Lanes;
        impl Job for Lanes {
            type Output = usize;
            #[inline(always)]
            fn run<V: Vector>(self, _proof: V::Proof) -> usize {
                V::LANES
            }
        }
        (DEPTH * machine.run(Lanes)).min(BLOCK_ROWS)
    }

    /// Sums of the streams of residuals; `None` if a pair is out of bounds.
    pub(super) fn errors(self, machine: Machine) -> Option<ErrorUnits> {
        const A: u8 = Streams::of(&[Stream::Absolute]).bits();
        const R: u8 = Streams::of(&[Stream::Residual]).bits();
        const S: u8 = Streams::of(&[Stream::Squared]).bits();
        match self.streams.bits() & (A | R | S) {
            // At least one sum is needed to notice a NaN.
            0 | A => machine.run(Errors::<A>(self)),
            S => machine.run(Errors::<S>(self)),
            bits if bits == A | S => machine.run(Errors::<{ A | S }>(self)),
            // Unread sums cost less than kernels for every combination.
            _ => machine.run(Errors::<{ A | R | S }>(self)),
        }
    }

    /// Sums of the streams of truths and of sMAPE terms. All pairs of the block must be within bounds.
    pub(super) fn values(self, machine: Machine) -> ValueUnits {
        const Y: u8 = Streams::of(&[Stream::Truth]).bits();
        const S: u8 = Streams::of(&[Stream::TruthSquared]).bits();
        const T: u8 = Streams::of(&[Stream::Symmetric]).bits();
        let wanted = self.streams.bits() & (Y | S | T);
        match (wanted, self.gate.is_some()) {
            (0, _) => ValueUnits::default(),
            (T, false) => machine.run(Values::<T, false>(self)),
            (bits, _) if bits & T == 0 => machine.run(Values::<{ Y | S }, false>(self)),
            (_, false) => machine.run(Values::<{ Y | S | T }, false>(self)),
            _ => machine.run(Values::<{ Y | S | T }, true>(self)),
        }
    }
}

const fn has(streams: u8, stream: Stream) -> bool {
    streams & Streams::of(&[stream]).bits() != 0
}

/// Visitor that receives pairs as vectors.
pub(super) trait Visit<V> {
    fn visit(&mut self, estimate: V, reference: V);
}

/// Number of rows in a cache line of one column.
const LINE_ROWS: usize = 8;

/// Passes all pairs to `visitor`, with the last vector padded by zeros, and prefetches the cache lines of `next`.
#[inline(always)]
pub(super) fn visit_all<V: Vector>(
    proof: V::Proof,
    pairs: Paired<&[f64]>,
    next: Paired<&[f64]>,
    visitor: &mut impl Visit<V>,
) {
    let estimates = pairs.estimate.chunks_exact(LINE_ROWS);
    let references = pairs.reference.chunks_exact(LINE_ROWS);
    let rest = (estimates.remainder(), references.remainder());
    let mut next_estimates = next.estimate.chunks(LINE_ROWS);
    let mut next_references = next.reference.chunks(LINE_ROWS);
    for (estimate, reference) in estimates.zip(references) {
        if let Some(line) = next_estimates.next() {
            V::prefetch(line);
        }
        if let Some(line) = next_references.next() {
            V::prefetch(line);
        }
        let vectors = estimate.chunks_exact(V::LANES);
        for (estimate, reference) in vectors.zip(reference.chunks_exact(V::LANES)) {
            visitor.visit(V::load(proof, estimate), V::load(proof, reference));
        }
    }
    for (estimate, reference) in rest.0.chunks(V::LANES).zip(rest.1.chunks(V::LANES)) {
        visitor.visit(
            V::load_short(proof, estimate),
            V::load_short(proof, reference),
        );
    }
}

/// First visit of a block: sums of residuals.
struct Errors<'a, const STREAMS: u8>(Block<'a>);

struct ErrorSums<V, const STREAMS: u8> {
    one: V,
    greatest_residual: V,
    greatest_truth: V,
    /// Predecessor of the least nonzero magnitude of a residual, in each lane.
    least_residual: V,
    least_truth: V,
    absolute: GridSum<V>,
    residual: GridSum<V>,
    squared: ProductSum<V>,
}

impl<V: Vector, const STREAMS: u8> Visit<V> for ErrorSums<V, STREAMS> {
    #[inline(always)]
    fn visit(&mut self, estimate: V, reference: V) {
        let residual = reference.minus(estimate);
        let magnitude = residual.magnitude();
        let truth = reference.magnitude();
        self.greatest_residual = magnitude.greatest(self.greatest_residual);
        self.greatest_truth = truth.greatest(self.greatest_truth);
        self.least_residual = magnitude.predecessor().least(self.least_residual);
        self.least_truth = truth.predecessor().least(self.least_truth);
        if const { has(STREAMS, Stream::Absolute) } {
            self.absolute.add(magnitude, self.one);
        }
        if const { has(STREAMS, Stream::Residual) } {
            self.residual.add(residual, self.one);
        }
        if const { has(STREAMS, Stream::Squared) } {
            self.squared.add_product(residual, residual, self.one);
        }
    }
}

impl<const STREAMS: u8> Job for Errors<'_, STREAMS> {
    type Output = Option<ErrorUnits>;

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) -> Option<ErrorUnits> {
        let Errors(block) = self;
        let (grid, bounds) = (block.grids.residual, block.bounds);
        let mut sums = ErrorSums::<V, STREAMS> {
            one: V::splat(proof, std::hint::black_box(1.0)),
            greatest_residual: V::splat(proof, 0.0),
            greatest_truth: V::splat(proof, 0.0),
            least_residual: V::splat(proof, f64::MAX),
            least_truth: V::splat(proof, f64::MAX),
            absolute: GridSum::new(proof, grid),
            residual: GridSum::new(proof, grid),
            squared: ProductSum::new(proof, [grid; 2]),
        };
        visit_all(proof, block.pairs, block.next, &mut sums);
        let residual = bounds.residual.in_lanes::<V>(proof);
        let truth = bounds.truth.in_lanes::<V>(proof);
        let within = residual.hold(sums.least_residual, sums.greatest_residual)
            && truth.hold(sums.least_truth, sums.greatest_truth);
        // A NaN is neither greatest nor least, but stays in every sum.
        let sound = sums.absolute.is_sound() && sums.residual.is_sound() && sums.squared.is_sound();
        if !within || !sound {
            return None;
        }
        Some(ErrorUnits {
            absolute: sums.absolute.units(),
            residual: sums.residual.units(),
            squared: sums.squared.units(),
        })
    }
}

/// Second visit of a block: sums of truths and of sMAPE terms.
struct Values<'a, const STREAMS: u8, const GATED: bool>(Block<'a>);

struct ValueSums<V, const STREAMS: u8, const GATED: bool> {
    one: V,
    half: V,
    epsilon: V,
    gate: V,
    truth: GridSum<V>,
    squared: ProductSum<V>,
    symmetric: GridSum<V>,
    gated: GridSum<V>,
    n_gated: u32,
}

impl<V: Vector, const STREAMS: u8, const GATED: bool> Visit<V> for ValueSums<V, STREAMS, GATED> {
    #[inline(always)]
    fn visit(&mut self, estimate: V, reference: V) {
        if const { has(STREAMS, Stream::Symmetric) } {
            let truth = reference.magnitude();
            let sum = truth.plus(estimate.magnitude());
            let scale = sum.times(self.half).plus(self.epsilon);
            let term = reference.minus(estimate).magnitude().over(scale);
            self.symmetric.add(term, self.one);
            if GATED {
                self.gated
                    .add(truth.keep_at_least(self.gate, term), self.one);
                self.n_gated += truth.count_at_least(self.gate);
            }
        }
        if const { has(STREAMS, Stream::Truth) } {
            self.truth.add(reference, self.one);
        }
        if const { has(STREAMS, Stream::TruthSquared) } {
            self.squared.add_product(reference, reference, self.one);
        }
    }
}

impl<const STREAMS: u8, const GATED: bool> Job for Values<'_, STREAMS, GATED> {
    type Output = ValueUnits;

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) -> ValueUnits {
        let Values(block) = self;
        let grid = block.grids.truth;
        // Without a gate, the gated sums are not read.
        let gate = block.gate.unwrap_or(f64::INFINITY);
        let mut sums = ValueSums::<V, STREAMS, GATED> {
            one: V::splat(proof, std::hint::black_box(1.0)),
            half: V::splat(proof, 0.5),
            epsilon: V::splat(proof, EPSILON),
            gate: V::splat(proof, gate),
            truth: GridSum::new(proof, grid),
            squared: ProductSum::new(proof, [grid; 2]),
            symmetric: GridSum::new(proof, TERMS),
            gated: GridSum::new(proof, TERMS),
            n_gated: 0,
        };
        visit_all(proof, block.pairs, Paired::default(), &mut sums);
        ValueUnits {
            truth: sums.truth.units(),
            squared: sums.squared.units(),
            symmetric: sums.symmetric.units(),
            gated: sums.gated.units(),
            n_gated: sums.n_gated,
        }
    }
}
