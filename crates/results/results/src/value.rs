//! Values of scores.

use taceva_metrics::{Curve, Map, Matrix};

/// Value of a score, or the reason for its absence.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// One finite number.
    Number(f64),
    /// One number per place of the sensing surface.
    Map(Map),
    /// One number per level of another quantity, such as the force.
    Curve(Curve),
    /// One number per pair of a row name and a column name.
    Matrix(Matrix),
    /// The value is undefined for the given samples. Contains the reason.
    Undefined(String),
    /// The metric does not apply. Contains the reason.
    NotApplicable(String),
}

impl Value {
    /// Converts a value of `taceva-metrics`.
    pub fn of(value: &taceva_metrics::Value) -> Value {
        match value {
            taceva_metrics::Value::Scalar(number) => Value::Number(*number),
            taceva_metrics::Value::Map(map) => Value::Map(map.clone()),
            taceva_metrics::Value::Curve(curve) => Value::Curve(curve.clone()),
            taceva_metrics::Value::Matrix(matrix) => Value::Matrix(matrix.clone()),
            taceva_metrics::Value::NotApplicable(reason) => {
                Value::NotApplicable(reason.to_string())
            }
            taceva_metrics::Value::Undefined(reason) => Value::Undefined(reason.to_string()),
            other => Value::Undefined(format!("a value of another version: {other:?}")),
        }
    }

    /// The number; `None` for any other value.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// True for a map, a curve or a matrix.
    pub fn is_of_many(&self) -> bool {
        matches!(self, Value::Map(_) | Value::Curve(_) | Value::Matrix(_))
    }

    /// Reason for the absence of the value, in words; `None` if the value is present.
    pub fn reason(&self) -> Option<String> {
        match self {
            Value::Undefined(reason) => Some(format!("undefined: {reason}")),
            Value::NotApplicable(reason) => Some(format!("not applicable: {reason}")),
            _ => None,
        }
    }
}
