//! JSON object of a score or variant.

mod keys;

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, Serializer};
use taceva_core::Unit;

use super::{Score, Variant};
use crate::interval::Interval;
use crate::ordered_map::Ordered;
use crate::value::Value;
use keys::Keys;

impl Serialize for Score {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        serialize_value(&mut object, &self.value, self.unit)?;
        if !matches!(self.value, Value::NotApplicable(_)) {
            self.serialize_details(&mut object)?;
        }
        object.serialize_entry("better", self.better().name())?;
        object.end()
    }
}

impl Score {
    fn serialize_details<M: SerializeMap>(&self, object: &mut M) -> Result<(), M::Error> {
        if !self.of.is_empty() {
            object.serialize_entry("of", &self.of)?;
        }
        object.serialize_entry("n", &self.n)?;
        object.serialize_entry("n_invalid", &self.n_invalid)?;
        serialize_interval(object, &self.value, self.interval.as_ref())?;
        object.serialize_entry("definition", &self.definition)?;
        if !self.parameters.is_empty() {
            object.serialize_entry("parameters", &Ordered(self.parameters.clone()))?;
        }
        if !self.counts.is_empty() {
            object.serialize_entry("counts", &Ordered(self.counts.clone()))?;
        }
        if !self.flags.is_empty() {
            object.serialize_entry("flags", &self.flags)?;
        }
        if let Some(standing) = self.standing.words() {
            object.serialize_entry("standing", standing)?;
        }
        if let Some(share) = self.bounded_share {
            object.serialize_entry("bounded_share", &share)?;
        }
        for variant in &self.variants {
            object.serialize_entry(&variant.name, variant)?;
        }
        Ok(())
    }
}

impl Serialize for Variant {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        serialize_value(&mut object, &self.value, self.unit)?;
        serialize_interval(&mut object, &self.value, self.interval.as_ref())?;
        object.end()
    }
}

/// Writes the value. Writes the unit too, unless the value is absent.
fn serialize_value<M: SerializeMap>(
    object: &mut M,
    value: &Value,
    unit: Unit,
) -> Result<(), M::Error> {
    match value {
        Value::Number(value) => object.serialize_entry("value", value)?,
        Value::Undefined(reason) => return object.serialize_entry("undefined", reason),
        Value::NotApplicable(reason) => return object.serialize_entry("not_applicable", reason),
        Value::Map(map) => {
            object.serialize_entry("x_mm", &map.x_mm)?;
            object.serialize_entry("y_mm", &map.y_mm)?;
            object.serialize_entry("values", &map.values)?;
            object.serialize_entry("counts", &map.counts)?;
        }
        Value::Curve(curve) => {
            object.serialize_entry("x", &curve.x)?;
            object.serialize_entry("x_unit", &curve.x_unit)?;
            object.serialize_entry("values", &curve.values)?;
            object.serialize_entry("counts", &curve.counts)?;
            if let Some(band) = &curve.band {
                object.serialize_entry("low", &band.low)?;
                object.serialize_entry("high", &band.high)?;
            }
        }
        Value::Matrix(matrix) => {
            object.serialize_entry("rows", &matrix.rows)?;
            object.serialize_entry("columns", &matrix.columns)?;
            object.serialize_entry("values", &matrix.values)?;
        }
    }
    object.serialize_entry("unit", &unit)
}

/// Writes the interval of a number, with its method, to the JSON `object`. Writes nothing for other values.
fn serialize_interval<M: SerializeMap>(
    object: &mut M,
    value: &Value,
    interval: Option<&Interval>,
) -> Result<(), M::Error> {
    match interval.filter(|_| value.number().is_some()) {
        Some(Interval::Ends {
            ends,
            method,
            standard_error,
            clusters,
            degrees_of_freedom,
        }) => {
            object.serialize_entry("ci95", ends)?;
            object.serialize_entry("method", method)?;
            if let Some(standard_error) = standard_error {
                object.serialize_entry("standard_error", standard_error)?;
            }
            if let Some(clusters) = clusters {
                object.serialize_entry("clusters", clusters)?;
            }
            if let Some(freedom) = degrees_of_freedom {
                object.serialize_entry("degrees_of_freedom", freedom)?;
            }
            Ok(())
        }
        Some(Interval::Absent(reason)) => object.serialize_entry(
            "ci95",
            &Reason {
                undefined: reason.clone(),
            },
        ),
        None => Ok(()),
    }
}

/// Reason for an absent interval, as JSON: `{"undefined": reason}`.
#[derive(serde::Serialize, serde::Deserialize)]
struct Reason {
    undefined: String,
}

impl<'de> Deserialize<'de> for Score {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Score, D::Error> {
        deserializer.deserialize_map(ScoreVisitor)
    }
}

struct ScoreVisitor;

impl<'de> Visitor<'de> for ScoreVisitor {
    type Value = Score;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with a value, a map, a curve, a matrix or a reason")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Score, A::Error> {
        let mut keys = Keys::default();
        while let Some(key) = map.next_key::<String>()? {
            keys.read(key, &mut map)?;
        }
        keys.score()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_variant_of_the_catalogue_is_called_like_a_key_of_a_score() {
        for metric in taceva_metrics::catalogue::ALL {
            for (name, _) in metric.variants {
                let mut score = Score::of_number("", "", 0.5, Unit::One);
                let number = Score::of_number("", "", 0.25, Unit::Millimetre);
                score.variants.push(Variant {
                    name: (*name).to_owned(),
                    value: number.value,
                    unit: number.unit,
                    interval: Some(Interval::Absent("one point".to_owned())),
                });
                let text = serde_json::to_string(&score).expect("written");
                let read: Score = serde_json::from_str(&text)
                    .unwrap_or_else(|error| panic!("{}.{name}: {error}", metric.id));
                assert_eq!(read, score, "{}.{name}", metric.id);
            }
        }
    }
}
