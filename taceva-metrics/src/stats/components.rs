//! Excess spread: standard deviation of bin means beyond chance, with a conservative interval. Samples may be correlated within a cluster.

use std::collections::BTreeMap;

use super::student::quantile;
use super::variance_ratio::paulson;
use crate::exact::moments::Moments;
use crate::score::least::LEAST_CLUSTERS;
use crate::score::value::UndefinedReason;
use crate::score::{COVERAGE, ClusteredBy, Interval};

/// Standard normal quantile with 2.5 % above it. The next three constants have 5 % / 2, 5 % / 4 and 5 % / 8 above them.
const TWO_SIDED: f64 = 1.959_963_984_540_054;
const HALVED: f64 = TWO_SIDED;
const QUARTERED: f64 = 2.241_402_727_604_947;
const EIGHTH: f64 = 2.497_705_474_412_382;
/// Assumed excess kurtosis of samples. The absolute value of a Gaussian error has 0.87; spreads that differ between places increase it.
const KURTOSIS: f64 = 1.5;
/// Least degrees of freedom of the noise with which an excess is shown. Paulson's approximation needs three, and tail probabilities need more.
const LEAST_FREEDOM: f64 = 6.0;
/// Number of bisection steps for an end of the interval.
const STEPS: usize = 100;

/// Number and mean of the samples of one cluster in one bin.
#[derive(Clone, Copy, Debug)]
struct Part {
    cluster: usize,
    n: f64,
    mean: f64,
}

/// Number of samples of a bin, and its parts. Each part has its sum of squared deviations and their degrees of freedom.
type SizedBin = (u64, Vec<(Part, f64, u64)>);

/// Bins of samples, each divided into the parts of its clusters.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClusteredBins {
    bins: Vec<Vec<Part>>,
    /// Sum of the squared deviations of samples from the mean of their cluster in their bin. The next field has the degrees of freedom of this sum.
    squares: f64,
    freedom: f64,
}

/// Excess spread: standard deviation of bin means beyond chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Excess {
    /// √max(0, variance of the bin means − variance expected by chance).
    pub(crate) value: f64,
    /// Ends of the 95 % interval of the excess spread.
    pub(crate) ends: [f64; 2],
    /// Standard normal score of the test that bin means vary only by chance; 0 if the interval starts at 0.
    above: f64,
    /// Mean of the bin means.
    pub(crate) mean: f64,
}

