//! Scores of a metric on a channel or plane.

pub mod by_metric;
mod line;
mod object;

pub use line::{ScoreLine, full_name};

use taceva_core::Unit;
use taceva_metrics::{Better, Evaluation, Metric, Standing, catalogue};

use crate::interval::Interval;
use crate::value::Value;

/// Score of a metric on a channel or plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// Name of the metric: `mae`.
    pub metric: String,
    /// Name of the channel or plane: `Fz`, `Pxy`.
    pub channel: String,
    /// Value of the score, in `unit`.
    pub value: Value,
    /// Unit of value and interval.
    pub unit: Unit,
    /// Number of samples from which the score was computed.
    pub n: u64,
    /// Number of samples skipped because a value is NaN or too large.
    pub n_invalid: u64,
    /// Interval at 95 %; `None` if the value is not a single number, or was given without an interval.
    pub interval: Option<Interval>,
    /// Name and version of the metric's definition: `mae/1`.
    pub definition: String,
    /// Constants of the metric's definition, by name.
    pub parameters: Vec<(String, f64)>,
    /// Counts that the computation reports, such as bins with a value, by name.
    pub counts: Vec<(String, u64)>,
    /// Warnings about the score: `one bin`.
    pub flags: Vec<String>,
    /// Standing: tells if the score takes part in verdicts, and if not, the reason.
    pub standing: Standing,
    /// Share of predictions that exceed the bounds of the model before clipping, from 0 to 1; `None` without predictions or bounds.
    pub bounded_share: Option<f64>,
    /// Channels from which the score of a plane was computed; empty for a single channel.
    pub of: Vec<String>,
    /// Further values of the same metric and channel, such as the slope of a fit.
    pub variants: Vec<Variant>,
}

/// Further value of a score, such as the slope of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// Name of the variant: `slope`, `map`.
    pub name: String,
    /// Value of the variant, in `unit`.
    pub value: Value,
    /// Unit of value and interval.
    pub unit: Unit,
    /// Interval at 95 %; `None` if the value is not a single number, or has no interval.
    pub interval: Option<Interval>,
}

/// Scores of `evaluation`, in the order of the evaluation.
pub fn scores(evaluation: &Evaluation) -> Vec<Score> {
    let all = evaluation.scores();
    all.map(|(metric, channel, score)| Score::of(metric, channel, score))
        .collect()
}

impl Score {
    /// Converts a score of `taceva-metrics` for `metric` on `channel`.
    pub fn of(metric: &Metric, channel: &str, score: &taceva_metrics::Score) -> Score {
        Score {
            metric: metric.id.to_owned(),
            channel: channel.to_owned(),
            value: Value::of(&score.value),
            unit: score.unit,
            n: score.n,
            n_invalid: score.n_invalid,
            interval: (score.value.scalar()).map(|_| Interval::of(&score.interval)),
            definition: score.definition.to_owned(),
            parameters: named(&score.parameters, |own| (own.name, own.value)),
            counts: named(&score.counts, |own| (own.name, own.value)),
            flags: score.flags.iter().map(ToString::to_string).collect(),
            standing: score.standing,
            bounded_share: score.bounded_share,
            of: score.of.clone(),
            variants: score.variants.iter().map(Variant::of).collect(),
        }
    }

    /// Score with the single number `value`, without an interval and with 0 samples.
    pub fn of_number(metric: &str, channel: &str, value: f64, unit: Unit) -> Score {
        Score {
            metric: metric.to_owned(),
            channel: channel.to_owned(),
            value: Value::Number(value),
            unit,
            n: 0,
            n_invalid: 0,
            interval: None,
            definition: String::new(),
            parameters: Vec::new(),
            counts: Vec::new(),
            flags: Vec::new(),
            standing: Standing::Counts,
            bounded_share: None,
            of: Vec::new(),
            variants: Vec::new(),
        }
    }

    /// Variant called `name`; `None` if the score lacks the variant.
    pub fn variant(&self, name: &str) -> Option<&Variant> {
        self.variants.iter().find(|variant| variant.name == name)
    }

    /// Variant on which verdicts rest, for metrics whose value depends on noise or on the number of repeats. `None` if verdicts rest on the value
    /// itself, or if the variant has no number.
    pub fn decided_by(&self) -> Option<&Variant> {
        let name = catalogue::find(&self.metric)?.decided_by?;
        let variant = self.variant(name)?;
        variant.value.number().map(|_| variant)
    }

    /// Score on which verdicts rest. Value, unit and interval come from [`decided_by`](Score::decided_by), if there is such a variant.
    #[must_use]
    pub fn deciding(&self) -> Score {
        match self.decided_by() {
            Some(variant) => Score {
                value: variant.value.clone(),
                unit: variant.unit,
                interval: variant.interval.clone(),
                ..self.clone()
            },
            None => self.clone(),
        }
    }

    /// Standing in verdicts of the score, or of its variant called `variant`. Reference constants always count.
    pub fn standing_of(&self, variant: Option<&str>) -> Standing {
        match variant {
            Some("of_constant" | "constant") => Standing::Counts,
            _ => self.standing,
        }
    }

    /// Direction in which values of the metric get better; `Described` for metrics outside the catalogue.
    pub fn better(&self) -> Better {
        catalogue::find(&self.metric).map_or(Better::Described, |metric| metric.better)
    }
}

impl Variant {
    fn of(variant: &taceva_metrics::Variant) -> Variant {
        Variant {
            name: variant.name.to_string(),
            value: Value::of(&variant.value),
            unit: variant.unit,
            interval: (variant.value.scalar()).and(variant.interval.as_ref().map(Interval::of)),
        }
    }
}

fn named<T, N>(all: &[T], entry: impl Fn(&T) -> (&'static str, N)) -> Vec<(String, N)> {
    let entries = all.iter().map(entry);
    entries
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}
