//! Scores as the keys `metrics` and `skipped` of a report.

use serde::ser::{Serialize, SerializeMap, SerializeStruct, Serializer};
use taceva_core::Skipped;

use super::{Entry, Evaluation};
use crate::score::{Interval, Parameter, Score};
use crate::value::Value;

impl Serialize for Evaluation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut report = serializer.serialize_struct("Evaluation", 2)?;
        report.serialize_field("metrics", &ByMetric(&self.entries))?;
        let skipped: Vec<Left> = self.skipped.iter().map(Left).collect();
        report.serialize_field("skipped", &skipped)?;
        report.end()
    }
}

/// `{"mae": {"Fz": …}}`: scores of a metric stand side by side.
struct ByMetric<'a>(&'a [Entry]);

impl Serialize for ByMetric<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut metrics = serializer.serialize_map(None)?;
        for of_one in self
            .0
            .chunk_by(|left, right| left.metric.id == right.metric.id)
        {
            metrics.serialize_entry(of_one[0].metric.id, &ByChannel(of_one))?;
        }
        metrics.end()
    }
}

struct ByChannel<'a>(&'a [Entry]);

impl Serialize for ByChannel<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|entry| (&entry.channel, &entry.score)))
    }
}

impl Serialize for Score {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut score = serializer.serialize_map(None)?;
        match &self.value {
            Value::Scalar(value) => {
                score.serialize_entry("value", value)?;
                score.serialize_entry("unit", &self.unit)?;
            }
            Value::Undefined(reason) => {
                score.serialize_entry("undefined", &reason.to_string())?;
            }
            Value::NotApplicable(reason) => {
                score.serialize_entry("not_applicable", &reason.to_string())?;
                return score.end();
            }
        }
        if !self.of.is_empty() {
            score.serialize_entry("of", &self.of)?;
        }
        score.serialize_entry("n", &self.n)?;
        score.serialize_entry("n_invalid", &self.n_invalid)?;
        if self.value.scalar().is_some() {
            score.serialize_entry("ci95", &self.interval)?;
            if let Some(method) = self.interval.method() {
                score.serialize_entry("method", &method)?;
            }
        }
        score.serialize_entry("definition", self.definition)?;
        if !self.parameters.is_empty() {
            score.serialize_entry("parameters", &ByName(&self.parameters))?;
        }
        score.end()
    }
}

/// `[low, high]`, or `{"undefined": reason}`.
impl Serialize for Interval {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Interval::Jackknife { low, high, .. } | Interval::Bootstrap { low, high, .. } => {
                [low, high].serialize(serializer)
            }
            Interval::Undefined(reason) => {
                serializer.collect_map([("undefined", reason.to_string())])
            }
        }
    }
}

struct ByName<'a>(&'a [Parameter]);

impl Serialize for ByName<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let parameters = self.0.iter();
        serializer.collect_map(parameters.map(|parameter| (parameter.name, parameter.value)))
    }
}

/// `{"what": …, "reason": …}`.
struct Left<'a>(&'a Skipped);

impl Serialize for Left<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut left = serializer.serialize_struct("Skipped", 2)?;
        left.serialize_field("what", &self.0.what)?;
        left.serialize_field("reason", &self.0.reason.to_string())?;
        left.end()
    }
}
