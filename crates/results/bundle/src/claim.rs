//! Claims of a bundle: the numbers of its results.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use taceva_core::Unit;
use taceva_results::{EvaluationReport, Interval, Score, full_name};

use crate::level::Level;

/// A number of the results, with the files behind it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Claim {
    /// Index of the study in the results, from 0.
    pub study: usize,
    /// Metric, such as `mae`.
    pub metric: String,
    /// Channel or plane, such as `Fz` or `Pxy`.
    pub channel: String,
    /// Variant of the metric, such as `slope`; `None` for the metric itself.
    pub variant: Option<String>,
    /// Value, in `unit`.
    pub value: f64,
    /// Both ends of the interval of 95 %, in `unit`; `None` without an interval.
    pub ci95: Option<[f64; 2]>,
    /// Unit of value and interval.
    pub unit: Unit,
    /// Number of samples.
    pub n: u64,
    /// Name and version of the metric's definition, such as `mae/1`.
    pub definition: String,
    /// Files from which the number can be computed.
    pub from: Vec<String>,
    /// Level to which the maker of the bundle verified the number.
    pub level: Level,
}

/// Value and interval of a score or of one of its variants.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) ci95: Option<[f64; 2]>,
}

impl Number {
    /// Number of `score`, or of its variant; `None` if it is undefined or not a single number.
    pub(crate) fn of(score: &Score, variant: Option<&str>) -> Option<Number> {
        let (value, interval) = match variant {
            None => (&score.value, &score.interval),
            Some(name) => {
                let variant = score.variant(name)?;
                (&variant.value, &variant.interval)
            }
        };
        Some(Number {
            value: value.number()?,
            ci95: interval.as_ref().and_then(Interval::ends),
        })
    }

    /// True if value and interval are equal, bit for bit.
    pub(crate) fn is_same(self, other: Number) -> bool {
        let ends = |ends: [f64; 2]| ends.map(f64::to_bits);
        self.value.to_bits() == other.value.to_bits() && self.ci95.map(ends) == other.ci95.map(ends)
    }

    /// True if value and ends differ by at most `tolerance`.
    pub(crate) fn is_within(self, other: Number, tolerance: f64) -> bool {
        let is_near = |one: f64, other: f64| (one - other).abs() <= tolerance;
        let are_near = match (self.ci95, other.ci95) {
            (Some(own), Some(other)) => is_near(own[0], other[0]) && is_near(own[1], other[1]),
            (None, None) => true,
            _ => false,
        };
        is_near(self.value, other.value) && are_near
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.value)?;
        match self.ci95 {
            Some([low, high]) => write!(f, " [{low}, {high}]"),
            None => Ok(()),
        }
    }
}

impl Claim {
    /// Value and interval.
    pub(crate) fn number(&self) -> Number {
        Number {
            value: self.value,
            ci95: self.ci95,
        }
    }

    /// Same claim with the value, interval, unit, number of samples and definition from `report`; unchanged if `report` lacks the score.
    pub(crate) fn as_in(&self, report: &EvaluationReport) -> Claim {
        let score = self.score_in(&report.scores);
        let variant = self.variant.as_deref();
        let number = score.and_then(|score| Number::of(score, variant));
        let (Some(score), Some(number)) = (score, number) else {
            return self.clone();
        };
        Claim {
            value: number.value,
            ci95: number.ci95,
            unit: unit_of(score, variant).unwrap_or(self.unit),
            n: score.n,
            definition: score.definition.clone(),
            ..self.clone()
        }
    }

    /// Score of the metric and the channel of the claim; `None` if `scores` has no such score.
    pub(crate) fn score_in<'a>(&self, scores: &'a [Score]) -> Option<&'a Score> {
        let mut scores = scores.iter();
        scores.find(|score| score.metric == self.metric && score.channel == self.channel)
    }

    /// True if the claim has the unit, number of samples and definition of `score`.
    pub(crate) fn is_of(&self, score: &Score) -> bool {
        unit_of(score, self.variant.as_deref()) == Some(self.unit)
            && score.n == self.n
            && score.definition == self.definition
    }

    /// Metric with its variant: `mae`, `hysteresis.ratio`.
    pub(crate) fn full_metric(&self) -> String {
        full_name(&self.metric, self.variant.as_deref())
    }

    /// All facts of the claim except its value, as text, for formats without fields for these facts.
    pub(crate) fn facts(&self) -> String {
        let interval = match self.ci95 {
            Some([low, high]) => format!("ci95 [{low}, {high}]"),
            None => "no ci95".to_owned(),
        };
        format!(
            "{interval}, unit {}, n = {}, definition {}, study {}, level {}",
            self.unit, self.n, self.definition, self.study, self.level
        )
    }

    /// The claim as a `PropertyValue` of schema.org, identified by `number`.
    fn property(&self, number: usize) -> Value {
        let mut own = json!({
            "@id": format!("#claim-{number}"),
            "@type": "PropertyValue",
            "name": self.words(),
            "value": self.value,
            "unitText": self.unit.symbol(),
            "description": self.facts(),
        });
        if let Some([low, high]) = self.ci95 {
            own["minValue"] = low.into();
            own["maxValue"] = high.into();
        }
        own
    }

    /// Metric, variant and channel in words: `mae of Fz`.
    pub(crate) fn words(&self) -> String {
        words(&self.metric, self.variant.as_deref(), &self.channel)
    }
}

/// Metric, variant and channel in words: `hysteresis.ratio of Fz`.
pub(crate) fn words(metric: &str, variant: Option<&str>, channel: &str) -> String {
    format!("{} of {channel}", full_name(metric, variant))
}

/// Claims as values of schema.org, numbered from 0.
pub(crate) fn properties(claims: &[Claim]) -> Vec<Value> {
    let numbered = claims.iter().enumerate();
    let properties = numbered.map(|(number, claim)| claim.property(number));
    properties.collect()
}

/// Unit of a score or of one of its variants; `None` for an unknown variant.
fn unit_of(score: &Score, variant: Option<&str>) -> Option<Unit> {
    variant.map_or(Some(score.unit), |name| Some(score.variant(name)?.unit))
}

/// Claims of study `study`: every number of its scores and of their variants, at the level [`Level::Form`].
pub(crate) fn claims(study: usize, report: &EvaluationReport, from: &[String]) -> Vec<Claim> {
    let mut claims = Vec::new();
    for score in &report.scores {
        let variants = score.variants.iter();
        let variants = variants.map(|variant| (Some(variant.name.as_str()), variant.unit));
        for (variant, unit) in std::iter::once((None, score.unit)).chain(variants) {
            let Some(number) = Number::of(score, variant) else {
                continue;
            };
            claims.push(Claim {
                study,
                metric: score.metric.clone(),
                channel: score.channel.clone(),
                variant: variant.map(str::to_owned),
                value: number.value,
                ci95: number.ci95,
                unit,
                n: score.n,
                definition: score.definition.clone(),
                from: from.to_vec(),
                level: Level::Form,
            });
        }
    }
    claims
}
