//! One row a score, numbers in full.

use std::io::{self, Write};

use taceva_study::EvaluationReport;

use super::number::{no_interval, reason};

const HEAD: [&str; 11] = [
    "metric",
    "channel",
    "value",
    "unit",
    "ci95_low",
    "ci95_high",
    "method",
    "n",
    "n_invalid",
    "definition",
    "reason",
];

pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(HEAD)?;
    for (metric, channel, score) in report.evaluation.scores() {
        let number =
            |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        let ends = score.interval.ends();
        let why = match score.value.scalar() {
            None => reason(&score.value),
            Some(_) => no_interval(&score.interval)
                .map_or_else(String::new, |why| format!("interval {why}")),
        };
        writer.write_record([
            metric.id,
            channel,
            &number(score.value.scalar()),
            score.unit.symbol(),
            &number(ends.map(|ends| ends[0])),
            &number(ends.map(|ends| ends[1])),
            &score.interval.method().unwrap_or_default(),
            &score.n.to_string(),
            &score.n_invalid.to_string(),
            score.definition,
            &why,
        ])?;
    }
    writer.flush()
}
