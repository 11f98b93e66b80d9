//! Delete-one-cluster jackknife: variation of a score between contact points.

use super::ends::{Ends, Estimated, Moved};
use crate::count::as_f64;
use crate::score::least::LEAST_CLUSTERS;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;
use crate::score::{ClusteredBy, Interval};

/// Least degrees of freedom of a variance from few clusters. If one cluster causes all of the variance, fewer degrees would widen the
/// interval several times without improving its coverage.
const LEAST_FREEDOM: f64 = 3.0;

/// Score with one cluster left out.
///
/// ```
/// use taceva_metrics::LeftOut;
/// let without = LeftOut::new(25, Ok(0.8));
/// assert_eq!((without.count, without.value), (25, Ok(0.8)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LeftOut {
    /// Number of samples of the left-out cluster, at least one.
    pub count: u64,
    /// Score of all other clusters.
    pub value: Result<f64, UndefinedReason>,
}

impl LeftOut {
    /// Score `value` of all clusters except a cluster that has `count` samples.
    #[must_use]
    pub fn new(count: u64, value: Result<f64, UndefinedReason>) -> LeftOut {
        LeftOut { count, value }
    }
}

impl Interval {
    /// Interval of `value`, the score of all clusters, by the delete-one-cluster jackknife.
    ///
    /// `left_out` has an entry for each cluster. Fewer than [`LEAST_CLUSTERS`] clusters give no interval.
    ///
    /// ```
    /// use taceva_metrics::{ClusteredBy, Interval, LeftOut, Range};
    /// let left_out = [0.62, 0.58, 0.60, 0.61, 0.59].map(|share| LeftOut::new(10, Ok(share)));
    /// let interval = Interval::jackknife(0.6, Range::Ratio, &left_out, ClusteredBy::Group);
    /// let [low, high] = interval.ends().ok_or("five clusters")?;
    /// assert!(0.5 < low && low < 0.6 && 0.6 < high && high < 0.7);
    /// assert_eq!(interval.method().as_deref(), Some("jackknife by group, G=5, logit"));
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn jackknife(value: f64, range: Range, left_out: &[LeftOut], by: ClusteredBy) -> Interval {
        interval(value, range, left_out).clustered_by(by)
    }
}

/// Interval of `value` from the scores in `left_out`, each without one cluster.
pub(crate) fn interval(value: f64, range: Range, left_out: &[LeftOut]) -> Interval {
    let counts = left_out.iter().map(|cluster| cluster.count);
    let estimated = Estimated {
        value,
        range,
        samples: counts.fold(0, u64::saturating_add),
    };
    let moved = match moved(value, left_out) {
        Ok(moved) => Moved {
            carried: carried(&estimated, left_out),
            ..moved
        },
        Err(reason) => return Interval::Undefined(reason),
    };
    match estimated.ends(&moved) {
        Ok(Ends {
            low,
            high,
            scale,
            freedom,
        }) => Interval::Jackknife {
            low,
            high,
            standard_error: moved.standard_error,
            freedom,
            clusters: moved.clusters,
            scale,
            by: ClusteredBy::default(),
        },
        Err(reason) => Interval::Undefined(reason),
    }
}

/// Standard error and degrees of freedom of the jackknife on the unbounded scale of the score. This scale is the logarithm of odds, or of the
/// distance to a finite end of the range. `None` if the score without one of the clusters has no value on this scale, or the jackknife is undefined.
///
/// A score of few clusters has a skewed distribution, because one cluster may have large errors. The standard error then depends on the score itself.
/// On the unbounded scale the standard error does not (`docs/coverage.md`).
fn carried(estimated: &Estimated, left_out: &[LeftOut]) -> Option<[f64; 2]> {
    let carry = |cluster: &LeftOut| {
        let value = estimated.carry(cluster.value.ok()?)?;
        Some(LeftOut {
            value: Ok(value),
            ..*cluster
        })
    };
    let carried: Vec<LeftOut> = left_out.iter().map(carry).collect::<Option<_>>()?;
    let moved = moved(0.0, &carried).ok()?;
    Some([moved.standard_error, moved.freedom])
}

/// Standard error of `value`, the score of all clusters, in its unit.
pub(crate) fn standard_error(value: f64, left_out: &[LeftOut]) -> Result<f64, UndefinedReason> {
    moved(value, left_out).map(|moved| moved.standard_error)
}

