//! One row a score and study, numbers in full.

use taceva_metrics::Better;

use super::ScoreTable;
use crate::escape;

const HEAD: [&str; 14] = [
    "sensor",
    "metric",
    "better",
    "channel",
    "value",
    "unit",
    "ci95_low",
    "ci95_high",
    "method",
    "n",
    "n_invalid",
    "reason",
    "standing",
    "bounded_share",
];

/// A table as CSV: one row a score and study, numbers in shortest round-trip form; words that begin like a formula are begun with an
/// apostrophe.
pub fn csv(table: &ScoreTable) -> String {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let mut write = |record: &[String]| {
        writer
            .write_record(record)
            .expect("a buffer takes whatever is written, and rows are equally long");
    };
    write(&HEAD.map(str::to_owned));
    for row in &table.rows {
        let better = Better::of(&row.metric).map_or("", Better::name);
        for (name, cell) in table.names.iter().zip(&row.cells) {
            let Some(cell) = cell else { continue };
            let number =
                |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
            write(&[
                escape::csv(name),
                escape::csv(&row.metric),
                better.to_owned(),
                escape::csv(&row.channel),
                number(cell.value),
                row.unit.symbol().to_owned(),
                number(cell.ends.map(|ends| ends[0])),
                number(cell.ends.map(|ends| ends[1])),
                escape::csv(cell.method.as_deref().unwrap_or_default()),
                cell.n.to_string(),
                cell.n_invalid.to_string(),
                escape::csv(cell.printed.reason.as_deref().unwrap_or_default()),
                cell.standing.words().unwrap_or_default().to_owned(),
                number(cell.bounded_share),
            ]);
        }
    }
    let bytes = writer
        .into_inner()
        .expect("a buffer takes whatever is written");
    String::from_utf8(bytes).expect("made of texts")
}
