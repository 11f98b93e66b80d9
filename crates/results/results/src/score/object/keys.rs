//! Reads the keys of a score's JSON object.

use serde::de::{Deserialize, Deserializer, Error, MapAccess};
use taceva_core::{Unit, shown};
use taceva_metrics::{Band, Curve, Map, Matrix, Standing};

use super::Reason;
use crate::interval::Interval;
use crate::ordered_map::Ordered;
use crate::score::{Score, Variant};
use crate::value::Value;

/// Values of all keys of a score or variant; `None` for a key that the JSON object lacks.
#[derive(Default)]
pub(super) struct Keys {
    value: Option<f64>,
    undefined: Option<String>,
    not_applicable: Option<String>,
    unit: Option<Unit>,
    x: Option<Vec<f64>>,
    x_unit: Option<Unit>,
    x_mm: Option<Vec<f64>>,
    y_mm: Option<Vec<f64>>,
    rows: Option<Vec<String>>,
    columns: Vec<String>,
    values: Option<Values>,
    low: Option<Vec<Option<f64>>>,
    high: Vec<Option<f64>>,
    counts: Option<Counts>,
    of: Vec<String>,
    n: u64,
    n_invalid: u64,
    ci95: Option<Ends>,
    method: Option<String>,
    standard_error: Option<f64>,
    clusters: Option<u64>,
    degrees_of_freedom: Option<f64>,
    definition: String,
    parameters: Ordered<f64>,
    flags: Vec<String>,
    standing: Standing,
    bounded_share: Option<f64>,
    variants: Vec<Variant>,
}

/// Values of a curve (list), or of a map or matrix (grid).
#[derive(serde::Deserialize)]
#[serde(untagged, expecting = "a list or grid of numbers and nulls")]
enum Values {
    Levels(Vec<Option<f64>>),
    Grid(Vec<Vec<Option<f64>>>),
}

/// Number of samples behind each value of a curve (list) or map (grid), or named counts of a computation.
#[derive(serde::Deserialize)]
#[serde(untagged, expecting = "counts")]
enum Counts {
    Levels(Vec<u64>),
    Grid(Vec<Vec<u64>>),
    Named(Ordered<u64>),
}

/// Both ends of an interval, or the reason for their absence.
#[derive(serde::Deserialize)]
#[serde(untagged, expecting = "two ends or a reason")]
enum Ends {
    Known([f64; 2]),
    Absent(Reason),
}

impl Keys {
    pub(super) fn read<'de, A: MapAccess<'de>>(
        &mut self,
        key: String,
        map: &mut A,
    ) -> Result<(), A::Error> {
        match key.as_str() {
            "value" => self.value = Some(map.next_value()?),
            "undefined" => self.undefined = Some(map.next_value()?),
            "not_applicable" => self.not_applicable = Some(map.next_value()?),
            "unit" => self.unit = Some(map.next_value()?),
            "x" => self.x = Some(map.next_value()?),
            "x_unit" => self.x_unit = Some(map.next_value()?),
            "x_mm" => self.x_mm = Some(map.next_value()?),
            "y_mm" => self.y_mm = Some(map.next_value()?),
            "rows" => self.rows = Some(map.next_value()?),
            "columns" => self.columns = map.next_value()?,
            "values" => self.values = Some(map.next_value()?),
            "low" => self.low = Some(map.next_value()?),
            "high" => self.high = map.next_value()?,
            "counts" => self.counts = Some(map.next_value()?),
            "of" => self.of = map.next_value()?,
            "n" => self.n = map.next_value()?,
            "n_invalid" => self.n_invalid = map.next_value()?,
            "ci95" => self.ci95 = Some(map.next_value()?),
            "method" => self.method = Some(map.next_value()?),
            "standard_error" => self.standard_error = Some(map.next_value()?),
            "clusters" => self.clusters = Some(map.next_value()?),
            "degrees_of_freedom" => self.degrees_of_freedom = Some(map.next_value()?),
            "definition" => self.definition = map.next_value()?,
            "parameters" => self.parameters = map.next_value()?,
            "flags" => self.flags = map.next_value()?,
            "standing" => self.standing = map.next_value::<Words>()?.0,
            "bounded_share" => self.bounded_share = Some(map.next_value()?),
            // The direction comes from the catalogue instead.
            "better" => drop(map.next_value::<String>()?),
            _ => {
                let Score {
                    value,
                    unit,
                    interval,
                    ..
                } = map.next_value()?;
                self.variants.push(Variant {
                    name: key,
                    value,
                    unit,
                    interval,
                });
            }
        }
        Ok(())
    }

