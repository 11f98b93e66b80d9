//! Ratios of mean errors with a fault to mean errors without the fault, and their intervals.

use std::collections::BTreeMap;

use taceva_metrics::distributions::student_t;
use taceva_metrics::elementary::exponential;
use taceva_metrics::{ClusterSum, ClusterSums, LEAST_CLUSTERS};

use crate::estimate::{Estimate, Undefined};

/// Share of Student's t distribution below the upper end of a 95 % interval.
pub(crate) const UPPER: f64 = 0.975;

/// Absolute errors of predicted rows, summed by cluster (by default the samples of one contact point).
#[derive(Clone, Debug)]
pub(crate) struct Errors {
    total: f64,
    count: u64,
    /// Sum and number of the errors of each cluster; `None` if a row has no cluster.
    clusters: Option<Vec<Cluster>>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Cluster {
    sum: f64,
    count: u64,
}

impl Errors {
    /// Sums of `errors` by the cluster of each row; rows without an error do not count.
    pub(crate) fn of(errors: &[Option<f64>], clusters: Option<&[String]>) -> Errors {
        let known: Vec<f64> = errors.iter().copied().flatten().collect();
        let by_name = clusters.map(|names| {
            let mut sums: BTreeMap<&str, Cluster> = BTreeMap::new();
            for (error, name) in errors.iter().zip(names) {
                if let Some(error) = error {
                    let own = sums.entry(name).or_default();
                    own.sum += error;
                    own.count += 1;
                }
            }
            sums.into_values().collect()
        });
        Errors {
            total: known.iter().sum(),
            count: known.len() as u64,
            clusters: by_name,
        }
    }

    /// Number of rows with an error.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// Number of clusters; `None` if a row has no cluster.
    pub(crate) fn clusters(&self) -> Option<usize> {
        self.clusters.as_ref().map(Vec::len)
    }

    /// Mean absolute error over all rows with an error; `None` for no errors.
    pub(crate) fn mean(&self) -> Option<f64> {
        (self.count > 0).then_some(self.total / self.count as f64)
    }

    /// Inverse share of each cluster: the number of all errors divided by the number of errors in the cluster. Empty if a row has no cluster.
    pub(crate) fn sizes(&self) -> Vec<f64> {
        let clusters = self.clusters.iter().flatten();
        clusters
            .map(|own| self.count as f64 / own.count as f64)
            .collect()
    }

    /// Mean absolute error over all rows except those of the cluster with the index `left`.
    pub(crate) fn mean_without(&self, left: usize) -> f64 {
        let clusters = self.clusters.as_deref().unwrap_or_default();
        let own = clusters[left];
        (self.total - own.sum) / (self.count - own.count) as f64
    }

    /// Errors of `cells`, as a mean over the cells, minus the errors of `self`, summed by cluster. `None` if a cluster is unknown or has other
    /// samples in a cell, or if a sum is not finite.
    pub(crate) fn added_by(&self, cells: &[&Errors]) -> Option<ClusterSums> {
        let own = self.clusters.iter().flatten().enumerate();
        let sums = own.map(|(at, clean)| {
            let mut added = 0.0;
            for cell in cells {
                let with = cell.clusters.as_deref()?.get(at)?;
                if with.count != clean.count {
                    return None;
                }
                added += with.sum - clean.sum;
            }
            let added = added / cells.len() as f64;
            let mut sum = ClusterSum::default();
            sum.n = clean.count;
            sum.sum.add(added.is_finite().then_some(added)?);
            Some((format!("{at:09}"), sum))
        });
        sums.collect()
    }

