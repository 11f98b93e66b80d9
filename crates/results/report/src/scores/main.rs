//! Main scores for a paper.

use std::collections::BTreeSet;

use super::{ScoreRow, ScoreTable};

/// Metrics of the main table, in order.
const METRICS: [&str; 3] = ["mae", "r2", "smape"];
/// Channels and planes in the order of papers. Other channels follow.
const CHANNELS: [&str; 8] = ["Fxy", "Fx", "Fy", "Fz", "Pxy", "Px", "Py", "Pz"];

impl ScoreTable {
    /// Rows of the main table: MAE, R² and sMAPE, of planes if present. Returns all rows if none of these metrics is present.
    #[must_use]
    pub fn main(&self) -> ScoreTable {
        let headlines = self.headlines();
        let rows = headlines.rows.iter();
        let mut rows: Vec<ScoreRow> = rows.filter(|row| is_main(row)).cloned().collect();
        rows.sort_by_key(|row| {
            let metric = METRICS.iter().position(|known| *known == row.metric);
            let channel = CHANNELS.iter().position(|known| *known == row.channel);
            (metric, channel.unwrap_or(CHANNELS.len()))
        });
        match rows.is_empty() {
            true => headlines,
            false => ScoreTable { rows, ..headlines },
        }
    }

    /// Metrics of rows that [`main`](ScoreTable::main) omits.
    pub fn beside_main(&self) -> BTreeSet<&str> {
        let main = self.main();
        let is_shown = |row: &&ScoreRow| main.rows.iter().any(|own| own.metric == row.metric);
        let rows = self.rows.iter().filter(|row| row.is_headline);
        let left_out = rows.filter(|row| !is_shown(row));
        left_out.map(|row| row.metric.as_str()).collect()
    }

    /// True if every row has a metric of the main table.
    pub(super) fn is_of_accuracy(&self) -> bool {
        !self.rows.is_empty() && self.rows.iter().all(is_main)
    }
}

pub(super) fn is_main(row: &ScoreRow) -> bool {
    METRICS.contains(&row.metric.as_str())
}
