//! Confidence interval of a score: both ends, and the method.

use crate::score::bootstrap_ends::BootstrapEnds;
use crate::score::scale::Scale;
use crate::score::value::UndefinedReason;

/// Clusters of an interval.
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
    /// Single samples, which the caller declared independent.
    Sample,
    /// Whole recordings, if there are several.
    Recording,
    /// Groups of samples that depend on each other: blocks of time, clips, objects.
    Group,
}

impl ClusteredBy {
    /// Text after the name of a method.
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
    /// By leaving out one cluster after the other.
    Jackknife {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// The root of the jackknife's variance, on the score's own scale.
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
    /// By counting each cluster a random number of times.
    Bootstrap {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// The standard deviation of the replicates, on the score's own scale.
        standard_error: f64,
        /// Degrees of freedom: one less than there are clusters.
        freedom: f64,
        /// Scale on which the ends are symmetric about the value; percentiles need none.
        scale: Scale,
        /// Method for the ends from the replicates.
        ends: BootstrapEnds,
        /// Number of clusters with samples.
        clusters: usize,
        /// Replicates that were drawn.
        replicates: usize,
        /// The seed they were drawn with.
        seed: u64,
        /// Replicates without a value, which are skipped.
        undefined: usize,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// Delta method: from the jackknife variances of the components of the value, to first order.
    Delta {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// The root of the variance, on the score's own scale.
        standard_error: f64,
        /// Degrees of freedom of Student's t for the ends.
        freedom: f64,
        /// Number of clusters with samples, of the part that has the fewest.
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
        /// Half the width over t, on the score's own scale.
        standard_error: f64,
        /// Degrees of freedom: one less than there are clusters, or those of the standard deviation of errors.
        freedom: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// As if all samples were independent: the narrowest possible interval of a share.
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
    /// The same interval with clusters of this kind.
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

    /// Both ends, if there is an interval.
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

    /// Standard error of the interval, in the unit of the score and on its own scale, whatever the scale of the ends. `None` if samples are
    /// taken as independent.
    pub fn standard_error(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { standard_error, .. }
            | Interval::Bootstrap { standard_error, .. }
            | Interval::Delta { standard_error, .. }
            | Interval::Components { standard_error, .. } => Some(standard_error),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Degrees of freedom of Student's t, on the scale of the ends: the number of independent normal values that give an equally certain
    /// standard error. `None` if samples are taken as independent.
    pub fn freedom(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { freedom, .. }
            | Interval::Bootstrap { freedom, .. }
            | Interval::Delta { freedom, .. }
            | Interval::Components { freedom, .. } => Some(freedom),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Scale on which its ends are symmetric about the value.
    pub fn scale(&self) -> Option<Scale> {
        match *self {
            Interval::Jackknife { scale, .. }
            | Interval::Bootstrap { scale, .. }
            | Interval::Delta { scale, .. } => Some(scale),
            Interval::Components { .. } => Some(Scale::Own),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Number of clusters, if it was computed from clusters.
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
    /// `, samples taken as independent` replaces ` by point_id`.
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
