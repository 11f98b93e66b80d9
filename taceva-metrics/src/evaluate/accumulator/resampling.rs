//! Resampling: scores recomputed with some clusters left out or weighted, for their intervals.

use std::borrow::Cow;

use super::erased_sums::ErasedSums;
use crate::evaluate::family::Numbers;
use crate::exact::merge::Merge;
use crate::score::Interval;
use crate::score::range::Range;
use crate::score::value::{Finished, UndefinedReason};
use crate::stats::jackknife::{self, LeftOut};
use crate::stats::{Estimated, PoissonBootstrap};

/// A cluster: its key, which is the hash or index of its name, and the sums of each part.
pub(super) type Cell<'a> = (u64, &'a ErasedSums);

/// Calls `visit` with the sums of each cluster and the sums of all other clusters, in the order of `cells`.
///
/// The clusters are halved again and again, and the sums of the other half are merged each time. Nothing is subtracted, so sums need no subtraction.
pub(super) fn each_left_out(
    empty: &ErasedSums,
    cells: &[Cell<'_>],
    visit: &mut dyn FnMut(&ErasedSums, &ErasedSums),
) {
    leave_out_each(empty.clone(), cells, visit);
}

/// Visits the clusters in `cells`. `others` has the sums of all clusters outside `cells`.
fn leave_out_each(
    mut others: ErasedSums,
    cells: &[Cell<'_>],
    visit: &mut dyn FnMut(&ErasedSums, &ErasedSums),
) {
    match cells {
        [] => {}
        [(_, cell)] => visit(cell, &others),
        _ => {
            let (left, right) = cells.split_at(cells.len() / 2);
            let mut of_left = others.clone();
            right.iter().for_each(|(_, cell)| of_left.merge(cell));
            leave_out_each(of_left, left, visit);
            left.iter().for_each(|(_, cell)| others.merge(cell));
            leave_out_each(others, right, visit);
        }
    }
}

/// Value and variants of one score, recomputed with some clusters left out or weighted.
pub(super) struct Resampling {
    /// Name and range of the value (without a name) and of each variant.
    names: Vec<(Option<Cow<'static, str>>, Range)>,
    draws: Draws,
}

enum Draws {
    /// For each left-out cluster: its number of samples, and the numbers computed from all other clusters.
    LeftOut(Vec<(u64, Vec<Finished>)>),
    /// Interval of each number, from a weighted bootstrap.
    Weighted(Vec<Interval>),
}

impl Resampling {
    /// Resampling without results, for the `numbers` computed from all clusters. `range` is the range of the value.
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

    /// Recomputes the score once per replicate, with the sums of each cluster multiplied by its weight. `samples` is the number of samples in all
    /// clusters.
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

    /// Interval about `value`, which is the variant called `name`, or the value of the score for `None`.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::moments::Moments;

    #[test]
    fn each_cluster_is_visited_in_order_with_the_sums_of_all_others() {
        let sums = |values: &[f64]| {
            let moments: Moments = values.iter().copied().collect();
            ErasedSums::new(vec![moments])
        };
        for count in 0..8_u32 {
            let values: Vec<f64> = (0..count).map(|at| f64::from(1_u32 << at)).collect();
            let clusters: Vec<ErasedSums> = values.iter().map(|value| sums(&[*value])).collect();
            let cells: Vec<Cell<'_>> = (0..).zip(&clusters).collect();
            let sum = |sums: &ErasedSums| sums.sums::<Moments>()[0].sum.to_f64();
            let mut visited = Vec::new();
            each_left_out(&sums(&[]), &cells, &mut |cell, others| {
                visited.push([sum(cell), sum(others)]);
            });
            let all: f64 = values.iter().sum();
            let expected: Vec<[f64; 2]> = values.iter().map(|own| [*own, all - own]).collect();
            assert_eq!(visited, expected);
        }
    }
}