    /// Creates the score from the keys. The caller sets its metric and its channel.
    pub(super) fn score<E: Error>(mut self) -> Result<Score, E> {
        let interval = self.interval();
        let counts = match self.counts.take() {
            Some(Counts::Named(counts)) => counts.0,
            other => {
                self.counts = other;
                Vec::new()
            }
        };
        let (value, unit) = match (self.undefined.take(), self.not_applicable.take()) {
            (Some(reason), _) => (Value::Undefined(reason), Unit::One),
            (None, Some(reason)) => (Value::NotApplicable(reason), Unit::One),
            (None, None) => {
                let unit = self.unit.ok_or_else(|| E::missing_field("unit"))?;
                (self.known_value()?, unit)
            }
        };
        Ok(Score {
            metric: String::new(),
            channel: String::new(),
            value,
            unit,
            n: self.n,
            n_invalid: self.n_invalid,
            interval,
            definition: self.definition,
            parameters: self.parameters.0,
            counts,
            flags: self.flags,
            standing: self.standing,
            bounded_share: self.bounded_share,
            of: self.of,
            variants: self.variants,
        })
    }

    fn interval(&mut self) -> Option<Interval> {
        Some(match self.ci95.take()? {
            Ends::Absent(reason) => Interval::Absent(reason.undefined),
            Ends::Known(ends) => Interval::Ends {
                ends,
                method: self.method.take().unwrap_or_else(|| "unstated".to_owned()),
                standard_error: self.standard_error,
                clusters: self.clusters,
                degrees_of_freedom: self.degrees_of_freedom,
            },
        })
    }

    fn known_value<E: Error>(&mut self) -> Result<Value, E> {
        if let Some(number) = self.value {
            return Ok(Value::Number(number));
        }
        let (values, counts) = (self.values.take(), self.counts.take());
        if let Some(x_mm) = self.x_mm.take() {
            let y_mm = self.y_mm.take().ok_or_else(|| E::missing_field("y_mm"))?;
            return match (values, counts) {
                (Some(Values::Grid(values)), Some(Counts::Grid(counts)))
                    if fills(&values, &x_mm, &y_mm) && fills(&counts, &x_mm, &y_mm) =>
                {
                    Ok(Value::Map(Map::new(x_mm, y_mm, values, counts)))
                }
                _ => Err(shape()),
            };
        }
        if let Some(x) = self.x.take() {
            let x_unit = self.x_unit.ok_or_else(|| E::missing_field("x_unit"))?;
            let high = std::mem::take(&mut self.high);
            let band = self.low.take().map(|low| Band { low, high });
            let levels = x.len();
            let fits = |band: &Band| band.low.len() == levels && band.high.len() == levels;
            return match (values.unwrap_or(Values::Levels(Vec::new())), counts) {
                (Values::Levels(values), Some(Counts::Levels(counts)))
                    if values.len() == levels
                        && counts.len() == levels
                        && band.as_ref().is_none_or(fits) =>
                {
                    Ok(Value::Curve(
                        Curve::new(x, x_unit, values, counts).with_band(band),
                    ))
                }
                _ => Err(shape()),
            };
        }
        if let Some(rows) = self.rows.take() {
            let columns = std::mem::take(&mut self.columns);
            let values = match values {
                Some(Values::Grid(values)) => values,
                // An empty list fits both.
                Some(Values::Levels(values)) if values.is_empty() => Vec::new(),
                _ => return Err(shape()),
            };
            return match values.len() == rows.len()
                && values.iter().all(|row| row.len() == columns.len())
            {
                true => Ok(Value::Matrix(Matrix::new(rows, columns, values))),
                false => Err(shape()),
            };
        }
        Err(E::custom(
            "the score has none of the keys `value`, `x`, `x_mm`, `rows`, `undefined` and `not_applicable`",
        ))
    }
}

/// True if `grid` has one row between each two neighbouring edges `y`, and each row one cell between two neighbouring edges `x`.
fn fills<T>(grid: &[Vec<T>], x: &[f64], y: &[f64]) -> bool {
    grid.len() + 1 == y.len() && grid.iter().all(|row| row.len() + 1 == x.len())
}

fn shape<E: Error>() -> E {
    E::custom("expected one value for each place, found another number of values")
}

/// Standing of a score in verdicts, parsed from its text in JSON.
struct Words(Standing);

impl<'de> Deserialize<'de> for Words {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Words, D::Error> {
        let words = String::deserialize(deserializer)?;
        let standing = Standing::from_words(&words).ok_or_else(|| {
            let known = Standing::ALL.into_iter().filter_map(Standing::words);
            let known: Vec<String> = known.map(|words| format!("`{words}`")).collect();
            D::Error::custom(format!(
                "expected one of {}, found `{}`",
                known.join(", "),
                shown(&words)
            ))
        })?;
        Ok(Words(standing))
    }
}
