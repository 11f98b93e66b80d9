//! Scores as a table for people.

use std::fmt;

use taceva_core::Unit;

use super::Evaluation;
use crate::evaluate::entry::Entry;
use crate::score::Interval;
use crate::score::value::Value;

const HEADINGS: [&str; 6] = ["metric", "channel", "value", "95% interval", "unit", "n"];

/// Digits of a printed number; the report has all of them.
const SIGNIFICANT_DIGITS: i32 = 4;

impl fmt::Display for Evaluation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows: Vec<[String; 6]> = std::iter::once(HEADINGS.map(str::to_owned))
            .chain(self.entries.iter().flat_map(rows))
            .collect();
        let widths: [usize; 6] = std::array::from_fn(|column| {
            let lengths = rows.iter().map(|row| row[column].chars().count());
            lengths.max().unwrap_or_default()
        });
        for row in &rows {
            let mut line = String::new();
            for (cell, width) in row.iter().zip(widths) {
                line.push_str(&format!("{cell:width$}  "));
            }
            writeln!(f, "{}", line.trim_end())?;
        }
        for skipped in &self.skipped {
            writeln!(f, "skipped {}: {}", skipped.what, skipped.reason)?;
        }
        Ok(())
    }
}

/// The score, then its variants that are one number.
fn rows(entry: &Entry) -> Vec<[String; 6]> {
    let score = &entry.score;
    let id = entry.metric.id;
    let n = match score.n_invalid {
        0 => score.n.to_string(),
        left_out => format!("{} ({left_out} invalid left out)", score.n),
    };
    let row = |name: String, value: &Value, interval: Option<&Interval>, unit: Unit, n: String| {
        [
            name,
            entry.channel.clone(),
            said(value),
            interval_said(value, interval),
            unit.to_string(),
            n,
        ]
    };
    let interval = Some(&score.interval);
    let mut rows = vec![row(
        entry.metric.better.beside(id),
        &score.value,
        interval,
        score.unit,
        n,
    )];
    let variants = score.variants.iter();
    let numbers = variants.filter(|variant| !is_many(&variant.value));
    rows.extend(numbers.map(|variant| {
        let better = entry.metric.better_of(&variant.name);
        let name = better.beside(&format!("{id}.{}", variant.name));
        let interval = variant.interval.as_ref();
        row(name, &variant.value, interval, variant.unit, String::new())
    }));
    rows
}

fn is_many(value: &Value) -> bool {
    matches!(value, Value::Map(_) | Value::Curve(_) | Value::Matrix(_))
}

fn said(value: &Value) -> String {
    match value {
        Value::Scalar(value) => significant(*value),
        Value::Undefined(reason) => format!("undefined: {reason}"),
        Value::NotApplicable(reason) => format!("not applicable: {reason}"),
        Value::Map(_) => "a map".to_owned(),
        Value::Curve(_) => "a curve".to_owned(),
        Value::Matrix(_) => "a matrix".to_owned(),
    }
}

fn interval_said(value: &Value, interval: Option<&Interval>) -> String {
    match (value, interval) {
        (Value::Scalar(_), Some(Interval::Undefined(reason))) => format!("none: {reason}"),
        (Value::Scalar(_), Some(interval)) => match interval.ends() {
            Some(ends) => format!("[{}]", ends.map(significant).join(", ")),
            None => String::new(),
        },
        _ => String::new(),
    }
}

/// `value` to four digits: plain if that is short, else with an exponent.
fn significant(value: f64) -> String {
    let scientific = format!("{value:.*e}", usize_of(SIGNIFICANT_DIGITS - 1));
    let exponent: i32 = scientific
        .rsplit('e')
        .next()
        .and_then(|exponent| exponent.parse().ok())
        .unwrap_or_default();
    match SIGNIFICANT_DIGITS - 1 - exponent {
        decimals @ 0..=7 => format!("{value:.*}", usize_of(decimals)),
        _ => scientific,
    }
}

fn usize_of(digits: i32) -> usize {
    usize::try_from(digits).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits_whatever_their_size() {
        let written = [0.0361, -12.5, 9999.6, 0.0, 0.000_123_456, 1.0e-9].map(significant);
        assert_eq!(
            written,
            [
                "0.03610",
                "-12.50",
                "1.000e4",
                "0.000",
                "0.0001235",
                "1.000e-9"
            ]
        );
    }
}
