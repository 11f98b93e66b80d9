//! Poisson bootstrap: variation of a score over resampled contact points.

use super::ends::{Ends, Estimated, Moved};
use super::poisson::weight;
use super::random::bits;
use crate::score::least::{LEAST_CLUSTERS, LEAST_REPLICATES};
use crate::score::value::UndefinedReason;
use crate::score::{BootstrapEnds, ClusteredBy, Interval, Scale};

/// At most one in this many replicates may lack a value.
const UNDEFINED_IN: usize = 20;

/// Poisson bootstrap: intervals from replicates with random weights of the clusters.
///
/// In replicate b, cluster c has a Poisson weight w_c with mean 1, drawn by inverting the 64-bit hash of (seed, c, b). The score of the replicate is
/// computed exactly from Σ_c w_c × (sums of cluster c). The bootstrap uses the same states as the jackknife. The interval depends only on the set of
/// samples, the seed and the number of replicates. Clusters are identified by name, or by bucket if contact points are
/// [hashed](crate::Clusters::Hashed). All contact points of a bucket share one weight.
///
/// # Reference
/// Hanley and MacGibbon, Creating non-parametric bootstrap samples using Poisson frequencies, Computer Methods and Programs in
/// Biomedicine 83 (2006); Efron and Tibshirani, An Introduction to the Bootstrap (1993), 13.3 for the percentiles.
///
/// ```
/// use taceva_metrics::{BootstrapEnds, PoissonBootstrap};
/// let bootstrap = PoissonBootstrap::DEFAULT.with_replicates(2000).with_ends(BootstrapEnds::Normal);
/// assert_eq!((bootstrap.replicates, bootstrap.seed), (2000, 0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PoissonBootstrap {
    /// Number of replicates; at least 39 for an interval.
    pub replicates: u32,
    /// Seed of the random weights of clusters.
    pub seed: u64,
    /// Method that computes the ends of the interval from the replicates.
    pub ends: BootstrapEnds,
}

impl Default for PoissonBootstrap {
    /// Bootstrap with 1,000 replicates, seed 0 and percentiles as ends.
    fn default() -> PoissonBootstrap {
        PoissonBootstrap::DEFAULT
    }
}

impl PoissonBootstrap {
    /// Bootstrap with 1,000 replicates, seed 0 and percentiles as ends.
    pub const DEFAULT: PoissonBootstrap = PoissonBootstrap {
        replicates: 1000,
        seed: 0,
        ends: BootstrapEnds::Percentile,
    };

    /// The same bootstrap with another [`replicates`](PoissonBootstrap::replicates).
    #[must_use]
    pub const fn with_replicates(self, replicates: u32) -> PoissonBootstrap {
        PoissonBootstrap { replicates, ..self }
    }

    /// The same bootstrap with another [`seed`](PoissonBootstrap::seed).
    #[must_use]
    pub const fn with_seed(self, seed: u64) -> PoissonBootstrap {
        PoissonBootstrap { seed, ..self }
    }

    /// The same bootstrap with another [`ends`](PoissonBootstrap::ends).
    #[must_use]
    pub const fn with_ends(self, ends: BootstrapEnds) -> PoissonBootstrap {
        PoissonBootstrap { ends, ..self }
    }
}

impl PoissonBootstrap {
    /// Interval of `estimated`, the score of all samples.
    ///
    /// `clusters` are the keys of the clusters with samples. `resampled` computes the score for given weights, one for each cluster.
    pub(crate) fn interval(
        &self,
        estimated: &Estimated,
        clusters: &[u64],
        mut resampled: impl FnMut(&[u32]) -> Result<f64, UndefinedReason>,
    ) -> Interval {
        if clusters.len() < LEAST_CLUSTERS {
            return Interval::Undefined(UndefinedReason::TooFewClusters {
                have: clusters.len(),
            });
        }
        let mut weights = vec![0; clusters.len()];
        let replicates = (0..self.replicates).filter_map(|replicate| {
            for (weight_here, &cluster) in weights.iter_mut().zip(clusters) {
                *weight_here = weight(bits(self.seed, cluster, replicate.into()));
            }
            resampled(&weights).ok()
        });
        let mut replicates: Vec<f64> = replicates.collect();
        let defined = replicates.len();
        let drawn = usize::try_from(self.replicates).expect("memory for one number each");
        if defined < LEAST_REPLICATES || drawn - defined > drawn / UNDEFINED_IN {
            return Interval::Undefined(UndefinedReason::TooFewReplicates { defined, drawn });
        }
        let standard_error = standard_deviation(&replicates);
        let freedom = clusters.iter().fold(-1.0, |freedom, _| freedom + 1.0);
        let carried = replicates
            .iter()
            .map(|replicate| estimated.carry(*replicate));
        let carried: Option<Vec<f64>> = carried.collect();
        let moved = Moved {
            standard_error,
            freedom,
            clusters: clusters.len(),
            carried: carried.map(|carried| [standard_deviation(&carried), freedom]),
        };
        // Percentiles do not depend on a scale, and replicates are in the range. If all replicates equal the value, `Estimated::ends` decides.
        let ends = match self.ends {
            BootstrapEnds::Percentile if standard_error > 0.0 => {
                Ok(estimated.within(percentiles(&mut replicates), Scale::Own, freedom))
            }
            _ => estimated.ends(&moved),
        };
        let Ends {
            low,
            high,
            scale,
            freedom,
        } = match ends {
            Ok(ends) => ends,
            Err(reason) => return Interval::Undefined(reason),
        };
        if !(low.is_finite() && high.is_finite() && standard_error.is_finite()) {
            return Interval::Undefined(UndefinedReason::Overflow);
        }
        Interval::Bootstrap {
            low,
            high,
            standard_error,
            freedom,
            scale,
            ends: self.ends,
            clusters: clusters.len(),
            replicates: drawn,
            seed: self.seed,
            undefined: drawn - defined,
            by: ClusteredBy::default(),
        }
    }
}

