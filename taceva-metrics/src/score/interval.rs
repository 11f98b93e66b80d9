//! Confidence intervals of scores, with their ends and method.

use crate::score::bootstrap_ends::BootstrapEnds;
use crate::score::scale::Scale;
use crate::score::value::UndefinedReason;

/// Kind of clusters (groups of samples) from whose variation an interval is computed.
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
    /// Each contact point is a cluster.
    #[default]
    Point,
    /// Each sample is a cluster, because the caller declared the samples independent.
    Sample,
    /// Each recording of a set is a cluster.
    Recording,
    /// Each group of dependent samples, such as a block of time, a clip or an object, is a cluster.
    Group,
}

impl ClusteredBy {
    /// Text that follows the name of the method, such as ` by point_id`.
    const fn words(self) -> &'static str {
        match self {
            ClusteredBy::Point => " by point_id",
            ClusteredBy::Sample => ", samples taken as independent",
            ClusteredBy::Recording => " by recording",
            ClusteredBy::Group => " by group",
        }
    }
}

/// 95 % confidence interval of a score, with its method.
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
    /// Interval from a jackknife, which leaves out one cluster at a time.
    Jackknife {
        /// Lower end of the interval, in the unit of the score.
        low: f64,
        /// Upper end of the interval, in the unit of the score.
        high: f64,
        /// Jackknife standard error, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom of Student's t, from which the ends are computed.
        freedom: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// Scale on which the ends are symmetric about the value.
        scale: Scale,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Interval from a bootstrap, whose replicates weight the clusters at random.
    Bootstrap {
        /// Lower end of the interval, in the unit of the score.
        low: f64,
        /// Upper end of the interval, in the unit of the score.
        high: f64,
        /// Standard deviation of the score over the replicates, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom: number of clusters minus one.
        freedom: f64,
        /// Scale on which the ends are symmetric about the value. Percentile ends ignore the scale.
        scale: Scale,
        /// Method that computes the ends from the replicates.
        ends: BootstrapEnds,
        /// Number of clusters with samples.
        clusters: usize,
        /// Number of replicates.
        replicates: usize,
        /// Seed of the random weights.
        seed: u64,
        /// Number of skipped replicates, for which the score has no value.
        undefined: usize,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Interval from the delta method: a first-order variance from the jackknife of the quantities that form the value.
    Delta {
        /// Lower end of the interval, in the unit of the score.
        low: f64,
        /// Upper end of the interval, in the unit of the score.
        high: f64,
        /// Standard error, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom of Student's t, from which the ends are computed.
        freedom: f64,
        /// Number of clusters with samples, in the lighting scene with the fewest clusters.
        clusters: usize,
        /// Scale on which the ends are symmetric about the value.
        scale: Scale,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Interval from the variances between and within clusters, for a spread beyond chance or for limits of agreement.
    Components {
        /// Lower end of the interval, in the unit of the score.
        low: f64,
        /// Upper end of the interval, in the unit of the score.
        high: f64,
        /// Half the width of the interval divided by the factor of Student's t, in the unit of the score.
        standard_error: f64,
        /// Degrees of freedom: the number of clusters minus one, or those of the standard deviation of the errors.
        freedom: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Wilson interval of a share, for independent samples. Dependent samples would need a wider interval.
    Wilson {
        /// Lower end of the interval, a share.
        low: f64,
        /// Upper end of the interval, a share.
        high: f64,
    },
    /// No interval exists, for the given reason.
    Undefined(UndefinedReason),
}

impl Interval {
    /// Returns the interval with `clusters` as the kind of its clusters.
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

    /// Lower and upper end; `None` for [`Interval::Undefined`], which states the reason.
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

    /// Standard error in the unit of the score, whatever the scale of the ends. `None` for a Wilson interval and for [`Interval::Undefined`].
    pub fn standard_error(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { standard_error, .. }
            | Interval::Bootstrap { standard_error, .. }
            | Interval::Delta { standard_error, .. }
            | Interval::Components { standard_error, .. } => Some(standard_error),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Degrees of freedom of Student's t on the scale of the ends, which state the certainty of the standard error. `None` for a Wilson interval
    /// and for [`Interval::Undefined`].
    pub fn freedom(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { freedom, .. }
            | Interval::Bootstrap { freedom, .. }
            | Interval::Delta { freedom, .. }
            | Interval::Components { freedom, .. } => Some(freedom),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Scale on which the ends are symmetric about the value. `None` for a Wilson interval and for [`Interval::Undefined`].
    pub fn scale(&self) -> Option<Scale> {
        match *self {
            Interval::Jackknife { scale, .. }
            | Interval::Bootstrap { scale, .. }
            | Interval::Delta { scale, .. } => Some(scale),
            Interval::Components { .. } => Some(Scale::Own),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Number of clusters with samples. `None` for a Wilson interval and for [`Interval::Undefined`].
    pub fn clusters(&self) -> Option<usize> {
        match *self {
            Interval::Jackknife { clusters, .. }
            | Interval::Bootstrap { clusters, .. }
            | Interval::Delta { clusters, .. }
            | Interval::Components { clusters, .. } => Some(clusters),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Method in words, with G clusters and B replicates: `jackknife by point_id, G=32`, `jackknife by point_id, G=32, logarithmic` or
    /// `Poisson bootstrap by point_id (percentile), G=32, B=1000, seed=0`. If every sample is its own cluster,
    /// `, samples taken as independent` replaces ` by point_id`. `None` for [`Interval::Undefined`].
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
