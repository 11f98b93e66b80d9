//! Scores as people read them, by the rule that all reports share.

use taceva_metrics::{Interval, Value};
use taceva_report::FormattedValue;

use super::line::Line;

/// A score as printed: its value and the ends of its interval, or why there is none.
pub(super) fn formatted(line: &Line<'_>) -> FormattedValue {
    let Value::Scalar(value) = *line.value else {
        return FormattedValue {
            reason: Some(reason(line.value)),
            ..FormattedValue::default()
        };
    };
    FormattedValue {
        reason: line.interval.and_then(no_interval),
        ..FormattedValue::number(value, line.interval.and_then(Interval::ends))
    }
}

/// Why there is no interval, in words.
pub(super) fn no_interval(interval: &Interval) -> Option<String> {
    match interval {
        Interval::Undefined(reason) => Some(format!("none: {reason}")),
        _ => None,
    }
}

/// Why there is no value, in words.
pub(super) fn reason(value: &Value) -> String {
    match value {
        Value::Undefined(reason) => format!("undefined: {reason}"),
        Value::NotApplicable(reason) => format!("not applicable: {reason}"),
        Value::Map(_) => "a map: see --format json".to_owned(),
        Value::Curve(_) => "a curve: see --format json".to_owned(),
        Value::Matrix(_) => "a matrix: see --format json".to_owned(),
        _ => String::new(),
    }
}