impl ClusteredBins {
    /// Divides the samples of `clusters` into bins, and keeps bins with at least `n_min` samples. The order of sums is fixed, so they are equal on
    /// every machine.
    pub(crate) fn of<'a, K: Ord + Copy + 'a>(
        clusters: impl IntoIterator<Item = impl IntoIterator<Item = (K, &'a Moments)>>,
        n_min: u64,
    ) -> Result<ClusteredBins, UndefinedReason> {
        let mut bins: BTreeMap<K, SizedBin> = BTreeMap::new();
        for (cluster, of_cluster) in clusters.into_iter().enumerate() {
            for (bin, moments) in of_cluster {
                let (Some(mean), Some(squares)) = (moments.mean(), moments.squared_deviations())
                else {
                    continue;
                };
                if !(mean.is_finite() && squares.is_finite()) {
                    return Err(UndefinedReason::Overflow);
                }
                let bin = bins.entry(bin).or_default();
                bin.0 = bin.0.saturating_add(moments.n);
                let part = Part {
                    cluster,
                    n: number(moments.n),
                    mean,
                };
                bin.1.push((part, squares, moments.n - 1));
            }
        }
        let mut kept = ClusteredBins::default();
        for (_, parts) in bins.into_values().filter(|(n, _)| *n >= n_min) {
            for (_, squares, freedom) in &parts {
                kept.squares += squares;
                kept.freedom += number(*freedom);
            }
            kept.bins
                .push(parts.into_iter().map(|part| part.0).collect());
        }
        Ok(kept)
    }

    /// Excess spread: standard deviation of the bin means beyond chance.
    ///
    /// The noise is the variance of bin means by chance. It follows from two variances, pooled over the bins: between the clusters of a bin, and
    /// within a cluster. A cluster in several bins shifts their means together, so this shared part does not count as noise. The interval inverts an
    /// F test of the ratio (variance of the means) / noise, in Paulson's approximation. The degrees of freedom are Satterthwaite's.
    ///
    /// # Reference
    /// Thomas and Hultquist, Annals of Statistics 6 (1978); Searle, Casella and McCulloch, Variance Components (1992), chapter 3; Paulson, Annals
    /// of Mathematical Statistics 13 (1942).
    pub(crate) fn excess(&self) -> Result<Excess, UndefinedReason> {
        let bins = number(count(self.bins.len()));
        let totals: Vec<(f64, f64)> = self
            .bins
            .iter()
            .map(|parts| {
                let n: f64 = parts.iter().map(|part| part.n).sum();
                let sum: f64 = parts.iter().map(|part| part.n * part.mean).sum();
                (n, sum / n)
            })
            .collect();
        let noise = self.noise(&totals)?;
        if self.bins.len() < 2 {
            return Err(UndefinedReason::TooFewBins {
                have: count(self.bins.len()),
                least: 2,
            });
        }
        let mean = totals.iter().map(|(_, mean)| mean).sum::<f64>() / bins;
        let squares: f64 = totals
            .iter()
            .map(|(_, of_bin)| (of_bin - mean) * (of_bin - mean))
            .sum();
        let variance = squares / (bins - 1.0);
        if !(variance.is_finite() && noise.variance.is_finite()) {
            return Err(UndefinedReason::Overflow);
        }
        if noise.variance <= 0.0 {
            // Without scatter within bins, the differences between them are exact.
            let value = variance.sqrt();
            return Ok(Excess {
                value,
                ends: [value; 2],
                above: if value > 0.0 { f64::INFINITY } else { 0.0 },
                mean,
            });
        }
        let ratio = variance / noise.variance;
        // Decreases as the true spread grows.
        let above = |spread: f64| {
            paulson(
                ratio / (1.0 + spread),
                noise.bins_with(spread),
                noise.freedom,
            )
        };
        let at = |wanted: f64| -> f64 {
            if above(0.0) <= wanted {
                return 0.0;
            }
            let mut high = 1.0;
            while above(high) > wanted && high < 1e300 {
                high *= 2.0;
            }
            let mut low = 0.0;
            for _ in 0..STEPS {
                let middle = (low + high) / 2.0;
                match above(middle) > wanted {
                    true => low = middle,
                    false => high = middle,
                }
            }
            (low + high) / 2.0
        };
        let value = (variance - noise.variance).max(0.0).sqrt();
        // With so few degrees of freedom of the noise, no excess is shown.
        let low = match noise.freedom >= LEAST_FREEDOM {
            true => (at(TWO_SIDED) * noise.variance).sqrt().min(value),
            false => 0.0,
        };
        let high = (at(-TWO_SIDED) * noise.variance).sqrt().max(value);
        Ok(Excess {
            value,
            ends: [low, high],
            above: if low > 0.0 { above(0.0) } else { 0.0 },
            mean,
        })
    }

    fn noise(&self, totals: &[(f64, f64)]) -> Result<Noise, UndefinedReason> {
        let bins = number(count(self.bins.len()));
        let (mut between, mut between_freedom, mut weight) = (0.0, 0.0, 0.0);
        let mut shares = Vec::with_capacity(self.bins.len());
        for (parts, (n, mean)) in self.bins.iter().zip(totals) {
            let squares: f64 = parts.iter().map(|part| part.n * part.n).sum();
            for part in parts {
                between += part.n * (part.mean - mean) * (part.mean - mean);
            }
            between_freedom += number(count(parts.len())) - 1.0;
            weight += n - squares / n;
            shares.push((squares / (n * n), 1.0 / n));
        }
        if between_freedom + self.freedom <= 0.0 {
            return Err(UndefinedReason::NoRepeats);
        }
        let within = match self.freedom > 0.0 {
            true => self.squares / self.freedom,
            false => 0.0,
        };
        let (mut of_cluster, of_sample) = (0.0, within);
        let mut freedom = self.freedom;
        if between_freedom > 0.0 {
            let size = weight / between_freedom;
            let mean_square = between / between_freedom;
            of_cluster = (mean_square - within).max(0.0) / size;
            // At least the variance within clusters, so that few clusters always limit the degrees of freedom.
            let mean_square = mean_square.max(within);
            let alpha = shares.iter().map(|share| share.0).sum::<f64>() / bins / size;
            let beta = shares.iter().map(|share| share.1).sum::<f64>() / bins - alpha;
            let (one, other) = (alpha * mean_square, beta * within);
            let parts = [(one, between_freedom), (other, self.freedom)];
            let parts = parts.into_iter().filter(|(_, freedom)| *freedom > 0.0);
            let spread: f64 = parts.map(|(part, freedom)| part * part / freedom).sum();
            if spread > 0.0 {
                freedom = (one + other) * (one + other) / spread;
            }
        }
        let of_bins: Vec<f64> = shares
            .iter()
            .map(|(clusters, samples)| of_cluster * clusters + of_sample * samples)
            .collect();
        let sum: f64 = of_bins.iter().sum();
        let squares: f64 = of_bins.iter().map(|variance| variance * variance).sum();
        let kurtosis: f64 = of_bins
            .iter()
            .zip(&shares)
            .map(|(variance, (clusters, samples))| {
                let worth = if of_cluster > 0.0 { clusters } else { samples };
                variance * variance * worth
            })
            .sum();
        if sum <= 0.0 {
            return Ok(Noise {
                variance: 0.0,
                bins,
                sum,
                squares,
                freedom,
            });
        }
        let shared = self.shared(totals, of_cluster);
        let heavy = 1.0 + KURTOSIS / 2.0;
        Ok(Noise {
            variance: (sum / bins - shared).max(0.0),
            bins,
            sum,
            squares: squares + KURTOSIS / 2.0 * kurtosis,
            freedom: (freedom / heavy).max(1.0),
        })
    }

    /// Covariance of two bin means from clusters that both bins share, as a mean over all pairs of bins.
    fn shared(&self, totals: &[(f64, f64)], of_cluster: f64) -> f64 {
        let clusters = self.bins.iter().flatten().map(|part| part.cluster + 1);
        let clusters = clusters.max().unwrap_or_default();
        let size = self.bins.len();
        if of_cluster <= 0.0 || clusters == 0 {
            return 0.0;
        }
        // Bins of each cluster, with the cluster's share of the samples and its distance from the mean of the bin.
        let mut of_clusters: Vec<Vec<(usize, f64, Option<f64>)>> = vec![Vec::new(); clusters];
        for (bin, (parts, (n, mean))) in self.bins.iter().zip(totals).enumerate() {
            for part in parts {
                let residual = (parts.len() > 1).then_some(part.mean - mean);
                of_clusters[part.cluster].push((bin, part.n / n, residual));
            }
        }
        let mut overlaps = vec![0.0; size * size];
        let pairs_of = |bins: &[(usize, f64, Option<f64>)]| {
            let pairs = bins.iter().enumerate();
            let pairs =
                pairs.flat_map(|(at, one)| bins[at + 1..].iter().map(|other| (*one, *other)));
            pairs.collect::<Vec<_>>()
        };
        let mut together = 0.0;
        for (one, other) in of_clusters.iter().flat_map(|bins| pairs_of(bins)) {
            let overlap = one.1 * other.1;
            overlaps[one.0 * size + other.0] += overlap;
            together += overlap;
        }
        let (mut products, mut expected) = (0.0, 0.0);
        for (one, other) in of_clusters.iter().flat_map(|bins| pairs_of(bins)) {
            if let (Some(left), Some(right)) = (one.2, other.2) {
                products += left * right;
                expected += 1.0 - one.1 - other.1 + overlaps[one.0 * size + other.0];
            }
        }
        if expected <= 0.0 {
            return 0.0;
        }
        let component = (products / expected).clamp(0.0, of_cluster);
        let pairs = number(count(size)) * (number(count(size)) - 1.0) / 2.0;
        component * together / pairs
    }
}

/// Variance of the bin means by chance, with the sums for its degrees of freedom.
#[derive(Clone, Copy, Debug)]
struct Noise {
    variance: f64,
    /// Number of bins.
    bins: f64,
    /// Sum over the bins of the variance of a bin mean by chance. The next field is the sum of the squares of these variances, with a term for heavy
    /// tails.
    sum: f64,
    squares: f64,
    /// Degrees of freedom of the variance by chance.
    freedom: f64,
}

impl Noise {
    /// Degrees of freedom of the observed variance of bin means, if the true variance between bins is `spread` times the variance by chance.
    fn bins_with(&self, spread: f64) -> f64 {
        let true_variance = spread * self.variance;
        let sum = self.sum + self.bins * true_variance;
        let squares = self.squares
            + 2.0 * true_variance * self.sum
            + self.bins * true_variance * true_variance;
        (self.bins - 1.0) / self.bins * sum * sum / squares
    }
}

impl Excess {
    /// Mean of several excesses, such as those over distance and over depth; `None` for an empty list. If the true bin means are equal, the interval
    /// starts above 0 in at most 5 % of cases.
    pub(crate) fn mean_of(all: &[Excess]) -> Option<Excess> {
        let first = all.first()?;
        if all.len() == 1 {
            return Some(*first);
        }
        let parts = number(count(all.len()));
        let value = all.iter().map(|one| one.value).sum::<f64>() / parts;
        let mean = all.iter().map(|one| one.mean).sum::<f64>() / parts;
        let distance = |of: &dyn Fn(&Excess) -> f64| {
            let squares: f64 = all.iter().map(|one| of(one) * of(one)).sum();
            squares.sqrt() / parts
        };
        let high = value + distance(&|one| one.ends[1] - one.value);
        let wanted = match all.len() {
            2 => HALVED,
            3 | 4 => QUARTERED,
            _ => EIGHTH,
        };
        let shown = all.iter().filter(|one| one.above > wanted);
        let least = shown.map(|one| one.ends[0] / parts).reduce(f64::max);
        let low = least.map_or(0.0, |least| {
            (value - distance(&|one| one.value - one.ends[0])).max(least)
        });
        Some(Excess {
            value,
            ends: [low.min(value), high],
            above: match least {
                Some(_) => f64::INFINITY,
                None => 0.0,
            },
            mean,
        })
    }

    /// Interval of a score with these ends.
    pub(crate) fn interval([low, high]: [f64; 2], clusters: usize) -> Interval {
        if clusters < LEAST_CLUSTERS {
            return Interval::Undefined(UndefinedReason::TooFewClusters { have: clusters });
        }
        let freedom = number(count(clusters)) - 1.0;
        Interval::Components {
            low,
            high,
            standard_error: (high - low) / 2.0 / quantile(COVERAGE, freedom),
            freedom,
            clusters,
            by: ClusteredBy::default(),
        }
    }
}

fn count(of: usize) -> u64 {
    u64::try_from(of).unwrap_or(u64::MAX)
}

fn number(count: u64) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests;
