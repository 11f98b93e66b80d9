//! Bland–Altman limits of agreement between two methods that measure the same quantity.
//!
//! ```
//! use taceva_metrology::agreement::{Agreement, Pair};
//! let pairs = [[1.0, 1.1], [2.0, 1.9], [3.0, 3.2], [4.0, 4.1]].map(|[one, other]| Pair::new(one, other));
//! let found = Agreement::of(&pairs).ok_or("four pairs")?;
//! assert_eq!(found.n, 4);
//! assert!((found.bias + 0.075).abs() < 1e-15);
//! assert!(found.limits[0] < found.bias && found.bias < found.limits[1]);
//! # Ok::<(), &str>(())
//! ```
//!
//! # Reference
//! Bland and Altman, Lancet 327 (1986); Carkeet, Optometry and Vision Science 92 (2015), exact intervals; Satterthwaite, Biometrics Bulletin 2
//! (1946), clusters.

use serde::{Deserialize, Serialize};
pub use taceva_metrics::Proportional;
use taceva_metrics::{DifferenceLine, Moments, NormalSample, OneWaySums};

/// Two measurements of one quantity in one unit.
///
/// ```
/// use taceva_metrology::agreement::Pair;
/// assert_eq!(Pair::new(3.0, 1.0).one, 3.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Pair {
    /// Value of the first method.
    pub one: f64,
    /// Value of the second method.
    pub other: f64,
}

impl Pair {
    /// Pairs the values of the first and the second method.
    #[must_use]
    pub fn new(one: f64, other: f64) -> Pair {
        Pair { one, other }
    }
}

/// Bias and limits of agreement of the first method minus the second, in the unit of the pairs.
///
/// ```
/// use taceva_metrology::agreement::{Agreement, Pair};
/// assert_eq!(Agreement::of(&[Pair::new(1.0, 2.0)]), None);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Agreement {
    /// Number of pairs.
    pub n: u64,
    /// Number of clusters; `None` for independent pairs.
    pub clusters: Option<u64>,
    /// Mean difference over all pairs, first method minus second.
    pub bias: f64,
    /// 95 % confidence interval of the bias.
    pub bias_ci95: [f64; 2],
    /// Standard deviation of the differences.
    pub sd: f64,
    /// Degrees of freedom of the standard deviation.
    pub freedom: f64,
    /// Limits of agreement, within which 95 % of differences are expected: bias ± 1.96 standard deviations.
    pub limits: [f64; 2],
    /// 95 % confidence interval of the lower limit.
    pub lower_ci95: [f64; 2],
    /// 95 % confidence interval of the upper limit.
    pub upper_ci95: [f64; 2],
    /// Trend of the difference with the mean of the pair; `None` for clustered pairs, or if all means are equal.
    pub proportional: Option<Proportional>,
}

impl Agreement {
    /// Agreement of independent pairs; `None` for fewer than two pairs or a value that is not finite.
    #[must_use]
    pub fn of(pairs: &[Pair]) -> Option<Agreement> {
        let differences = differences(pairs)?;
        let mut line = DifferenceLine::default();
        for pair in pairs {
            line.add(pair.one, pair.other);
        }
        let sample = NormalSample::of_independent(&differences)?;
        Some(Agreement {
            proportional: line.proportional(&differences),
            ..Agreement::of_sample(differences.n, &sample)
        })
    }

    /// Agreement of clustered pairs. Differences may be correlated within a cluster.
    ///
    /// The standard deviation includes the variance between and within clusters, with degrees of freedom by Satterthwaite. Interval ends are
    /// therefore approximate, and too narrow if clusters differ in spread.
    ///
    /// `None` for fewer than two clusters, no cluster with two pairs, a value that is not finite, or no variation.
    ///
    /// ```
    /// use taceva_metrology::agreement::{Agreement, Pair};
    /// let cluster = |shift: f64| [0.0, 0.1, 0.2].map(|noise| Pair::new(shift + noise, 0.0));
    /// let clusters = [cluster(0.0), cluster(1.0), cluster(2.0)];
    /// let found = Agreement::of_clusters(clusters.iter().map(|of| of.as_slice())).ok_or("three")?;
    /// assert_eq!((found.n, found.clusters), (9, Some(3)));
    /// assert!(found.freedom < 3.0);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn of_clusters<'a>(clusters: impl IntoIterator<Item = &'a [Pair]>) -> Option<Agreement> {
        let mut sums = OneWaySums::default();
        for cluster in clusters {
            sums.add(&differences(cluster)?);
        }
        let model = sums.model()?;
        let sample = NormalSample::of_clusters(&model)?;
        Some(Agreement {
            clusters: Some(model.groups),
            ..Agreement::of_sample(model.readings, &sample)
        })
    }

    fn of_sample(n: u64, sample: &NormalSample) -> Agreement {
        let [lower_ci95, upper_ci95] = sample.limit_ends();
        Agreement {
            n,
            clusters: None,
            bias: sample.mean,
            bias_ci95: sample.mean_ends(),
            sd: sample.sd,
            freedom: sample.freedom,
            limits: sample.limits(),
            lower_ci95,
            upper_ci95,
            proportional: None,
        }
    }
}

/// Sums of the differences of `pairs`; `None` if a difference is not finite.
fn differences(pairs: &[Pair]) -> Option<Moments> {
    let differences = pairs.iter().map(|pair| pair.one - pair.other);
    let are_finite = differences.clone().all(f64::is_finite);
    are_finite.then(|| differences.collect())
}
