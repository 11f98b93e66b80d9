//! How certain a score is: both ends of its interval, and how they were found.

use crate::score::bootstrap_ends::BootstrapEnds;
use crate::score::scale::Scale;
use crate::score::value::UndefinedReason;

/// What the clusters of an interval are.
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
    /// Single samples, taken as independent because the caller said that they are.
    Sample,
    /// Whole recordings, of samples of several.
    Recording,
    /// Groups of samples that depend on each other: blocks of time, clips, objects.
    Group,
}

impl ClusteredBy {
    /// Behind the name of a method.
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
        /// Degrees of freedom of Student's t that the ends were made with.
        freedom: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// On which scale the ends lie about the value.
        scale: Scale,
        /// What varies from cluster to cluster.
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
        /// One degree of freedom less than there are clusters.
        freedom: f64,
        /// On which scale the ends lie about the value; percentiles need none.
        scale: Scale,
        /// How the ends were read off the replicates.
        ends: BootstrapEnds,
        /// Number of clusters with samples.
        clusters: usize,
        /// Replicates that were drawn.
        replicates: usize,
        /// The seed they were drawn with.
        seed: u64,
        /// Replicates in which the score has no value; they are left out.
        undefined: usize,
        /// What varies from cluster to cluster.
        by: ClusteredBy,
    },
    /// Carried over from the jackknife variances of what the value is made of, to first order.
    Delta {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// The root of the variance, on the score's own scale.
        standard_error: f64,
        /// Degrees of freedom of Student's t that the ends were made with.
        freedom: f64,
        /// Number of clusters with samples, of the part that has the fewest.
        clusters: usize,
        /// On which scale the ends lie about the value.
        scale: Scale,
        /// What varies from cluster to cluster.
        by: ClusteredBy,
    },
    /// From the variance between clusters and within them, of a spread beyond chance.
    Components {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// Half the width over t, on the score's own scale.
        standard_error: f64,
        /// Degrees of freedom: one less than there are clusters.
        freedom: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// Kind of the clusters.
        by: ClusteredBy,
    },
    /// As if all samples were independent: what the interval of a share would be at best.
    Wilson {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// There is none.
    Undefined(UndefinedReason),
}

impl Interval {
    /// The same interval, whose clusters were of this kind.
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

    /// The standard error that it was made from, in the unit of the score and on its own scale, whichever scale the ends were
    /// formed on. None where samples are taken as independent.
    pub fn standard_error(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { standard_error, .. }
            | Interval::Bootstrap { standard_error, .. }
            | Interval::Delta { standard_error, .. }
            | Interval::Components { standard_error, .. } => Some(standard_error),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// Degrees of freedom of Student's t that it was made with, on the scale of its ends: the number of independent
    /// normal values that would give as certain a standard error. None where samples are taken as independent.
    pub fn freedom(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { freedom, .. }
            | Interval::Bootstrap { freedom, .. }
            | Interval::Delta { freedom, .. }
            | Interval::Components { freedom, .. } => Some(freedom),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// On which scale its ends lie about the value.
    pub fn scale(&self) -> Option<Scale> {
        match *self {
            Interval::Jackknife { scale, .. }
            | Interval::Bootstrap { scale, .. }
            | Interval::Delta { scale, .. } => Some(scale),
            Interval::Components { .. } => Some(Scale::Own),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// How many clusters it was made from, if it was made from clusters.
    pub fn clusters(&self) -> Option<usize> {
        match *self {
            Interval::Jackknife { clusters, .. }
            | Interval::Bootstrap { clusters, .. }
            | Interval::Delta { clusters, .. }
            | Interval::Components { clusters, .. } => Some(clusters),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// How it was found, in words: `jackknife by point_id, G=32`, `jackknife by point_id, G=32, logarithmic` or
    /// `Poisson bootstrap by point_id (percentile), G=32, B=1000, seed=0`; `, samples taken as independent` instead of ` by point_id` where
    /// every sample was a cluster of its own.
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
