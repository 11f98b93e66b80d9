//! Tables of joined recordings: a list, and scores of each recording and of all together.

use std::collections::BTreeMap;
use std::io::{self, Write};

use taceva_report::{Align, Column, Table, escape_terminal};
use taceva_results::EvaluationReport;

use super::line::read_lines;
use super::number::formatted;

/// Writes two tables: the recordings with their digests, and the scores of each recording. Writes nothing for a single recording.
pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    if report.by_recording.is_empty() {
        return Ok(());
    }
    let names = ["recording", "samples", "scored", "digest"];
    let columns = names.map(|name| Column::new(name).align(Align::ByCell));
    let mut table = Table::new("", columns);
    for (own, scored) in report
        .provenance
        .recordings
        .iter()
        .zip(&report.by_recording)
    {
        table.push([
            escape_terminal(&own.name).to_string(),
            own.samples.to_string(),
            scored.samples.to_string(),
            own.digest.clone(),
        ]);
    }
    writeln!(out)?;
    out.write_all(table.text().as_bytes())?;
    writeln!(out)?;
    out.write_all(side_by_side(report).text().as_bytes())
}

/// Table with one row for each score of predictions and one column for each recording.
fn side_by_side(report: &EvaluationReport) -> Table {
    let head = ["metric", "channel", "all"].map(str::to_owned);
    let names = report.by_recording.iter();
    let names = names.map(|own| escape_terminal(&own.recording).to_string());
    let columns = head.into_iter().chain(names).chain(["unit".to_owned()]);
    let columns = columns.map(|name| Column::new(name).align(Align::ByCell));
    let mut table = Table::new("", columns);
    let own: Vec<BTreeMap<(String, String), String>> = report
        .by_recording
        .iter()
        .map(|own| {
            let lines = read_lines(&own.scores).into_iter();
            let headlines = lines.filter(|line| line.is_headline);
            let values = headlines.map(|line| {
                let value = formatted(&line).value;
                ((line.name, line.channel.to_owned()), value)
            });
            values.collect()
        })
        .collect();
    let mut last = String::new();
    for line in read_lines(&report.scores) {
        let key = (line.name.clone(), line.channel.to_owned());
        let cells: Vec<String> = own
            .iter()
            .map(|own| match own.get(&key) {
                Some(value) if !value.is_empty() => value.clone(),
                _ => "–".to_owned(),
            })
            .collect();
        if !line.is_headline || cells.iter().all(|cell| cell == "–") {
            continue;
        }
        let name = match last == line.name {
            true => String::new(),
            false => line.shown_name(),
        };
        let unit = match line.unit.symbol() {
            "1" => String::new(),
            symbol => symbol.to_owned(),
        };
        let head = [name, key.1, formatted(&line).value];
        table.push(head.into_iter().chain(cells).chain([unit]));
        last = line.name;
    }
    table
}
