//! Formatted scores, by the rule of all reports.

use taceva_report::FormattedValue;
use taceva_results::Interval;

use super::line::Line;

/// A score as printed: its value and the ends of its interval, or the reason why there is none.
pub(super) fn formatted(line: &Line<'_>) -> FormattedValue {
    FormattedValue::of(line.value, line.interval)
}

/// The reason why there is no interval, in words.
pub(super) fn no_interval(interval: &Interval) -> Option<String> {
    match interval {
        Interval::Absent(reason) => Some(format!("none: {reason}")),
        Interval::Ends { .. } => None,
    }
}
