//! Numbers as people read them: as many digits as their interval supports.

use taceva_metrics::{Interval, Value};

use super::line::Line;

/// The value of a score and the ends of its interval, to the digit that the interval supports.
pub(super) struct Printed {
    /// The value; empty if there is none.
    pub(super) value: String,
    /// `[low, high]`; empty if there is none.
    pub(super) interval: Option<[String; 2]>,
    /// Why there is no value, or no interval.
    pub(super) reason: Option<String>,
}

impl Printed {
    pub(super) fn of(line: &Line<'_>) -> Printed {
        let Value::Scalar(value) = *line.value else {
            return Printed {
                value: String::new(),
                interval: None,
                reason: Some(reason(line.value)),
            };
        };
        let ends = line.interval.and_then(Interval::ends);
        // Without an interval, or with one of no width, four digits.
        let step = ends.map(|[low, high]| (high - low) / 20.0);
        let step = step.filter(|step| *step > 0.0).unwrap_or(value / 1e3);
        let decimals = if step.abs() > 0.0 { decimals(step) } else { 0 };
        let print = |number: f64| format!("{number:.decimals$}");
        Printed {
            value: print(value),
            interval: ends.map(|ends| ends.map(print)),
            reason: line.interval.and_then(no_interval),
        }
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

/// Decimals that show a step of `step`, from 0 to 12.
fn decimals(step: f64) -> usize {
    (0..12)
        .find(|&decimals| 10_f64.powi(-decimals) <= step.abs())
        .map_or(12, |decimals| decimals.unsigned_abs() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_shown_with_the_decimals_it_needs() {
        assert_eq!(
            [20.0, 1.0, 0.5, 0.1, 0.0004, 0.0].map(decimals),
            [0, 0, 1, 1, 4, 12]
        );
    }
}
