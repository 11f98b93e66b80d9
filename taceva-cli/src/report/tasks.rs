//! Scores of tasks, such as slip, as a table.

use std::io::{self, Write};

use taceva_report::{Align, Column, FormattedValue, Table, escape_terminal};
use taceva_results::EvaluationReport;

/// Writes one row for each score of a task. Writes nothing without tasks.
pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    if report.tasks.is_empty() {
        return Ok(());
    }
    let names = [
        "task",
        "score",
        "value",
        "95 % interval",
        "best constant",
        "n",
        "clusters",
    ];
    let columns = names.map(|name| Column::new(name).align(Align::ByCell));
    let mut table = Table::new("", columns);
    let number = |value: f64| FormattedValue::number(value, None).value;
    for task in &report.tasks {
        for score in task.scores() {
            let shown = score
                .value
                .map(|value| FormattedValue::number(value, score.interval));
            let shown = shown.unwrap_or_default();
            let ends = shown.interval;
            table.push([
                escape_terminal(task.name()).to_string(),
                escape_terminal(score.metric).to_string(),
                shown.value,
                ends.map_or_else(String::new, |[low, high]| format!("{low} … {high}")),
                score.of_constant.map_or_else(String::new, number),
                score.n.to_string(),
                score.clusters.to_string(),
            ]);
        }
    }
    writeln!(out)?;
    out.write_all(table.text().as_bytes())
}
