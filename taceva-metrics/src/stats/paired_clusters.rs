//! Clusters of two models, paired by name.

use super::cluster_sums::{ClusterSum, ClusterSums};
use super::error::ComparisonError;
use super::jackknife::{self, LeftOut};
use super::sides::{Side, Sides};
use crate::exact::{Dyadic, ExactSum};
use crate::score::least::LEAST_CLUSTERS;
use crate::score::value::UndefinedReason;

/// Difference of the mean terms of A and B, with its jackknife standard error over clusters.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeanDifference {
    pub(super) value: f64,
    pub(super) scores: Sides<f64>,
    pub(super) standard_error: f64,
    pub(super) freedom: f64,
}

/// Clusters with samples, paired by name for both sides.
pub(super) struct PairedClusters {
    counts: Vec<u64>,
    differences: Vec<ExactSum>,
    totals: Sides<ExactSum>,
}

impl PairedClusters {
    /// Pairs the clusters of both sides. Names and numbers of samples must be equal.
    pub(super) fn of(sums: Sides<&ClusterSums>) -> Result<PairedClusters, ComparisonError> {
        let sampled = |(_, cell): &(&str, &ClusterSum)| cell.n > 0;
        let unpaired = |side, name: &str| ComparisonError::Unpaired {
            side,
            cluster: name.to_owned(),
        };
        let mut pairs = PairedClusters {
            counts: Vec::new(),
            differences: Vec::new(),
            totals: Sides::default(),
        };
        for (name, a) in sums.a.iter().filter(sampled) {
            let b = sums.b.get(name).filter(|b| b.n > 0);
            let b = b.ok_or_else(|| unpaired(Side::A, name))?;
            if a.n != b.n {
                return Err(ComparisonError::Counts {
                    cluster: name.to_owned(),
                    samples: Sides { a: a.n, b: b.n },
                });
            }
            let mut difference = a.sum.clone();
            difference.subtract(&b.sum);
            pairs.counts.push(a.n);
            pairs.differences.push(difference);
            pairs.totals.a.merge(&a.sum);
            pairs.totals.b.merge(&b.sum);
        }
        for (name, _) in sums.b.iter().filter(sampled) {
            if sums.a.get(name).is_none_or(|a| a.n == 0) {
                return Err(unpaired(Side::B, name));
            }
        }
        Ok(pairs)
    }

    /// Numbers of samples of the clusters, in the order of names.
    pub(super) fn counts(&self) -> &[u64] {
        &self.counts
    }

    /// Sum of the terms of A minus sum of the terms of B, for each cluster in the order of names.
    pub(super) fn differences(&self) -> &[ExactSum] {
        &self.differences
    }

    /// Difference of the mean terms of A and B over all samples, with its jackknife standard error over clusters.
    pub(super) fn mean_difference(&self) -> Result<MeanDifference, ComparisonError> {
        let clusters = self.counts.len();
        if clusters < LEAST_CLUSTERS {
            return Err(ComparisonError::TooFewClusters { have: clusters });
        }
        let samples = self
            .counts
            .iter()
            .fold(0, |all: u64, &n| all.saturating_add(n));
        let mut total = self.totals.a.clone();
        total.subtract(&self.totals.b);
        let left_out = self
            .counts
            .iter()
            .zip(&self.differences)
            .map(|(&count, difference)| {
                let mut others = total.clone();
                others.subtract(difference);
                LeftOut {
                    count,
                    value: mean(&others, samples - count),
                }
            });
        let value = mean(&total, samples).map_err(ComparisonError::NoInterval)?;
        let scores = Sides {
            a: &self.totals.a,
            b: &self.totals.b,
        }
        .try_map(|side, sum| {
            mean(sum, samples).map_err(|reason| ComparisonError::Undefined { side, reason })
        })?;
        let standard_error = jackknife::standard_error(value, &left_out.collect::<Vec<_>>())
            .map_err(ComparisonError::NoInterval)?;
        Ok(MeanDifference {
            value,
            scores,
            standard_error,
            freedom: self.counts.iter().fold(-1.0, |freedom, _| freedom + 1.0),
        })
    }
}

/// Mean from an exact sum, rounded once.
fn mean(sum: &ExactSum, n: u64) -> Result<f64, UndefinedReason> {
    if n == 0 {
        return Err(UndefinedReason::Empty);
    }
    let mean = sum.to_dyadic().over(&Dyadic::from(n));
    if mean.is_finite() {
        Ok(mean)
    } else {
        Err(UndefinedReason::Overflow)
    }
}
