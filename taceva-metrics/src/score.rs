//! One number of a report with all that is needed to trust and repeat it.

mod bootstrap_ends;
pub(crate) mod curve;
pub(crate) mod direction;
pub(crate) mod flag;
mod interval;
pub(crate) mod least;
pub(crate) mod map;
pub(crate) mod matrix;
pub(crate) mod range;
mod scale;
pub(crate) mod sensor_facts;
pub(crate) mod standing;
pub(crate) mod theme;
pub(crate) mod value;
pub(crate) mod verdict_rule;

pub use bootstrap_ends::BootstrapEnds;
pub use interval::{ClusteredBy, Interval};
pub use scale::Scale;
pub use sensor_facts::{Fact, SensorFacts};

use std::borrow::Cow;

use taceva_core::Unit;

use crate::score::flag::Flag;
use crate::score::range::Range;
use crate::score::standing::Standing;
use crate::score::value::Value;

/// What share of intervals should cover the truth.
pub(crate) const COVERAGE: f64 = 0.95;

/// A metric of a channel, or of the two channels of a plane.
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
    /// The value, in `unit`.
    pub value: Value,
    /// The unit of value and interval.
    pub unit: Unit,
    /// Samples it is made of; of two channels the smaller number.
    pub n: u64,
    /// Samples left out because a value was no usable number; of two channels the larger number.
    pub n_invalid: u64,
    /// Where the value would lie with other clusters (contact points), at 95 %.
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
    /// Further values of the same metric: other readings of its definition, maps and curves.
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
    /// What it is called, as a field of its metric: `slope`, `within`, `map`.
    pub name: Cow<'static, str>,
    /// The value, in `unit`.
    pub value: Value,
    /// The unit of value and interval.
    pub unit: Unit,
    /// Which values it can have.
    pub range: Range,
    /// Where the value would lie with other clusters (contact points), at 95 %; `None` where the question makes no sense, as for maps.
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

/// A number of samples, bins or the like: a plain named value, which gets no further fields.
///
/// ```
/// use taceva_metrics::Count;
/// assert_eq!(Count { name: "outside", value: 3 }.value, 3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// What was counted: `outside`, `bins_used`.
    pub name: &'static str,
    /// How many there are.
    pub value: u64,
}

/// A constant of a definition: a plain named value, which gets no further fields.
///
/// ```
/// use taceva_metrics::{EPSILON, Parameter};
/// assert_eq!(Parameter { name: "eps", value: EPSILON }.value, 1e-8);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// What it is called: `eps`, `gate`.
    pub name: &'static str,
    /// How large it is, in the unit of the channel.
    pub value: f64,
}