    /// Relative change of the mean error if the cluster with the index `left` is left out.
    fn change(&self, left: usize) -> f64 {
        self.mean_without(left) / (self.total / self.count as f64) - 1.0
    }
}

/// Mean over `cells` of the ratio of the mean error in a cell to the mean error without a fault.
///
/// To first order its logarithm changes by Σ r_c (δ_c − δ_0) / Σ r_c. Here r_c is the ratio of cell c. δ_c is the relative change of the mean error
/// in cell c, and δ_0 that of the mean error without a fault. A cluster is left out of every cell and of the clean errors at once, because all errors
/// are of the same samples.
///
/// # Reference
/// Busing, Meijer and van der Leeden, Delete-m jackknife for unequal m, Statistics and Computing 9 (1999).
pub(crate) fn mean_ratio<'a>(
    cells: impl IntoIterator<Item = Share<'a>>,
    clean: &Errors,
) -> Estimate {
    let Some(baseline) = clean.mean() else {
        return Estimate::undefined(Undefined::Empty);
    };
    if baseline <= 0.0 {
        return Estimate::undefined(Undefined::ZeroBaseline);
    }
    let terms: Vec<Term<'a>> = cells
        .into_iter()
        .filter_map(|cell| {
            Some(Term {
                part: cell.share * (cell.errors.mean()? / baseline),
                errors: cell.errors,
            })
        })
        .collect();
    if terms.is_empty() {
        return Estimate::undefined(Undefined::NoSeverity);
    }
    let value: f64 = terms.iter().map(|term| term.part).sum();
    Estimate::new(value, interval(value, &terms, clean))
}

/// Errors of a cell, and the weight of the cell in a mean.
#[derive(Clone, Copy)]
pub(crate) struct Share<'a> {
    pub(crate) errors: &'a Errors,
    pub(crate) share: f64,
}

/// Contribution of a cell to a weighted mean of ratios.
struct Term<'a> {
    part: f64,
    errors: &'a Errors,
}

