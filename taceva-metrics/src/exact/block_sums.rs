//! Exact sums of streams, quantities of pairs of truth and prediction, block by block.
//!
//! A grid is a range of magnitudes with fixed units. A block is summed in integer numbers of units, on grids that fit the latest pairs. These numbers
//! grow over many blocks. They move to the exact sums when the grids change, before an overflow, and when a sum is read. A pair that does not fit the
//! grids is removed from its block and added alone. The selection of these pairs depends on earlier pairs, but the sums do not: every path is exact.

use super::bounds::{Grids, TERMS};
use super::kernel::{BLOCK_ROWS, Block};
use super::machine::Machine;
use super::partition::Parts;
use super::sum::ExactSum;
use super::unit_sums::{Pending, deposit};
use crate::exact::merge::Merge;
use crate::exact::streams::{Stream, Streams};
use crate::pair::Paired;

/// Least number of rows of a block. Adding fewer rows one by one is faster.
const FEW_ROWS: usize = 4;
/// Greatest number of rows between moves of the unit counts to the exact sums. Each row adds less than 2⁴⁴ units, so a count fits an `i64`.
const MOST_ROWS: usize = 1 << 19;

/// Exact sums of the requested streams (quantities of a pair), with counts of the pairs.
#[derive(Clone, Debug)]
pub(crate) struct BlockSums {
    machine: Machine,
    streams: Streams,
    gate: Option<f64>,
    pub(crate) counts: Counts,
    settled: Sums,
    pending: Option<Pending>,
}

/// Counts of summed pairs, of skipped pairs, and of pairs in the gated sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Summed pairs.
    pub(crate) valid: u64,
    /// Pairs skipped for a NaN or a magnitude above 2¹⁰²¹.
    pub(crate) invalid: u64,
    /// Summed pairs whose truth has at least the magnitude of the gate.
    pub(crate) gated: u64,
}

/// Sum of each stream, and gated sum: the sMAPE terms of pairs whose truth has at least the magnitude of the gate.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    pub(crate) streams: [ExactSum; Stream::ALL.len()],
    pub(crate) gated: ExactSum,
}

impl BlockSums {
    /// Empty sums of `streams`. The gated sum takes pairs whose truth has a magnitude of at least `gate`; `None` omits this sum.
    pub(crate) fn new(machine: Machine, streams: Streams, gate: Option<f64>) -> BlockSums {
        BlockSums {
            machine,
            streams,
            gate,
            counts: Counts::default(),
            settled: Sums::default(),
            pending: None,
        }
    }

    /// Replaces counts and sums by saved counts and sums with the same streams.
    pub(crate) fn set(&mut self, counts: Counts, sums: Sums) {
        (self.counts, self.settled, self.pending) = (counts, sums, None);
    }

    /// Adds pairs. A pair with a NaN or a magnitude above 2¹⁰²¹ is skipped and counted.
    pub(crate) fn update(&mut self, pairs: Paired<&[f64]>) {
        if pairs.estimate.len() < FEW_ROWS {
            return pairs.iter().for_each(|pair| self.add_pair(pair));
        }
        let mut blocks = pairs.blocks(Block::rows_on(self.machine)).peekable();
        while let Some(pairs) = blocks.next() {
            let next = blocks.peek().copied().unwrap_or_default();
            if !self.add_block(pairs, next) {
                self.add_strays_apart(pairs);
            }
        }
    }

    /// Sum of `stream`; zero for a stream that is not requested.
    pub(crate) fn sum(&self, stream: Stream) -> ExactSum {
        let mut sum = self.settled.streams[stream as usize].clone();
        if let Some(pending) = self
            .pending
            .as_ref()
            .filter(|_| self.streams.contains(stream))
        {
            pending.deposit(stream, &mut sum);
        }
        sum
    }

    /// Sum of the sMAPE terms of pairs whose truth has at least the magnitude of the gate.
    pub(crate) fn gated_sum(&self) -> ExactSum {
        let mut sum = self.settled.gated.clone();
        if let Some(pending) = self.pending.as_ref().filter(|_| self.gate.is_some()) {
            deposit(pending.values.gated, TERMS, &mut sum);
        }
        sum
    }

