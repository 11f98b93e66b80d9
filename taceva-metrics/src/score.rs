//! Scores of metrics: values with units, intervals, counts and warnings.

mod bootstrap_ends;
pub(crate) mod curve;
pub(crate) mod digits;
pub(crate) mod direction;
pub(crate) mod flag;
mod interval;
pub(crate) mod least;
pub(crate) mod map;
pub(crate) mod matrix;
pub(crate) mod range;
mod scale;
pub(crate) mod sensor_facts;
pub(crate) mod theme;
pub(crate) mod value;
pub(crate) mod verdict_rule;
pub(crate) mod verdict_standing;

pub use bootstrap_ends::BootstrapEnds;
pub use interval::{ClusteredBy, Interval};
pub use scale::Scale;
pub use sensor_facts::{Fact, SensorFacts};

use std::borrow::Cow;

use taceva_core::Unit;

use crate::score::flag::Flag;
use crate::score::range::Range;
use crate::score::value::Value;
use crate::score::verdict_standing::Standing;

/// Nominal coverage of confidence intervals: the share of intervals that contain the true score.
pub(crate) const COVERAGE: f64 = 0.95;

/// Score of a metric on a channel, or on the two channels of a plane, such as `Fx` and `Fy`.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator, Unit};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
/// evaluator.update_pairs(Channel::FZ, &[0.25, 0.5], &[0.5, 0.5])?;
/// let scores = evaluator.finish()?;
/// let mae = scores.mae(Channel::FZ).ok_or("a score")?;
/// assert_eq!((mae.value.scalar(), mae.unit, mae.n), (Some(0.125), Unit::Newton, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Score {
    /// Value of the score, in `unit`.
    pub value: Value,
    /// Unit of the value and of the interval.
    pub unit: Unit,
    /// Number of samples from which the score is computed; for two channels, the smaller number.
    pub n: u64,
    /// Number of skipped samples, whose values are NaN or too large; for two channels, the larger number.
    pub n_invalid: u64,
    /// 95 % confidence interval of the value, from its variation between clusters (contact points).
    pub interval: Interval,
    /// Name and version of the metric's definition, such as `mae/1`.
    pub definition: &'static str,
    /// Constants of the metric's definition, such as a tolerance.
    pub parameters: Vec<Parameter>,
    /// Further counts, such as samples outside the footprint or bins with a value.
    pub counts: Vec<Count>,
    /// Warnings about the score.
    pub flags: Vec<Flag>,
    /// Standing of the score: whether verdicts include it, or the reason for its exclusion.
    pub standing: Standing,
    /// Share of predictions beyond the bounds (trained range) of the model; for several channels, the greatest share. `None` if the score uses no
    /// predictions or the bounds are unknown.
    pub bounded_share: Option<f64>,
    /// Names of the channels from which the score is computed; empty for a score of a single channel.
    pub of: Vec<String>,
    /// Further values of the same metric: other variants of its definition, maps and curves.
    pub variants: Vec<Variant>,
}

impl Score {
    /// Variant called `name`, such as `slope` or `map`; `None` if the score lacks the variant.
    pub fn variant(&self, name: &str) -> Option<&Variant> {
        self.variants.iter().find(|variant| variant.name == name)
    }

    /// Value of the count called `name`; `None` if the score lacks the count.
    pub fn count(&self, name: &str) -> Option<u64> {
        let found = self.counts.iter().find(|count| count.name == name);
        found.map(|count| count.value)
    }
}

/// Further value of a score: another variant of the metric's definition, a map or a curve.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
/// evaluator.update_pairs(Channel::FZ, &[0.25, 0.5, 1.0], &[0.5, 0.5, 0.5])?;
/// let scores = evaluator.finish()?;
/// let skill = scores.skill(Channel::FZ).ok_or("a score")?;
/// assert!(skill.variant("constant").is_some_and(|variant| variant.value.scalar().is_some()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Variant {
    /// Name of the variant, unique within the metric, such as `slope`, `within` or `map`.
    pub name: Cow<'static, str>,
    /// Value of the variant, in `unit`.
    pub value: Value,
    /// Unit of the value and of the interval.
    pub unit: Unit,
    /// Range of the possible values of the variant.
    pub range: Range,
    /// 95 % confidence interval, from the variation between clusters (contact points). `None` for kinds of values without an interval, such as a
    /// map.
    pub interval: Option<Interval>,
}

impl Variant {
    /// Variant without an interval, such as a map or a curve.
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

/// Named number of samples, bins or other items. A plain value, which gets no further fields.
///
/// ```
/// use taceva_metrics::Count;
/// assert_eq!(Count { name: "outside", value: 3 }.value, 3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// Name of the count, such as `outside` or `bins_used`.
    pub name: &'static str,
    /// Number of items.
    pub value: u64,
}

/// Named constant of a metric's definition. A plain value, which gets no further fields.
///
/// ```
/// use taceva_metrics::{EPSILON, Parameter};
/// assert_eq!(Parameter { name: "eps", value: EPSILON }.value, 1e-8);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Name of the constant, such as `eps` or `gate`.
    pub name: &'static str,
    /// Value of the constant: a number of items, or a quantity in the unit of the channel or of the name, such as `tolerance_mm`.
    pub value: f64,
}
