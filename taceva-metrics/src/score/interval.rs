//! Confidence intervals of scores: both ends, and the method.

use crate::score::bootstrap_ends::BootstrapEnds;
use crate::score::scale::Scale;
use crate::score::value::UndefinedReason;

/// Kind of clusters of an interval.
///
/// ```
/// use taceva_metrics::{Channel, ClusteredBy, Evaluator, Interval};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?.independent_samples();
/// evaluator.update_pairs(Channel::FZ, &[1.0, 2.0, 3.0, 4.0, 5.0], &[1.1, 2.3, 2.9, 4.2, 5.4])?;
/// let scores = evaluator.finish()?;
/// let interval = scores.mae(Channel::FZ).map(|score| score.interval);
/// assert!(matches!(interval, Some(Interval::Jackknife { by: ClusteredBy::Sample, .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ClusteredBy {
    /// Contact points.
    #[default]
    Point,
    /// Single samples, declared independent by the caller.
    Sample,
    /// Whole recordings of a set.
    Recording,
    /// Groups of dependent samples: blocks of time, clips, objects.
    Group,
}

impl ClusteredBy {
    /// Words after the name of a method.
    const fn words(self) -> &'static str {
        match self {
            ClusteredBy::Point => " by point_id",
            ClusteredBy::Sample => ", samples taken as independent",
            ClusteredBy::Recording => " by recording",
            ClusteredBy::Group => " by group",
        }
    }
}

/// A confidence interval of 95 %.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator, Interval, UndefinedReason};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
/// evaluator.update_pairs(Channel::FZ, &[0.25, 0.5], &[0.5, 0.5])?;
/// let scores = evaluator.finish()?;
/// let mae = scores.mae(Channel::FZ).ok_or("a score")?;
/// assert_eq!(mae.interval, Interval::Undefined(UndefinedReason::NoClusters));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Interval {
    /// Delete-one-cluster jackknife.
    Jackknife {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// Jackknife standard error, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom of Student's t for the ends.
        freedom: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// Scale on which the ends are symmetric about the value.
        scale: Scale,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Bootstrap: replicates with random weights of the clusters.
    Bootstrap {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// Standard deviation of the replicates, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom: number of clusters minus one.
        freedom: f64,
        /// Scale on which the ends are symmetric about the value; irrelevant for percentiles.
        scale: Scale,
        /// Method for the ends from the replicates.
        ends: BootstrapEnds,
        /// Number of clusters with samples.
        clusters: usize,
        /// Number of replicates.
        replicates: usize,
        /// Seed of the replicates.
        seed: u64,
        /// Number of replicates without a value, which are skipped.
        undefined: usize,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Delta method: first-order variance from the jackknife variances of the value's components.
    Delta {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// Standard error, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom of Student's t for the ends.
        freedom: f64,
        /// Number of clusters with samples, in the part with the fewest clusters.
        clusters: usize,
        /// Scale on which the ends are symmetric about the value.
        scale: Scale,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// From the variance between and within clusters, for a spread beyond chance and for limits of agreement of independent errors.
    Components {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// Half-width divided by t, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom: number of clusters minus one, or the degrees of freedom of the standard deviation of errors.
        freedom: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Wilson interval for independent samples: the narrowest possible interval of a share.
    Wilson {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// No interval, with the reason.
    Undefined(UndefinedReason),
}

impl Interval {
    /// The same interval with another kind of clusters.
    pub(crate) fn clustered_by(mut self, clusters: ClusteredBy) -> Interval {
        if let Interval::Jackknife { by, .. }
        | Interval::Bootstrap { by, .. }
        | Interval::Delta { by, .. }
        | Interval::Components { by, .. } = &mut self
        {
            *by = clusters;
        }
        self
    }

    /// Both ends; `None` without an interval. [`Interval::Undefined`] then has the reason.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match *self {
            Interval::Jackknife { low, high, .. }
            | Interval::Bootstrap { low, high, .. }
            | Interval::Delta { low, high, .. }
            | Interval::Components { low, high, .. }
            | Interval::Wilson { low, high } => Some([low, high]),
            Interval::Undefined(_) => None,
        }
    }

    /// Standard error in the unit of the score, for any scale of the ends. `None` if the interval treats samples as
    /// independent.
    pub fn standard_error(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { standard_error, .. }
            | Interval::Bootstrap { standard_error, .. }
            | Interval::Delta { standard_error, .. }
            | Interval::Components { standard_error, .. } => Some(standard_error),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Degrees of freedom of Student's t, on the scale of the ends: the number of independent normal values whose standard error would be
    /// equally certain. `None` if the interval treats samples as independent.
    pub fn freedom(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { freedom, .. }
            | Interval::Bootstrap { freedom, .. }
            | Interval::Delta { freedom, .. }
            | Interval::Components { freedom, .. } => Some(freedom),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Scale on which the ends are symmetric about the value; `None` for an interval without such a scale.
    pub fn scale(&self) -> Option<Scale> {
        match *self {
            Interval::Jackknife { scale, .. }
            | Interval::Bootstrap { scale, .. }
            | Interval::Delta { scale, .. } => Some(scale),
            Interval::Components { .. } => Some(Scale::Own),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Number of clusters; `None` for an interval without clusters.
    pub fn clusters(&self) -> Option<usize> {
        match *self {
            Interval::Jackknife { clusters, .. }
            | Interval::Bootstrap { clusters, .. }
            | Interval::Delta { clusters, .. }
            | Interval::Components { clusters, .. } => Some(clusters),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Method in words: `jackknife by point_id, G=32`, `jackknife by point_id, G=32, logarithmic` or
    /// `Poisson bootstrap by point_id (percentile), G=32, B=1000, seed=0`. If every sample is its own cluster,
    /// `, samples taken as independent` replaces ` by point_id`. `None` without an interval.
    pub fn method(&self) -> Option<String> {
        match self {
            Interval::Jackknife {
                clusters,
                scale,
                by,
                ..
            } => Some(format!("jackknife{}, G={clusters}{scale}", by.words())),
            Interval::Delta {
                clusters,
                scale,
                by,
                ..
            } => Some(format!("delta method{}, G={clusters}{scale}", by.words())),
            Interval::Components { clusters, by, .. } => {
                Some(format!("variance components{}, G={clusters}", by.words()))
            }
            Interval::Wilson { .. } => Some("Wilson, samples taken as independent".to_owned()),
            Interval::Bootstrap {
                ends,
                scale,
                clusters,
                replicates,
                seed,
                undefined,
                by,
                ..
            } => {
                let left_out = match undefined {
                    0 => String::new(),
                    undefined => format!(" ({undefined} without a value)"),
                };
                let by = by.words();
                Some(format!(
                    "Poisson bootstrap{by} ({ends}), G={clusters}, B={replicates}{left_out}, seed={seed}{scale}"
                ))
            }
            Interval::Undefined(_) => None,
        }
    }
}
