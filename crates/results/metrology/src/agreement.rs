//! Agreement of two methods that measure the same, by the limits of Bland and Altman.
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
//! Bland and Altman, Lancet 327 (1986); Carkeet, Optometry and Vision Science 92 (2015), exact ends; Satterthwaite, Biometrics Bulletin 2
//! (1946), clusters.

use serde::{Deserialize, Serialize};
use taceva_metrics::distributions::{noncentral_t, normal, student_t};
use taceva_metrics::{Dyadic, ExactSum};

use crate::gauge::OneWay;
use crate::tolerance::Spread;

/// Share of differences between the limits, and confidence of all intervals.
const SHARE: f64 = 0.95;

/// Two measurements of one quantity in one unit.
///
/// ```
/// use taceva_metrology::agreement::Pair;
/// assert_eq!(Pair::new(3.0, 1.0).one, 3.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Pair {
    /// The first method.
    pub one: f64,
    /// The second method.
    pub other: f64,
}

impl Pair {
    /// Two measurements.
    #[must_use]
    pub fn new(one: f64, other: f64) -> Pair {
        Pair { one, other }
    }
}

/// Change of the difference with the size of what is measured.
///
/// ```
/// use taceva_metrology::agreement::{Agreement, Pair};
/// // The second method reads 10 % more.
/// let pairs: Vec<Pair> = [1.0, 2.0, 3.0, 4.5].map(|x| Pair::new(x, 1.1 * x)).into();
/// let slope = Agreement::of(&pairs).and_then(|found| found.proportional).ok_or("a slope")?;
/// assert!((slope.slope + 0.1 / 1.05).abs() < 1e-12 && slope.p < 1e-9);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Proportional {
    /// Slope of the difference against the mean of both.
    pub slope: f64,
    /// Standard error of the slope.
    pub standard_error: f64,
    /// Probability of such a slope by chance.
    pub p: f64,
}

/// Bias and limits of agreement of the first method minus the second, in their unit.
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
    /// Number of clusters, if the pairs came in clusters.
    pub clusters: Option<u64>,
    /// Mean difference.
    pub bias: f64,
    /// Interval of 95 % of the bias.
    pub bias_ci95: [f64; 2],
    /// Standard deviation of a difference.
    pub sd: f64,
    /// Degrees of freedom of the standard deviation.
    pub freedom: f64,
    /// Limits between which 95 % of differences are: bias ± 1.96 standard deviations.
    pub limits: [f64; 2],
    /// Interval of 95 % of the lower limit.
    pub lower_ci95: [f64; 2],
    /// Interval of 95 % of the upper limit.
    pub upper_ci95: [f64; 2],
    /// Change of the difference with its size; none if all means are equal, and for clusters.
    pub proportional: Option<Proportional>,
}

/// A mean with the size of an independent sample that would have its uncertainty, and a standard deviation.
struct Sample {
    n: f64,
    mean: f64,
    mean_freedom: f64,
    sd: f64,
    freedom: f64,
}

/// Ends of intervals about bias and limits.
struct Ends {
    bias: [f64; 2],
    limits: [f64; 2],
    lower: [f64; 2],
    upper: [f64; 2],
}

impl Ends {
    fn of(sample: &Sample) -> Ends {
        let Sample { n, mean, sd, .. } = *sample;
        let root = n.sqrt();
        let z = normal::quantile(f64::midpoint(1.0, SHARE));
        let tail = (1.0 - SHARE) / 2.0;
        let half = student_t::quantile(1.0 - tail, sample.mean_freedom) * sd / root;
        // (limit − mean) √n / s has the noncentral t distribution; the lower limit is its mirror image.
        let end = |share| noncentral_t::quantile(share, sample.freedom, z * root) / root * sd;
        let (near, far) = (end(tail), end(1.0 - tail));
        Ends {
            bias: [mean - half, mean + half],
            limits: [mean - z * sd, mean + z * sd],
            lower: [mean - far, mean - near],
            upper: [mean + near, mean + far],
        }
    }
}

