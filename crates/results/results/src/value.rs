//! Values of scores.

use taceva_metrics::{Curve, Map, Matrix};

/// Value of a score, or the reason why there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// One finite number.
    Number(f64),
    /// A number for each place of the sensing surface.
    Map(Map),
    /// A number for each level of another quantity.
    Curve(Curve),
    /// A number for each pair of names.
    Matrix(Matrix),
    /// No value, since the samples determine none: the reason.
    Undefined(String),
    /// No value, since the question does not arise: the reason.
    NotApplicable(String),
}

impl Value {
    /// The value that `taceva-metrics` computed.
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

    /// The number, if the value is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The reason why there is no value, in words.
    pub fn reason(&self) -> Option<String> {
        match self {
            Value::Undefined(reason) => Some(format!("undefined: {reason}")),
            Value::NotApplicable(reason) => Some(format!("not applicable: {reason}")),
            _ => None,
        }
    }
}