fn interval(value: f64, terms: &[Term<'_>], clean: &Errors) -> Result<[f64; 2], Undefined> {
    let clusters = clean.clusters.as_deref().ok_or(Undefined::NoClusters)?;
    if clusters.len() < LEAST_CLUSTERS {
        return Err(Undefined::TooFewClusters);
    }
    let is_alike = |term: &Term<'_>| term.errors.clusters() == Some(clusters.len());
    if !terms.iter().all(is_alike) {
        return Err(Undefined::NoInterval);
    }
    let count = clusters.len() as f64;
    let moved = |left: usize| {
        let baseline = clean.change(left);
        let moves = terms
            .iter()
            .map(|term| term.part / value * (term.errors.change(left) - baseline));
        moves.sum::<f64>()
    };
    let sizes = clean.sizes().into_iter();
    let pseudo: Vec<[f64; 2]> = sizes
        .enumerate()
        .map(|(left, share)| [share - 1.0, (1.0 - share) * moved(left)])
        .collect();
    let mean = pseudo.iter().map(|[_, value]| value).sum::<f64>() / count;
    let squares = pseudo
        .iter()
        .map(|[weight, value]| (value - mean) * (value - mean) / weight);
    let variance = squares.sum::<f64>() / count;
    let half = student_t::quantile(UPPER, count - 1.0) * variance.sqrt();
    let ends = [value * exponential(-half), value * exponential(half)];
    match ends.iter().all(|end| end.is_finite() && *end > 0.0) {
        true => Ok(ends),
        false => Err(Undefined::NoInterval),
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::random::{SplitMix64, open_unit};

    use super::*;

    fn errors(of: impl Fn(u32) -> f64) -> Errors {
        let names: Vec<String> = (0..30).map(|row| format!("p{}", row / 5)).collect();
        let errors: Vec<Option<f64>> = (0..30).map(|row| Some(of(row))).collect();
        Errors::of(&errors, Some(&names))
    }

    fn ratio(of: &Errors, clean: &Errors) -> Estimate {
        let cell = Share {
            errors: of,
            share: 1.0,
        };
        mean_ratio([cell], clean)
    }

    #[test]
    fn equal_errors_have_a_ratio_of_exactly_one_without_width() {
        let clean = errors(|row| 0.1 + f64::from(row % 7));
        let found = ratio(&clean, &clean);
        assert_eq!((found.value, found.ci95), (Some(1.0), Some([1.0, 1.0])));
    }

    #[test]
    fn a_common_factor_is_the_ratio_and_other_errors_widen_it() {
        let clean = errors(|row| 1.0 + f64::from(row % 3));
        let found = ratio(&errors(|row| 4.0 + 4.0 * f64::from(row % 3)), &clean);
        assert_eq!(found.value, Some(4.0));
        let [low, high] = found.ci95.expect("six clusters");
        assert!((low - 4.0).abs() < 1e-12 && (high - 4.0).abs() < 1e-12);
        let found = ratio(&errors(|row| 1.0 + f64::from(row / 5)), &clean);
        let [low, high] = found.ci95.expect("six clusters");
        let value = found.value.expect("a ratio");
        assert!(low < 0.8 * value && value < 0.8 * high, "{found:?}");
    }

    #[test]
    fn the_mean_of_equal_cells_is_one_cell_and_opposite_cells_have_a_narrower_interval() {
        let clean = errors(|_| 2.0);
        let rising = errors(|row| 2.0 + f64::from(row / 5));
        let falling = errors(|row| 7.0 - f64::from(row / 5));
        let mean = |cells: [&Errors; 2]| {
            let shares = cells.map(|errors| Share { errors, share: 0.5 });
            mean_ratio(shares, &clean)
        };
        assert_eq!(mean([&rising, &rising]), ratio(&rising, &clean));
        // A contact point with a large error in one cell has a small error in the other, and is left out of both.
        let width = |of: Estimate| of.ci95.map(|[low, high]| high - low).expect("six clusters");
        let both = width(mean([&rising, &falling]));
        assert!(both < 0.1 * width(ratio(&rising, &clean)), "{both}");
    }

    #[test]
    fn a_perfect_model_has_no_ratio_and_few_clusters_no_interval() {
        let found = ratio(&errors(|_| 1.0), &errors(|_| 0.0));
        assert_eq!(found, Estimate::undefined(Undefined::ZeroBaseline));
        let unnamed = Errors::of(&[Some(1.0), Some(3.0), None], None);
        let found = ratio(&unnamed, &unnamed);
        let expected = (Some(1.0), None, Some(Undefined::NoClusters));
        assert_eq!((found.value, found.ci95, found.reason), expected);
        let names = ["a", "b", "b"].map(str::to_owned);
        let two = Errors::of(&[Some(1.0), Some(3.0), None], Some(&names));
        assert_eq!(ratio(&two, &two).reason, Some(Undefined::TooFewClusters));
    }

    /// A number of the standard normal distribution.
    fn normal(random: &mut SplitMix64) -> f64 {
        let radius = (-2.0 * open_unit(random.next_u64()).ln()).sqrt();
        radius * (std::f64::consts::TAU * open_unit(random.next_u64())).cos()
    }

    /// Simulates `clusters` contact points with five samples each. True if the interval of the ratio contains the true ratio `truth`. Errors of a
    /// sample with and without the fault are correlated, and a contact point has large errors or small ones.
    fn is_covered(random: &mut SplitMix64, clusters: u32, truth: f64) -> bool {
        let (mut clean, mut faulty, mut names) = (Vec::new(), Vec::new(), Vec::new());
        for cluster in 0..clusters {
            let size = (0.5 * normal(random)).exp();
            for _ in 0..5 {
                let (one, other) = (normal(random), normal(random));
                clean.push(Some(one.abs() * size));
                faulty.push(Some(truth * (0.8 * one + 0.6 * other).abs() * size));
                names.push(format!("p{cluster}"));
            }
        }
        let [clean, faulty] = [clean, faulty].map(|of| Errors::of(&of, Some(&names)));
        let [low, high] = ratio(&faulty, &clean).ci95.expect("enough clusters");
        (low..=high).contains(&truth)
    }

    #[test]
    fn intervals_contain_the_true_ratio_of_simulated_predictors_in_93_to_97_of_100_cases() {
        for (clusters, truth) in [(12, 3.0), (20, 2.0)] {
            let mut random = SplitMix64::new(1);
            let covered = (0..2000).filter(|_| is_covered(&mut random, clusters, truth));
            let share = covered.count() as f64 / 2000.0;
            assert!((0.93..=0.97).contains(&share), "{clusters}: {share}");
        }
    }
}