impl Agreement {
    /// Agreement of independent pairs; `None` below two pairs, or with a value that is not finite.
    #[must_use]
    pub fn of(pairs: &[Pair]) -> Option<Agreement> {
        let differences: Vec<f64> = pairs.iter().map(|pair| pair.one - pair.other).collect();
        let Spread { n, mean, sd } = Spread::of(&differences)?;
        let freedom = real(n - 1);
        let ends = Ends::of(&Sample {
            n: real(n),
            mean,
            mean_freedom: freedom,
            sd,
            freedom,
        });
        Some(Agreement {
            n,
            clusters: None,
            bias: mean,
            bias_ci95: ends.bias,
            sd,
            freedom,
            limits: ends.limits,
            lower_ci95: ends.lower,
            upper_ci95: ends.upper,
            proportional: proportional(pairs),
        })
    }

    /// Agreement of pairs in clusters, whose differences depend on each other within a cluster.
    ///
    /// The standard deviation holds both components of variance, with degrees of freedom by Satterthwaite. The ends of intervals are
    /// therefore approximate. `None` below two clusters, without two pairs in one of them, with a value that is not finite, or without any
    /// variation.
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
        let clusters: Vec<Vec<f64>> = clusters
            .into_iter()
            .map(|of| of.iter().map(|pair| pair.one - pair.other).collect())
            .collect();
        if clusters.iter().flatten().any(|value| !value.is_finite()) {
            return None;
        }
        let model = OneWay::of(clusters.iter().map(Vec::as_slice))?;
        let freedom = model.total_freedom?;
        let ratio = model.total / model.mean_uncertainty;
        let is_varied = model.mean_uncertainty > 0.0;
        let ends = Ends::of(&Sample {
            n: if is_varied {
                ratio * ratio
            } else {
                real(model.readings)
            },
            mean: model.mean,
            mean_freedom: real(model.groups - 1),
            sd: model.total,
            freedom,
        });
        Some(Agreement {
            n: model.readings,
            clusters: Some(model.groups),
            bias: model.mean,
            bias_ci95: ends.bias,
            sd: model.total,
            freedom,
            limits: ends.limits,
            lower_ci95: ends.lower,
            upper_ci95: ends.upper,
            proportional: None,
        })
    }
}

fn real(count: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "no sample has 2^53 pairs")]
    let real = count as f64;
    real
}

/// Line through differences against means by least squares; three pairs at least.
fn proportional(pairs: &[Pair]) -> Option<Proportional> {
    let n = u64::try_from(pairs.len()).ok().filter(|n| *n > 2)?;
    let [mut x, mut y, mut xx, mut xy, mut yy] = <[ExactSum; 5]>::default();
    for pair in pairs {
        let (mean, difference) = (f64::midpoint(pair.one, pair.other), pair.one - pair.other);
        x.add(mean);
        y.add(difference);
        xx.add_product(mean, mean);
        xy.add_product(mean, difference);
        yy.add_product(difference, difference);
    }
    let count = Dyadic::from(n);
    let [x, y] = [x, y].map(|sum| sum.to_dyadic());
    let scaled = |products: &ExactSum, left: &Dyadic, right: &Dyadic| {
        &(&count * &products.to_dyadic()) - &(left * right)
    };
    let (xx, xy, yy) = (
        scaled(&xx, &x, &x),
        scaled(&xy, &x, &y),
        scaled(&yy, &y, &y),
    );
    if xx.is_zero() {
        return None;
    }
    let freedom = real(n - 2);
    // Variance of the slope: (Sxx Syy − Sxy²) / (Sxx² (n − 2)).
    let left = &(&xx * &yy) - &(&xy * &xy);
    let standard_error = left.root_over(&(&(&xx * &xx) * &Dyadic::from(n - 2)));
    let slope = xy.over(&xx);
    let p = match standard_error > 0.0 {
        true => 2.0 * student_t::above(slope.abs() / standard_error, freedom),
        false if xy.is_zero() => 1.0,
        false => 0.0,
    };
    Some(Proportional {
        slope,
        standard_error,
        p,
    })
}