    /// Adds a block whose pairs all fit the grids in use. Returns false and adds nothing if a pair does not fit.
    fn add_block(&mut self, pairs: Paired<&[f64]>, next: Paired<&[f64]>) -> bool {
        let Some(pending) = &mut self.pending else {
            return false;
        };
        let block = Block {
            pairs,
            next,
            streams: self.streams,
            gate: self.gate,
            grids: pending.grids,
            bounds: pending.bounds,
        };
        let Some(errors) = block.errors(self.machine) else {
            return false;
        };
        let values = block.values(self.machine);
        pending.errors.add(&errors);
        pending.values.add(&values);
        pending.rows += pairs.estimate.len();
        pending.rows_on_grids += pairs.estimate.len();
        let rows = count(pairs.estimate.len());
        self.counts.valid += rows;
        // Blocks are padded with zeros, which a gate of 0 or less would count.
        let all = self.gate.is_some_and(|gate| gate <= 0.0);
        self.counts.gated += if all { rows } else { u64::from(values.n_gated) };
        if pending.rows > MOST_ROWS - BLOCK_ROWS {
            self.settle();
        }
        true
    }

    /// Adds a block with strays, pairs that do not fit the grids: the strays one by one, and the other pairs as a block.
    #[cold]
    #[inline(never)]
    fn add_strays_apart(&mut self, pairs: Paired<&[f64]>) {
        let mut parts = Parts::default();
        if let Some(pending) = &mut self.pending {
            parts.divide(pairs, &pending.bounds);
            pending.strays += parts.strays;
        }
        let pending = self.pending.as_ref();
        if pending.is_none_or(|pending| pending.strays > pending.free_strays()) {
            self.settle();
            let pending = Pending::new(Grids::fitting(pairs, self.streams), self.streams);
            parts.divide(pairs, &self.pending.insert(pending).bounds);
        }
        let strays = parts.rows(pairs.estimate.len() - parts.strays..pairs.estimate.len());
        strays.iter().for_each(|pair| self.add_pair(pair));
        let fitting = parts.rows(0..pairs.estimate.len() - parts.strays);
        let added = self.add_block(fitting, Paired::default());
        assert!(added, "pairs out of bounds were removed");
    }

    /// Adds one pair directly to the exact sums.
    fn add_pair(&mut self, pair: Paired<f64>) {
        if !pair.is_valid() {
            self.counts.invalid += 1;
            return;
        }
        self.counts.valid += 1;
        for stream in self.streams.iter() {
            let sum = &mut self.settled.streams[stream as usize];
            match stream {
                Stream::Absolute => sum.deposit(pair.residual().abs()),
                Stream::Residual => sum.deposit(pair.residual()),
                Stream::Squared => sum.deposit_square(pair.residual()),
                Stream::Truth => sum.deposit(pair.reference),
                Stream::TruthSquared => sum.deposit_square(pair.reference),
                Stream::Symmetric => sum.deposit(pair.symmetric_term()),
            }
        }
        if self.gate.is_some_and(|gate| pair.reference.abs() >= gate) {
            self.counts.gated += 1;
            self.settled.gated.deposit(pair.symmetric_term());
        }
    }

    /// Moves the pending numbers of units to the exact sums.
    fn settle(&mut self) {
        let Some(pending) = &mut self.pending else {
            return;
        };
        self.settled.take_over(pending, self.streams, self.gate);
        pending.clear();
    }
}

impl Merge for BlockSums {
    fn merge(&mut self, other: &BlockSums) {
        self.counts.valid = self.counts.valid.saturating_add(other.counts.valid);
        self.counts.invalid = self.counts.invalid.saturating_add(other.counts.invalid);
        self.counts.gated = self.counts.gated.saturating_add(other.counts.gated);
        let sums = self.settled.streams.iter_mut();
        for (sum, other) in sums.zip(&other.settled.streams) {
            sum.merge(other);
        }
        self.settled.gated.merge(&other.settled.gated);
        if let Some(pending) = &other.pending {
            self.settled.take_over(pending, self.streams, self.gate);
        }
    }
}

/// Equality by value: one side may have pending units that the other side has already moved.
impl PartialEq for BlockSums {
    fn eq(&self, other: &BlockSums) -> bool {
        self.streams == other.streams
            && self.gate == other.gate
            && self.counts == other.counts
            && Stream::ALL
                .iter()
                .all(|&stream| self.sum(stream) == other.sum(stream))
            && self.gated_sum() == other.gated_sum()
    }
}

impl Sums {
    fn take_over(&mut self, pending: &Pending, streams: Streams, gate: Option<f64>) {
        for stream in streams.iter() {
            pending.deposit(stream, &mut self.streams[stream as usize]);
        }
        if gate.is_some() {
            deposit(pending.values.gated, TERMS, &mut self.gated);
        }
    }
}

fn count(rows: usize) -> u64 {
    u64::try_from(rows).expect("no column has 2^64 rows")
}