/// Standard error of `value`, the score of all clusters, and its degrees of freedom.
///
/// Let the g clusters have n samples, m_j of them in cluster j, and h_j = n / m_j. From the score θ and the score θ_(−j) without cluster j follows
/// the pseudo-value h_j θ − (h_j − 1) θ_(−j). The variance is the mean over the clusters of z_j² = (pseudo-value − mean pseudo-value)² / (h_j − 1).
///
/// A variance from few clusters is itself uncertain. With κ = mean(z⁴) / mean(z²)² the variance has 2 g / (κ − (g − 3)/(g − 1)) degrees of freedom.
/// Normal pseudo-values have κ = 3, which gives g − 1 degrees. The number is at most g − 1 and at least [`LEAST_FREEDOM`].
///
/// # Reference
/// Busing, Meijer and van der Leeden, Delete-m jackknife for unequal m, Statistics and Computing 9 (1999); Satterthwaite,
/// An approximate distribution of estimates of variance components, Biometrics Bulletin 2 (1946), with the variance of a
/// variance of g numbers.
fn moved(value: f64, left_out: &[LeftOut]) -> Result<Moved, UndefinedReason> {
    let clusters = left_out.len();
    if clusters < LEAST_CLUSTERS {
        return Err(UndefinedReason::TooFewClusters { have: clusters });
    }
    let counts = left_out.iter().map(|cluster| cluster.count);
    let n = as_f64(counts.fold(0, u64::saturating_add));
    let mut pseudo_values = Vec::with_capacity(clusters);
    for cluster in left_out {
        let share = n / as_f64(cluster.count);
        pseudo_values.push((share, share * value - (share - 1.0) * cluster.value?));
    }
    let g = pseudo_values.iter().fold(0.0, |g, _| g + 1.0);
    let mean = pseudo_values.iter().map(|(_, pseudo)| pseudo).sum::<f64>() / g;
    let squares = pseudo_values
        .iter()
        .map(|(share, pseudo)| (pseudo - mean) * (pseudo - mean) / (share - 1.0));
    let squares: Vec<f64> = squares.collect();
    let variance = squares.iter().sum::<f64>() / g;
    let standard_error = variance.sqrt();
    if !standard_error.is_finite() {
        return Err(UndefinedReason::Overflow);
    }
    let freedom = if variance > 0.0 {
        let relative = squares.iter().map(|square| square / variance);
        let kurtosis = relative.map(|square| square * square).sum::<f64>() / g;
        let satterthwaite = 2.0 * g / (kurtosis - (g - 3.0) / (g - 1.0));
        if satterthwaite > 0.0 {
            satterthwaite.clamp(LEAST_FREEDOM, g - 1.0)
        } else {
            g - 1.0
        }
    } else {
        g - 1.0
    };
    Ok(Moved {
        standard_error,
        freedom,
        clusters,
        carried: None,
    })
}