/// Lower and upper end of the middle 95 % of scores, from at least 39 replicates.
fn percentiles(replicates: &mut [f64]) -> [f64; 2] {
    replicates.sort_unstable_by(f64::total_cmp);
    let outside = (replicates.len() + 1) / 40;
    [
        replicates[outside - 1],
        replicates[replicates.len() - outside],
    ]
}

/// Sample standard deviation, summed in the given order.
fn standard_deviation(values: &[f64]) -> f64 {
    let count = values.iter().fold(0.0, |count, _| count + 1.0);
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|value| (value - mean) * (value - mean));
    (squares.sum::<f64>() / (count - 1.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::range::Range;

    const BOOTSTRAP: PoissonBootstrap = PoissonBootstrap {
        replicates: 1000,
        seed: 11,
        ends: BootstrapEnds::Normal,
    };

    fn about(value: f64) -> Estimated {
        Estimated {
            value,
            range: Range::Any,
            samples: 1000,
        }
    }

    /// Mean of the indices 0, 1, … of the clusters, weighted by `weights`.
    fn mean(weights: &[u32]) -> Result<f64, UndefinedReason> {
        let total: u32 = weights.iter().sum();
        let sum: u32 = (0..).zip(weights).map(|(at, weight)| at * weight).sum();
        if total == 0 {
            return Err(UndefinedReason::Empty);
        }
        Ok(f64::from(sum) / f64::from(total))
    }

    fn keys(clusters: u64) -> Vec<u64> {
        (0..clusters).collect()
    }

    #[test]
    fn the_standard_error_of_a_mean_is_the_textbook_s() {
        // 0…63: population variance (64² − 1) / 12, over 64 for the mean: √(341.25 / 64) = 2.309. A standard deviation of
        // 1,000 replicates is known to 2.2 %; three of those.
        let interval = BOOTSTRAP.interval(&about(31.5), &keys(64), mean);
        let Interval::Bootstrap { standard_error, .. } = interval else {
            panic!("64 clusters are enough: {interval:?}");
        };
        assert!(
            (standard_error / 2.309 - 1.0).abs() < 0.067,
            "{standard_error}"
        );
    }

    #[test]
    fn percentiles_are_the_25th_and_the_976th_of_a_thousand() {
        let mut replicates: Vec<f64> = (1..=1000).rev().map(f64::from).collect();
        assert_eq!(
            percentiles(&mut replicates).map(f64::to_bits),
            [25.0, 976.0].map(f64::to_bits)
        );
        let mut fewest: Vec<f64> = (1..=39).map(f64::from).collect();
        assert_eq!(
            percentiles(&mut fewest).map(f64::to_bits),
            [1.0, 39.0].map(f64::to_bits)
        );
    }

    #[test]
    fn a_cluster_s_weights_do_not_depend_on_the_others() {
        let mut seen = [Vec::new(), Vec::new()];
        for (seen, clusters) in seen
            .iter_mut()
            .zip([vec![4, 9, 2, 7, 1], vec![1, 3, 2, 9, 8, 5]])
        {
            let nine = clusters
                .iter()
                .position(|&key| key == 9)
                .expect("it is there");
            BOOTSTRAP.interval(&about(0.0), &clusters, |weights| {
                seen.push(weights[nine]);
                Ok(0.0)
            });
        }
        assert_eq!(seen[0], seen[1]);
    }

    #[test]
    fn more_than_one_undefined_replicate_in_twenty_leaves_no_interval() {
        let failing = |often: u32| {
            let mut asked = 0;
            BOOTSTRAP.interval(&about(0.0), &keys(5), move |_| {
                asked += 1;
                if asked <= often {
                    return Err(UndefinedReason::Empty);
                }
                Ok(f64::from(asked))
            })
        };
        assert!(matches!(
            failing(50),
            Interval::Bootstrap {
                undefined: 50,
                replicates: 1000,
                ..
            }
        ));
        let reason = UndefinedReason::TooFewReplicates {
            defined: 949,
            drawn: 1000,
        };
        assert_eq!(failing(51), Interval::Undefined(reason));
    }

    #[test]
    fn too_few_replicates_or_clusters_leave_no_interval() {
        let few = PoissonBootstrap {
            replicates: 38,
            ..BOOTSTRAP
        };
        assert_eq!(
            few.interval(&about(0.0), &keys(5), |_| Ok(0.0)),
            Interval::Undefined(UndefinedReason::TooFewReplicates {
                defined: 38,
                drawn: 38
            })
        );
        assert_eq!(
            BOOTSTRAP.interval(&about(0.0), &keys(4), |_| Ok(0.0)),
            Interval::Undefined(UndefinedReason::TooFewClusters { have: 4 })
        );
    }
}
