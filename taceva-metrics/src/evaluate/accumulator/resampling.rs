//! Resampling: a score recomputed for other selections of clusters, for its interval.

use std::borrow::Cow;

use super::erased_sums::ErasedSums;
use crate::evaluate::family::Numbers;
use crate::exact::merge::Merge;
use crate::score::Interval;
use crate::score::range::Range;
use crate::score::value::{Finished, UndefinedReason};
use crate::stats::jackknife::{self, LeftOut};
use crate::stats::{Estimated, PoissonBootstrap};

/// A cluster: the hash or index of its name, and the sums of each part.
pub(super) type Cell<'a> = (u64, &'a ErasedSums);

/// Calls `visit` with each cluster and the sums of all other clusters.
///
/// Running sums of the clusters before and after make subtractions unnecessary. Sums that cannot be subtracted therefore have intervals too.
pub(super) fn each_left_out(
    empty: &ErasedSums,
    cells: &[Cell<'_>],
    visit: &mut dyn FnMut(&ErasedSums, &ErasedSums),
) {
    let mut after = Vec::with_capacity(cells.len());
    let mut sums = empty.clone();
    for (_, cell) in cells.iter().rev() {
        after.push(sums.clone());
        sums.merge(cell);
    }
    let mut before = empty.clone();
    for (_, cell) in cells {
        let mut others = after.pop().unwrap_or_else(|| empty.clone());
        others.merge(&before);
        visit(cell, &others);
        before.merge(cell);
    }
}

/// Value and variants of one score, recomputed for other selections of clusters.
pub(super) struct Resampling {
    /// Names and ranges of the numbers.
    names: Vec<(Option<Cow<'static, str>>, Range)>,
    draws: Draws,
}

enum Draws {
    /// Number of samples of the left-out cluster, and the numbers computed from the other clusters.
    LeftOut(Vec<(u64, Vec<Finished>)>),
    /// Intervals of the numbers.
    Weighted(Vec<Interval>),
}

impl Resampling {
    /// Empty resampling for `numbers` computed from all clusters, with a value in `range`.
    pub(super) fn new(numbers: &Numbers, range: Range) -> Resampling {
        let variants = numbers.variants.iter();
        let names = variants.map(|variant| (Some(variant.name.clone()), variant.range));
        Resampling {
            names: std::iter::once((None, range)).chain(names).collect(),
            draws: Draws::LeftOut(Vec::new()),
        }
    }

    /// True if any of the numbers has an interval. Maxima have no interval.
    pub(super) fn is_needed(&self) -> bool {
        let mut ranges = self.names.iter().map(|(_, range)| range);
        ranges.any(|range| *range != Range::Greatest)
    }

    /// Adds the numbers computed without one cluster, which has `count` samples.
    pub(super) fn leave_out(&mut self, count: u64, others: &Numbers) {
        let others = self.in_order(others);
        if let Draws::LeftOut(draws) = &mut self.draws {
            draws.push((count, others));
        }
    }

    /// Recomputes the score once per replicate, with clusters of `samples` samples multiplied by their weights.
    pub(super) fn weigh(
        &mut self,
        bootstrap: PoissonBootstrap,
        empty: &ErasedSums,
        cells: &[Cell<'_>],
        total: &Numbers,
        samples: u64,
        finish: &dyn Fn(&ErasedSums) -> Numbers,
    ) {
        let keys: Vec<u64> = cells.iter().map(|(key, _)| *key).collect();
        let mut replicates: Vec<Vec<Finished>> = Vec::new();
        // Weights depend on clusters and seed alone: the first pass computes all numbers, later passes look them up.
        let anything = Estimated {
            value: 0.0,
            range: Range::Any,
            samples,
        };
        bootstrap.interval(&anything, &keys, |weights| {
            let mut sums = empty.clone();
            for ((_, cell), &weight) in cells.iter().zip(weights) {
                sums.merge_times(cell, weight);
            }
            replicates.push(self.in_order(&finish(&sums)));
            Ok(0.0)
        });
        let intervals = self.in_order(total).into_iter().enumerate();
        let intervals = intervals.map(|(position, value)| match value {
            Err(reason) => Interval::Undefined(reason),
            Ok(value) => {
                let mut replicates = replicates.iter();
                let estimated = Estimated {
                    value,
                    range: self.names[position].1,
                    samples,
                };
                bootstrap.interval(&estimated, &keys, |_| {
                    let replicate = replicates.next().ok_or(UndefinedReason::Empty)?;
                    replicate[position]
                })
            }
        });
        self.draws = Draws::Weighted(intervals.collect());
    }

    /// Interval about `value`, for the variant called `name` or the value itself.
    pub(super) fn interval(&self, value: f64, name: Option<&str>) -> Interval {
        let mut names = self.names.iter();
        let position = names.position(|(known, _)| known.as_deref() == name);
        let Some(position) = position else {
            return Interval::Undefined(UndefinedReason::Empty);
        };
        if self.names[position].1 == Range::Greatest {
            return Interval::Undefined(UndefinedReason::Greatest);
        }
        match &self.draws {
            Draws::Weighted(intervals) => intervals[position],
            Draws::LeftOut(draws) => {
                let left_out = draws.iter().map(|(count, others)| LeftOut {
                    count: *count,
                    value: others[position],
                });
                let range = self.names[position].1;
                jackknife::interval(value, range, &left_out.collect::<Vec<_>>())
            }
        }
    }

    fn in_order(&self, numbers: &Numbers) -> Vec<Finished> {
        let names = self.names.iter();
        names
            .map(|(name, _)| match name {
                None => numbers.value,
                Some(name) => numbers.variant(name),
            })
            .collect()
    }
}
