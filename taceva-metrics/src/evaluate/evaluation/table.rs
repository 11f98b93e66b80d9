//! Tables of scores.

use std::fmt;

use taceva_core::Unit;

use super::{Evaluation, summary};
use crate::evaluate::entry::Entry;
use crate::score::Interval;
use crate::score::digits::significant;
use crate::score::value::Value;

const HEADINGS: [&str; 6] = ["metric", "channel", "value", "95% interval", "unit", "n"];

/// `{}` prints a short table: one line per channel with `mae`, `rmse`, `bias`, `r2` and `skill`. `{:#}` prints a long table: every score
/// with its interval and variants, and the skipped metrics. Without these five metrics `{}` prints the long table too.
impl fmt::Display for Evaluation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !f.alternate()
            && let Some(lines) = summary::lines(self)
        {
            write_aligned(f, &lines)?;
            return writeln!(
                f,
                "Intervals, other scores and skipped metrics: print with `{{:#}}`."
            );
        }
        let headings = HEADINGS.map(str::to_owned).to_vec();
        let rows = self.entries.iter().flat_map(rows);
        let lines: Vec<Vec<String>> = std::iter::once(headings).chain(rows).collect();
        write_aligned(f, &lines)?;
        for skipped in &self.skipped {
            writeln!(f, "skipped {}: {}", skipped.what, skipped.reason)?;
        }
        Ok(())
    }
}

/// Writes `lines` in aligned columns.
fn write_aligned(f: &mut fmt::Formatter<'_>, lines: &[Vec<String>]) -> fmt::Result {
    let width = |column: usize| {
        let lengths = lines.iter().filter_map(|line| line.get(column));
        let lengths = lengths.map(|cell| cell.chars().count());
        lengths.max().unwrap_or_default()
    };
    let columns = lines.first().map_or(0, Vec::len);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    for line in lines {
        let mut text = String::new();
        for (cell, width) in line.iter().zip(&widths) {
            text.push_str(&format!("{cell:width$}  "));
        }
        writeln!(f, "{}", text.trim_end())?;
    }
    Ok(())
}

/// Text with the number of samples, and with the number of invalid samples if there are any.
pub(super) fn counted(n: u64, n_invalid: u64) -> String {
    match n_invalid {
        0 => n.to_string(),
        left_out => format!("{n} ({left_out} invalid left out)"),
    }
}

/// Table rows of one score: first the value, then its scalar variants.
fn rows(entry: &Entry) -> Vec<Vec<String>> {
    let score = &entry.score;
    let id = entry.metric.id;
    let n = counted(score.n, score.n_invalid);
    let row = |name: String, value: &Value, interval: Option<&Interval>, unit: Unit, n: String| {
        vec![
            name,
            entry.channel.clone(),
            value.to_string(),
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
