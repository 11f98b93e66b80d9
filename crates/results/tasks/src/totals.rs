//! Exact totals of clusters, and the jackknife: scores with one cluster left out.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use taceva_metrics::{Dyadic, ExactSum, Interval, Range, UndefinedReason};

use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::estimate::{Estimate, Part, estimate};
use crate::undefined::Undefined;

/// Exact sums and counts of a cluster.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Totals<const SUMS: usize, const COUNTS: usize> {
    /// Sums, such as of errors.
    pub(crate) sums: [ExactSum; SUMS],
    /// Counts, such as pixels or poses.
    pub(crate) counts: [u64; COUNTS],
}

impl<const SUMS: usize, const COUNTS: usize> Default for Totals<SUMS, COUNTS> {
    fn default() -> Totals<SUMS, COUNTS> {
        Totals {
            sums: std::array::from_fn(|_| ExactSum::default()),
            counts: [0; COUNTS],
        }
    }
}

impl<const SUMS: usize, const COUNTS: usize> Totals<SUMS, COUNTS> {
    /// Adds the totals of `other`.
    pub(crate) fn merge(&mut self, other: &Totals<SUMS, COUNTS>) {
        for (sum, other) in self.sums.iter_mut().zip(&other.sums) {
            sum.merge(other);
        }
        for (count, other) in self.counts.iter_mut().zip(other.counts) {
            *count += other;
        }
    }

    /// Subtracts the totals of `other`. These totals must include `other`.
    fn subtract(&mut self, other: &Totals<SUMS, COUNTS>) {
        for (sum, other) in self.sums.iter_mut().zip(&other.sums) {
            sum.subtract(other);
        }
        for (count, other) in self.counts.iter_mut().zip(other.counts) {
            *count -= other;
        }
    }

    /// Quotient of the sum at index `sum` and the count at index `count`, rounded once.
    pub(crate) fn mean(&self, sum: usize, count: usize) -> Result<f64, Undefined> {
        match self.counts[count] {
            0 => Err(Undefined::Empty),
            count => Ok(self.sums[sum].to_dyadic().over(&Dyadic::from(count))),
        }
    }
}

impl<const SUMS: usize, const COUNTS: usize> Serialize for Totals<SUMS, COUNTS> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.sums.as_slice(), self.counts.as_slice()).serialize(serializer)
    }
}

impl<'de, const SUMS: usize, const COUNTS: usize> Deserialize<'de> for Totals<SUMS, COUNTS> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (sums, counts) = <(Vec<ExactSum>, Vec<u64>)>::deserialize(deserializer)?;
        let sums: Result<[ExactSum; SUMS], _> = sums.try_into();
        let counts: Result<[u64; COUNTS], _> = counts.try_into();
        match (sums, counts) {
            (Ok(sums), Ok(counts)) => Ok(Totals { sums, counts }),
            _ => Err(D::Error::custom(format!(
                "expected {SUMS} sums and {COUNTS} counts"
            ))),
        }
    }
}

/// Counts of all clusters of a stored state.
///
/// # Errors
/// [`TaskError::Damaged`] for a sum of counts of 2⁵³ or more.
pub(crate) fn checked_counts<const SUMS: usize, const COUNTS: usize>(
    clusters: &ByCluster<Totals<SUMS, COUNTS>>,
) -> Result<[u64; COUNTS], TaskError> {
    let mut all = [0; COUNTS];
    for cluster in clusters.values() {
        for (sum, count) in all.iter_mut().zip(cluster.counts) {
            *sum = TaskError::checked_count(*sum, count)?;
        }
    }
    Ok(all)
}

/// Totals of one cluster, and of all other clusters.
#[derive(Debug)]
struct Without<'a, const SUMS: usize, const COUNTS: usize> {
    own: &'a Totals<SUMS, COUNTS>,
    rest: Totals<SUMS, COUNTS>,
}

/// Totals of all clusters, and for each cluster the totals of all other clusters.
#[derive(Debug)]
pub(crate) struct LeaveOneOut<'a, const SUMS: usize, const COUNTS: usize> {
    total: Totals<SUMS, COUNTS>,
    parts: Vec<Without<'a, SUMS, COUNTS>>,
}

impl<'a, const SUMS: usize, const COUNTS: usize> LeaveOneOut<'a, SUMS, COUNTS> {
    /// Totals of `clusters`.
    pub(crate) fn of(
        clusters: &'a ByCluster<Totals<SUMS, COUNTS>>,
    ) -> LeaveOneOut<'a, SUMS, COUNTS> {
        let mut total = Totals::default();
        for cluster in clusters.values() {
            total.merge(cluster);
        }
        let parts = clusters.values().map(|own| {
            let mut rest = total.clone();
            rest.subtract(own);
            Without { own, rest }
        });
        LeaveOneOut {
            parts: parts.collect(),
            total,
        }
    }

    /// Totals of all clusters.
    pub(crate) fn total(&self) -> &Totals<SUMS, COUNTS> {
        &self.total
    }

    /// Estimate of `value`, with the range that `range` returns for the value. The count at index `count` is the number of samples.
    pub(crate) fn estimate(
        &self,
        count: usize,
        range: impl Fn(Result<f64, Undefined>) -> Range,
        value: impl Fn(&Totals<SUMS, COUNTS>) -> Result<f64, Undefined>,
        of_constant: Option<f64>,
    ) -> Estimate {
        let found = value(&self.total);
        let parts = self.parts.iter().map(|part| Part {
            n: part.own.counts[count],
            value: value(&part.rest),
        });
        let parts: Vec<Part> = parts.collect();
        estimate(found, range(found), &parts, of_constant)
    }

    /// `value` without an interval, such as a maximum. The count at index `count` is the number of samples.
    pub(crate) fn without_interval(
        &self,
        count: usize,
        value: Result<f64, Undefined>,
        of_constant: Option<f64>,
    ) -> Estimate {
        let parts = self.parts.iter();
        let clusters = parts.filter(|part| part.own.counts[count] > 0).count();
        Estimate {
            value,
            interval: Interval::Undefined(UndefinedReason::NoInterval),
            n: self.total.counts[count],
            clusters: clusters as u64,
            of_constant,
            left_out: Vec::new(),
        }
    }
}

/// Range of an error: positive numbers.
pub(crate) fn error(_: Result<f64, Undefined>) -> Range {
    Range::Positive
}

/// Range of a signed number: all numbers.
pub(crate) fn signed(_: Result<f64, Undefined>) -> Range {
    Range::Any
}
