//! Formats scores by the rule that all reports share.

use taceva_report::FormattedValue;
use taceva_results::{Interval, ScoreLine};

/// Formats a score: value and ends of the interval, or the reason why there is no value.
pub(super) fn formatted(line: &ScoreLine<'_>) -> FormattedValue {
    FormattedValue::of(line.value, line.interval)
}

/// Reason for a missing interval, as text; `None` if there is an interval.
pub(super) fn no_interval(interval: &Interval) -> Option<String> {
    match interval {
        Interval::Absent(reason) => Some(format!("none: {reason}")),
        Interval::Ends { .. } => None,
    }
}
