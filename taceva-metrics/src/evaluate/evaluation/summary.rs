//! Short table of scores: one line per channel.

use taceva_core::Unit;

use super::Evaluation;
use super::table::counted;
use crate::evaluate::metric::Metric;
use crate::score::Score;
use crate::score::value::Value;

/// Metrics of the short table, one column each.
const COLUMNS: [&str; 5] = ["mae", "rmse", "bias", "r2", "skill"];

/// Lines of the short table, headings first; `None` if the evaluation has none of the table's metrics.
pub(super) fn lines(evaluation: &Evaluation) -> Option<Vec<Vec<String>>> {
    let computed = |id: &&str| {
        let mut metrics = evaluation.entries.iter().map(|entry| entry.metric);
        metrics.find(|metric| metric.id == *id)
    };
    let columns: Vec<&'static Metric> = COLUMNS.iter().filter_map(computed).collect();
    if columns.is_empty() {
        return None;
    }
    let mut channels: Vec<&str> = Vec::new();
    for (metric, channel, _) in evaluation.scores() {
        if COLUMNS.contains(&metric.id) && !channels.contains(&channel) {
            channels.push(channel);
        }
    }
    let mut headings = vec!["channel".to_owned()];
    headings.extend(columns.iter().map(|metric| metric.better.beside(metric.id)));
    headings.push("n".to_owned());
    let mut lines = vec![headings];
    for channel in channels {
        let scores: Vec<Option<&Score>> = columns
            .iter()
            .map(|metric| evaluation.score(metric.id, channel))
            .collect();
        let counts = scores
            .iter()
            .flatten()
            .map(|score| (score.n, score.n_invalid));
        let (n, n_invalid) = counts.max().unwrap_or_default();
        let mut line = vec![channel.to_owned()];
        line.extend(scores.into_iter().map(cell));
        line.push(counted(n, n_invalid));
        lines.push(line);
    }
    Some(lines)
}

/// Text of one score: the value with its unit, or `undefined`. Empty for an absent score or another kind of value.
fn cell(score: Option<&Score>) -> String {
    let Some(score) = score else {
        return String::new();
    };
    match &score.value {
        value @ Value::Scalar(_) if score.unit == Unit::One => value.to_string(),
        value @ Value::Scalar(_) => format!("{value} {}", score.unit),
        Value::Undefined(_) => "undefined".to_owned(),
        _ => String::new(),
    }
}
