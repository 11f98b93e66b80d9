//! One number of a report with all that is needed to trust and repeat it.

use std::borrow::Cow;

use taceva_core::Unit;

use crate::flag::Flag;
use crate::range::Range;
use crate::standing::Standing;
use crate::stats::{BootstrapEnds, Scale};
use crate::value::{UndefinedReason, Value};

/// What share of intervals should cover the truth.
pub(crate) const COVERAGE: f64 = 0.95;

/// A metric of a channel, or of the two channels of a plane.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Score {
    /// The value, in `unit`.
    pub value: Value,
    /// The unit of value and interval.
    pub unit: Unit,
    /// Samples it is made of; of two channels the smaller number.
    pub n: u64,
    /// Samples left out because a value was no usable number; of two channels the larger number.
    pub n_invalid: u64,
    /// Where the value would lie with other contact locations, at 95 %.
    pub interval: Interval,
    /// Which definition was computed: `mae/1`.
    pub definition: &'static str,
    /// The constants of the definition.
    pub parameters: Vec<Parameter>,
    /// What was counted on the way: samples outside the footprint, bins that have a value.
    pub counts: Vec<Count>,
    /// What a reader must know before trusting it.
    pub flags: Vec<Flag>,
    /// Whether it takes part in verdicts.
    pub standing: Standing,
    /// Which share of the predictions it was formed with lie beyond the bounds of the model, of its worst channel; `None` where no
    /// prediction enters it or no bounds are known.
    pub bounded_share: Option<f64>,
    /// The channels it is made of, if it is not one channel's own.
    pub of: Vec<String>,
    /// What else the metric says there: other readings of its definition, maps and curves.
    pub variants: Vec<Variant>,
}

impl Score {
    /// The variant called `name`: `slope`, `map`.
    pub fn variant(&self, name: &str) -> Option<&Variant> {
        self.variants.iter().find(|variant| variant.name == name)
    }

    /// The number called `name` that was counted on the way.
    pub fn count(&self, name: &str) -> Option<u64> {
        let found = self.counts.iter().find(|count| count.name == name);
        found.map(|count| count.value)
    }
}

/// Another value of the same metric and channel, under a name of its own.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Variant {
    /// What it is called, as a field of its metric: `slope`, `within`, `map`.
    pub name: Cow<'static, str>,
    /// The value, in `unit`.
    pub value: Value,
    /// The unit of value and interval.
    pub unit: Unit,
    /// Which values it can have.
    pub range: Range,
    /// Where the value would lie with other contact locations, at 95 %; `None` where the question makes no sense, as for maps.
    pub interval: Option<Interval>,
}

impl Variant {
    /// A map, a curve or another value without an interval.
    pub(crate) fn plain(name: &'static str, unit: Unit, value: Value) -> Variant {
        Variant {
            name: Cow::Borrowed(name),
            value,
            unit,
            range: Range::Any,
            interval: None,
        }
    }
}

/// A number of samples, bins or the like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// What was counted: `outside`, `bins_used`.
    pub name: &'static str,
    /// How many there are.
    pub value: u64,
}

/// A constant of a definition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// What it is called: `eps`, `gate`.
    pub name: &'static str,
    /// How large it is, in the unit of the channel.
    pub value: f64,
}

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
    /// Contact locations.
    #[default]
    Point,
    /// Single samples, taken as independent because the caller said that they are.
    Sample,
}

impl ClusteredBy {
    /// Behind the name of a method.
    const fn words(self) -> &'static str {
        match self {
            ClusteredBy::Point => " by point_id",
            ClusteredBy::Sample => ", samples taken as independent",
        }
    }
}

/// A confidence interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Interval {
    /// By leaving out one contact location after the other.
    Jackknife {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// The root of the jackknife's variance, on the score's own scale.
        standard_error: f64,
        /// Number of clusters with samples.
        clusters: usize,
        /// On which scale the ends lie about the value.
        scale: Scale,
        /// What varies from cluster to cluster.
        by: ClusteredBy,
    },
    /// By counting each contact location a random number of times.
    Bootstrap {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
        /// The standard deviation of the replicates, on the score's own scale.
        standard_error: f64,
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
        /// Number of clusters with samples, of the part that has the fewest.
        clusters: usize,
        /// On which scale the ends lie about the value.
        scale: Scale,
        /// What varies from cluster to cluster.
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
    /// The same interval, whose clusters were single samples.
    pub(crate) fn of_independent_samples(mut self) -> Interval {
        if let Interval::Jackknife { by, .. }
        | Interval::Bootstrap { by, .. }
        | Interval::Delta { by, .. } = &mut self
        {
            *by = ClusteredBy::Sample;
        }
        self
    }

    /// Both ends, if there is an interval.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match *self {
            Interval::Jackknife { low, high, .. }
            | Interval::Bootstrap { low, high, .. }
            | Interval::Delta { low, high, .. }
            | Interval::Wilson { low, high } => Some([low, high]),
            Interval::Undefined(_) => None,
        }
    }

    /// The standard error that it was made from, in the unit of the score and on its own scale, whichever scale the ends were
    /// formed on: what comparisons are made of. None where samples are taken as independent.
    pub fn standard_error(&self) -> Option<f64> {
        match *self {
            Interval::Jackknife { standard_error, .. }
            | Interval::Bootstrap { standard_error, .. }
            | Interval::Delta { standard_error, .. } => Some(standard_error),
            Interval::Wilson { .. } | Interval::Undefined(_) => None,
        }
    }

    /// How many clusters it was made from, if it was made from clusters.
    pub fn clusters(&self) -> Option<usize> {
        match *self {
            Interval::Jackknife { clusters, .. }
            | Interval::Bootstrap { clusters, .. }
            | Interval::Delta { clusters, .. } => Some(clusters),
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
