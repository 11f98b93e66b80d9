//! Serialization of an evaluation as the keys `metrics` and `skipped` of a report.

use serde::ser::{Serialize, SerializeMap, SerializeStruct, Serializer};
use taceva_core::{Skipped, Unit};

use super::Evaluation;
use crate::evaluate::entry::Entry;
use crate::score::value::Value;
use crate::score::{Interval, Score, Variant};

impl Serialize for Evaluation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut report = serializer.serialize_struct("Evaluation", 2)?;
        report.serialize_field("metrics", &ByMetric(&self.entries))?;
        let skipped: Vec<Left> = self.skipped.iter().map(Left).collect();
        report.serialize_field("skipped", &skipped)?;
        report.end()
    }
}

/// `{"mae": {"Fz": …}}`: scores grouped by metric.
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
        serializer.collect_map(self.0.iter().map(|entry| (&entry.channel, OfMetric(entry))))
    }
}

/// A score, with the direction of its metric.
struct OfMetric<'a>(&'a Entry);

impl Serialize for OfMetric<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut score = serializer.serialize_map(None)?;
        self.0.score.serialize_into(&mut score)?;
        score.serialize_entry("better", self.0.metric.better.name())?;
        score.end()
    }
}

impl Serialize for Score {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut score = serializer.serialize_map(None)?;
        self.serialize_into(&mut score)?;
        score.end()
    }
}

impl Score {
    fn serialize_into<M: SerializeMap>(&self, score: &mut M) -> Result<(), M::Error> {
        serialize_value(score, &self.value, self.unit)?;
        if matches!(self.value, Value::NotApplicable(_)) {
            return Ok(());
        }
        if !self.of.is_empty() {
            score.serialize_entry("of", &self.of)?;
        }
        score.serialize_entry("n", &self.n)?;
        score.serialize_entry("n_invalid", &self.n_invalid)?;
        serialize_interval(score, &self.value, Some(&self.interval))?;
        score.serialize_entry("definition", self.definition)?;
        if !self.parameters.is_empty() {
            let parameters = self.parameters.iter();
            let by_name = parameters.map(|parameter| (parameter.name, parameter.value));
            score.serialize_entry("parameters", &Entries(by_name.collect()))?;
        }
        if !self.counts.is_empty() {
            let by_name = self.counts.iter().map(|count| (count.name, count.value));
            score.serialize_entry("counts", &Entries(by_name.collect()))?;
        }
        if !self.flags.is_empty() {
            let flags: Vec<String> = self.flags.iter().map(ToString::to_string).collect();
            score.serialize_entry("flags", &flags)?;
        }
        if let Some(standing) = self.standing.words() {
            score.serialize_entry("standing", standing)?;
        }
        if let Some(share) = self.bounded_share {
            score.serialize_entry("bounded_share", &share)?;
        }
        for variant in &self.variants {
            score.serialize_entry(&variant.name, variant)?;
        }
        Ok(())
    }
}

impl Serialize for Variant {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut variant = serializer.serialize_map(None)?;
        serialize_value(&mut variant, &self.value, self.unit)?;
        serialize_interval(&mut variant, &self.value, self.interval.as_ref())?;
        variant.end()
    }
}

/// Writes the map entries of `value`, and the unit of a defined value.
fn serialize_value<M: SerializeMap>(
    into: &mut M,
    value: &Value,
    unit: Unit,
) -> Result<(), M::Error> {
    match value {
        Value::Scalar(value) => into.serialize_entry("value", value)?,
        Value::Undefined(reason) => {
            return into.serialize_entry("undefined", &reason.to_string());
        }
        Value::NotApplicable(reason) => {
            return into.serialize_entry("not_applicable", &reason.to_string());
        }
        Value::Map(map) => {
            into.serialize_entry("x_mm", &map.x_mm)?;
            into.serialize_entry("y_mm", &map.y_mm)?;
            into.serialize_entry("values", &map.values)?;
            into.serialize_entry("counts", &map.counts)?;
        }
        Value::Curve(curve) => {
            into.serialize_entry("x", &curve.x)?;
            into.serialize_entry("x_unit", &curve.x_unit)?;
            into.serialize_entry("values", &curve.values)?;
            into.serialize_entry("counts", &curve.counts)?;
            if let Some(band) = &curve.band {
                into.serialize_entry("low", &band.low)?;
                into.serialize_entry("high", &band.high)?;
            }
        }
        Value::Matrix(matrix) => {
            into.serialize_entry("rows", &matrix.rows)?;
            into.serialize_entry("columns", &matrix.columns)?;
            into.serialize_entry("values", &matrix.values)?;
        }
    }
    into.serialize_entry("unit", &unit)
}

/// Writes the interval of a number with its method, standard error and clusters.
fn serialize_interval<M: SerializeMap>(
    into: &mut M,
    value: &Value,
    interval: Option<&Interval>,
) -> Result<(), M::Error> {
    let Some(interval) = interval.filter(|_| value.scalar().is_some()) else {
        return Ok(());
    };
    into.serialize_entry("ci95", interval)?;
    if let Some(method) = interval.method() {
        into.serialize_entry("method", &method)?;
    }
    if let Some(standard_error) = interval.standard_error() {
        into.serialize_entry("standard_error", &standard_error)?;
    }
    if let Some(clusters) = interval.clusters() {
        into.serialize_entry("clusters", &clusters)?;
    }
    if let Some(freedom) = interval.freedom() {
        into.serialize_entry("degrees_of_freedom", &freedom)?;
    }
    Ok(())
}

/// Serializes the interval as `[low, high]`, or as `{"undefined": reason}`.
impl Serialize for Interval {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match (self, self.ends()) {
            (_, Some(ends)) => ends.serialize(serializer),
            (Interval::Undefined(reason), None) => {
                serializer.collect_map([("undefined", reason.to_string())])
            }
            (_, None) => serializer.serialize_none(),
        }
    }
}

/// Map entries in insertion order.
struct Entries<T>(Vec<(&'static str, T)>);

impl<T: Serialize> Serialize for Entries<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// A skipped metric, serialized as `{"what": …, "reason": …}`.
struct Left<'a>(&'a Skipped);

impl Serialize for Left<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut left = serializer.serialize_struct("Skipped", 2)?;
        left.serialize_field("what", &self.0.what)?;
        left.serialize_field("reason", &self.0.reason.to_string())?;
        left.end()
    }
}
