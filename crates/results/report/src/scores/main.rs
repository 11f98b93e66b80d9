//! Main scores of a paper.

use super::{ScoreRow, ScoreTable};

/// Metrics shown, in order.
const METRICS: [&str; 9] = [
    "mae",
    "r2",
    "sr",
    "sensitivity",
    "uniformity",
    "r_spatial",
    "r_light",
    "repeatability",
    "hysteresis",
];
/// Metrics limited to depth and normal force, as rows of planes would repeat them.
const OF_NORMAL: [&str; 3] = ["r_spatial", "r_light", "repeatability"];

impl ScoreTable {
    /// Main rows of a paper: accuracy by plane and normal, detail, sensitivity, and robustness of depth and normal force. If channels have
    /// other names, all rows of these metrics.
    #[must_use]
    pub fn main(&self) -> ScoreTable {
        let headlines = self.headlines();
        let has_normal = |metric: &str| {
            let mut rows = headlines.rows.iter();
            rows.any(|row| row.metric == metric && is_normal(row))
        };
        let is_kept = |row: &&ScoreRow| {
            let is_known = METRICS.contains(&row.metric.as_str());
            let is_of_normal = OF_NORMAL.contains(&row.metric.as_str()) && has_normal(&row.metric);
            is_known && (!is_of_normal || is_normal(row))
        };
        ScoreTable {
            rows: headlines.rows.iter().filter(is_kept).cloned().collect(),
            ..headlines
        }
    }
}

fn is_normal(row: &ScoreRow) -> bool {
    matches!(row.channel.as_str(), "Pz" | "Fz")
}