/// Interval about `value` with its delta-method `variance` over a number of `clusters`.
pub(crate) fn delta_interval(value: f64, range: Range, variance: f64, clusters: usize) -> Interval {
    let freedom = u32::try_from(clusters.saturating_sub(1)).expect("at most 64 clusters");
    let moved = Moved {
        standard_error: variance.sqrt(),
        freedom: f64::from(freedom),
        clusters,
        carried: None,
    };
    let estimated = Estimated {
        value,
        range,
        samples: 0,
    };
    match estimated.ends(&moved) {
        Ok(Ends {
            low,
            high,
            scale,
            freedom,
        }) => Interval::Delta {
            low,
            high,
            standard_error: moved.standard_error,
            freedom,
            clusters,
            scale,
            by: ClusteredBy::default(),
        },
        Err(reason) => Interval::Undefined(reason),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of all values, and for each cluster the mean of the values outside it.
    fn means(clusters: &[&[f64]]) -> (f64, Vec<LeftOut>) {
        let all: Vec<f64> = clusters.concat();
        let mean = |sum: f64, n: usize| sum / as_f64(n as u64);
        let total: f64 = all.iter().sum();
        let left_out = clusters.iter().map(|cluster| LeftOut {
            count: cluster.len() as u64,
            value: Ok(mean(
                total - cluster.iter().sum::<f64>(),
                all.len() - cluster.len(),
            )),
        });
        (mean(total, all.len()), left_out.collect())
    }

    #[test]
    fn clusters_of_one_give_the_textbook_interval_of_a_mean() {
        // Mean 3, standard error √(2.5 / 5) = √0.5, t(4) = 2.776445105.
        let (mean, left_out) = means(&[&[1.0], &[2.0], &[3.0], &[4.0], &[5.0]]);
        let Interval::Jackknife {
            low,
            high,
            clusters,
            ..
        } = interval(mean, Range::Any, &left_out)
        else {
            panic!("five clusters are enough");
        };
        let half = 2.776_445_105 * 0.5_f64.sqrt();
        assert_eq!(clusters, 5);
        assert!((low - (3.0 - half)).abs() < 1e-8 && (high - (3.0 + half)).abs() < 1e-8);
    }

    #[test]
    fn an_error_is_left_out_on_the_scale_of_its_logarithm() {
        // Scores r², r, 1, 1/r and 1/r² times 4 without each of five clusters of one sample, 4 with all, r = 0.9: the logarithms are 0,
        // ±ln r and ±2 ln r, so the pseudo-values are four times those, and the standard error is 4 |ln r| √(10/4/5).
        let left_out = [0.81, 0.9, 1.0, 1.0 / 0.9, 1.0 / 0.81].map(|ratio| LeftOut {
            count: 1,
            value: Ok(4.0 * ratio),
        });
        let found = interval(4.0, Range::Positive, &left_out).ends();
        let [low, high] = found.expect("five clusters are enough");
        let step = 2.776_445_105 * 4.0 * -0.9_f64.ln() * 0.5_f64.sqrt();
        assert!((low / 4.0 / (-step).exp() - 1.0).abs() < 1e-8, "{low}");
        assert!((high / 4.0 / step.exp() - 1.0).abs() < 1e-8, "{high}");
    }

    #[test]
    fn one_cluster_that_makes_all_of_an_error_leaves_a_finite_interval() {
        // Nine of ten locations have almost no error: the rest without the tenth is zero or nearly zero.
        let ends = |rest: f64| {
            let of_others = (0..9).map(|_| 1e-6 * 10.0 / 9.0);
            let left_out = of_others.chain([rest]).map(|left| LeftOut {
                count: 1,
                value: Ok(1.0 - left),
            });
            let left_out: Vec<LeftOut> = left_out.collect();
            let ends = interval(1.0 - 1e-6, Range::BelowOne, &left_out).ends();
            ends.expect("ten clusters are enough")
        };
        let [low, high] = ends(0.0);
        assert!(0.999 < low && low < high && high < 1.0, "{low} {high}");
        assert!((ends(1e-12)[0] - low).abs() < 1e-6);
    }

    #[test]
    fn unequal_clusters_agree_with_a_calculation_by_hand() {
        // n = 6, θ = 16/6. Left out: 13/4 = 3.25 (m = 2, h = 3), 13/5, 12/5, 11/5, 15/5 (m = 1, h = 6).
        // Pseudo-values: 1.5, 3, 4, 5, 1; mean 2.9; squared deviations 1.96, .01, 1.21, 4.41, 3.61.
        // Variance: (1.96/2 + (.01 + 1.21 + 4.41 + 3.61)/5) / 5 = (.98 + 1.848) / 5 = .5656.
        let (mean, left_out) = means(&[&[1.0, 2.0], &[3.0], &[4.0], &[5.0], &[1.0]]);
        let Interval::Jackknife { low, high, .. } = interval(mean, Range::Any, &left_out) else {
            panic!("five clusters are enough");
        };
        let half = 2.776_445_105 * 0.5656_f64.sqrt();
        assert!((low - (16.0 / 6.0 - half)).abs() < 1e-8);
        assert!((high - (16.0 / 6.0 + half)).abs() < 1e-8);
    }

    #[test]
    fn four_clusters_are_too_few() {
        let (mean, left_out) = means(&[&[1.0], &[2.0], &[3.0], &[4.0]]);
        assert_eq!(
            interval(mean, Range::Any, &left_out),
            Interval::Undefined(UndefinedReason::TooFewClusters { have: 4 })
        );
    }

    #[test]
    fn a_score_that_hangs_on_one_cluster_has_no_interval() {
        let (mean, mut left_out) = means(&[&[1.0], &[2.0], &[3.0], &[4.0], &[5.0]]);
        left_out[2].value = Err(UndefinedReason::ConstantTruth { perfect: false });
        assert_eq!(
            interval(mean, Range::Any, &left_out),
            Interval::Undefined(UndefinedReason::ConstantTruth { perfect: false })
        );
    }
}
