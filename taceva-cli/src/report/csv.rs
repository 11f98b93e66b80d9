//! One row a score or variant, numbers in full; words that begin like a formula are begun with an apostrophe.

use std::io::{self, Write};

use taceva_metrics::{Better, Interval};
use taceva_report::escape_csv as word;
use taceva_study::EvaluationReport;

use super::line::lines;
use super::number::{no_interval, reason};

const HEAD: [&str; 14] = [
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
    "definition",
    "reason",
    "standing",
    "bounded_share",
];

pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(HEAD)?;
    for line in lines(&report.evaluation) {
        let number =
            |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        let ends = line.interval.and_then(Interval::ends);
        let why = match line.value.scalar() {
            None => reason(line.value),
            Some(_) => line
                .interval
                .and_then(no_interval)
                .map_or_else(String::new, |why| format!("interval {why}")),
        };
        let method = line.interval.and_then(Interval::method);
        let better = Better::of(&line.name).map_or("", Better::name);
        writer.write_record([
            word(&line.name).as_str(),
            better,
            &word(line.channel),
            &number(line.value.scalar()),
            line.unit.symbol(),
            &number(ends.map(|ends| ends[0])),
            &number(ends.map(|ends| ends[1])),
            &word(&method.unwrap_or_default()),
            &line.score.n.to_string(),
            &line.score.n_invalid.to_string(),
            line.score.definition,
            &word(&why),
            line.score.standing.words().unwrap_or_default(),
            &number(line.score.bounded_share),
        ])?;
    }
    writer.flush()
}
