//! Values of this program next to the values that the TacEva study prints.

use crate::catalogue::{Published, find};
use crate::number::{FormattedValue, fixed};
use crate::results::Study;
use crate::scores::{BARRED, ScoreTable};
use crate::table::{Cell, Estimate};

/// Sensors of the TacEva study, in the order of its tables.
pub(super) const SENSORS: [&str; 4] = ["ViTacTip", "MagicTac", "GelSight", "GelSightWM"];

/// Number format of a table in the TacEva study.
#[derive(Clone, Copy, Debug)]
pub(super) enum Digits {
    /// Number of significant digits.
    Significant(i32),
    /// Percent with one decimal.
    Percent,
}

impl Digits {
    /// Formats a number as in the TacEva study.
    pub(super) fn print(self, number: f64) -> String {
        match self {
            Digits::Percent => format!("{} %", fixed(100.0 * number, 1)),
            Digits::Significant(digits) => {
                let size = number.abs();
                let needed =
                    |decimals: &i32| size * 10_f64.powi(*decimals) >= 10_f64.powi(digits - 1);
                let decimals = (0..8).find(needed).unwrap_or(digits);
                fixed(number, decimals.unsigned_abs() as usize)
            }
        }
    }
}

/// Score of a metric and channel next to the published number; a dash if the score is missing.
pub(super) fn cell(
    studies: &[Study],
    scores: &ScoreTable,
    at: usize,
    of: [&str; 2],
    digits: Digits,
) -> Cell {
    let [metric, channel] = of;
    let mut rows = scores.rows.iter();
    let row = rows.find(|row| row.metric == metric && row.channel == channel);
    let found = row.and_then(|row| row.cells[at].as_ref());
    let ours = found.and_then(|cell| cell.value);
    let printed = printed(&studies[at], metric, channel);
    let mut estimate = beside(ours, printed, digits);
    if let Some(cell) = found.filter(|cell| cell.value.is_some()) {
        estimate.is_best = cell.is_best;
        estimate.mark = if cell.takes_part() { "" } else { BARRED };
    }
    Cell::Estimate(estimate)
}

/// Value of this program next to a published value.
pub(super) fn beside(ours: Option<f64>, printed: Option<f64>, digits: Digits) -> Estimate {
    let below = printed.map(|printed| {
        let shown = digits.print(printed);
        match ours {
            Some(ours) if printed.abs() > 0.0 => format!("{shown} (×{})", ratio(ours / printed)),
            _ => shown,
        }
    });
    Estimate {
        formatted: FormattedValue {
            value: ours.map_or_else(|| "–".to_owned(), |ours| digits.print(ours)),
            ..FormattedValue::default()
        },
        remark: below,
        ..Estimate::default()
    }
}

/// Published number for the sensor of `study`; `None` if the TacEva study states no number.
pub(super) fn printed(study: &Study, metric: &str, channel: &str) -> Option<f64> {
    let sensor = find(&study.sensor)?;
    let is_meant = |result: &&Published| result.metric == metric && result.channel == channel;
    let found = sensor.results.iter().find(is_meant);
    found
        .filter(|result| result.source == "study")
        .map(|result| result.value)
}

/// Ratio with two decimals, or fewer if the ratio is large.
fn ratio(ratio: f64) -> String {
    match ratio.abs() {
        size if size >= 100.0 => fixed(ratio, 0),
        size if size >= 10.0 => fixed(ratio, 1),
        _ => fixed(ratio, 2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_printed_zero_has_no_ratio_and_a_value_alone_no_printed_number() {
        let words = |ours, printed| Cell::Estimate(beside(ours, printed, Digits::Percent)).plain();
        assert_eq!(words(Some(0.02), Some(0.04)), "2.0 %, 4.0 % (×0.50)");
        assert_eq!(words(Some(0.02), Some(0.0)), "2.0 %, 0.0 %");
        assert_eq!(words(Some(0.02), None), "2.0 %");
        assert_eq!(words(None, Some(0.04)), "–, 4.0 %");
    }

    #[test]
    fn numbers_have_the_digits_of_the_table() {
        let print = |number| Digits::Significant(4).print(number);
        assert_eq!(
            [0.010_234, 1.069, 12.5, 1257.4].map(print),
            ["0.01023", "1.069", "12.50", "1257"]
        );
    }
}
