//! Numbers as people read them: as many digits as their interval supports.

use taceva_core::Unit;

use crate::results::{Interval, Score, Value};

/// A value and the ends of its interval, to the digit that the interval supports.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Printed {
    /// The value; empty if there is none.
    pub value: String,
    /// Both ends of the interval, if there is one.
    pub interval: Option<[String; 2]>,
    /// Why there is no value, or no interval.
    pub reason: Option<String>,
}

impl Printed {
    /// Prints `value` to a twentieth of the width of `interval`; without one to four digits.
    pub fn of(value: &Value, interval: Option<&Interval>) -> Printed {
        let Some(number) = value.number() else {
            return Printed {
                reason: value.reason().or_else(|| Some(what(value).to_owned())),
                ..Printed::default()
            };
        };
        let ends = interval.and_then(Interval::ends);
        let step = ends.map(|[low, high]| (high - low) / 20.0);
        let step = step.filter(|step| *step > 0.0).unwrap_or(number / 1e3);
        let decimals = if step.abs() > 0.0 { decimals(step) } else { 0 };
        let print = |number: f64| format!("{number:.decimals$}");
        Printed {
            value: print(number),
            interval: ends.map(|ends| ends.map(print)),
            reason: match interval {
                Some(Interval::Absent(reason)) => Some(format!("none: {reason}")),
                _ => None,
            },
        }
    }
}

/// A score as one phrase: `0.55 mm (0.34 … 0.76)`, or why there is none.
pub fn with_interval(score: &Score) -> String {
    let printed = Printed::of(&score.value, score.interval.as_ref());
    if printed.value.is_empty() {
        return printed.reason.unwrap_or_default();
    }
    let unit = spaced(score.unit);
    match printed.interval {
        Some([low, high]) => format!("{}{unit} ({low} … {high})", printed.value),
        None => format!("{}{unit}", printed.value),
    }
}

/// ` N`, or nothing for a ratio.
pub fn spaced(unit: Unit) -> String {
    match unit {
        Unit::One => String::new(),
        unit => format!(" {unit}"),
    }
}

fn what(value: &Value) -> &'static str {
    match value {
        Value::Map(_) => "a map: see --format json",
        Value::Curve(_) => "a curve: see --format json",
        Value::Matrix(_) => "a matrix: see --format json",
        _ => "",
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
