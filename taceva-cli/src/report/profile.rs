//! Table of several sensors side by side, with one column each.

use std::io::{self, Write};

use taceva_core::{PressOutcome, distinct};
use taceva_metrics::{Better, catalogue, plane_of};
use taceva_report::{Align, Column, Study, Table, escape_terminal, short_digests};
use taceva_results::{EvaluationReport, ScoreLine, not_measured};

use super::line::{lines, standings};
use super::number::formatted;
use super::page;
use super::text::{over_seeds, presses};

/// Key of a row: metric, channel and unit.
type Row = [String; 3];

pub(super) fn write(reports: &[EvaluationReport], out: &mut dyn Write) -> io::Result<()> {
    let sources = reports.iter().map(|report| report.subject.source.as_str());
    if let Some(words) = not_measured(sources) {
        writeln!(out, "{words}")?;
    }
    for report in reports {
        let subject = &report.subject;
        let gel = short_digests(&subject.gel);
        let [sensor, serial, gel] =
            [&subject.sensor, &subject.serial, &gel].map(|name| escape_terminal(name));
        write!(out, "{sensor}   serial {serial}   gel {gel}")?;
        writeln!(out, "   {}", subject.source)?;
    }
    writeln!(out)?;
    let lines: Vec<Vec<ScoreLine<'_>>> = reports.iter().map(headlines).collect();
    let rows = rows(&lines);
    let published: Vec<Vec<String>> = reports
        .iter()
        .zip(&lines)
        .map(|(report, lines)| published(report, lines, &rows))
        .collect();
    let mut table = Table::new("", columns(reports, &published));
    let mut last = String::new();
    for (number, row) in rows.into_iter().enumerate() {
        let mut cells = Vec::new();
        for (lines, published) in lines.iter().zip(&published) {
            cells.push(cell(lines, &row));
            cells.extend(published.get(number).cloned());
        }
        let [metric, channel, unit] = row;
        // The name of a metric is printed once, above its channels.
        let named = match metric == last {
            true => String::new(),
            false => Better::named(&metric),
        };
        last = metric;
        table.push([vec![named, channel], cells, vec![unit]].concat());
    }
    out.write_all(table.text().as_bytes())?;
    for report in reports.iter().filter(|report| report.over_seeds.is_some()) {
        writeln!(out, "\n{}", escape_terminal(&report.subject.sensor))?;
        over_seeds(report, out)?;
    }
    for report in reports {
        let counts = report.provenance.press_counts();
        let is_as_planned = counts.keys().all(|way| *way == PressOutcome::Complete);
        if let Some(presses) = presses(report).filter(|_| !is_as_planned) {
            writeln!(out, "presses    {}: {presses}", report.subject.sensor)?;
        }
    }
    ties(reports, out)?;
    for report in reports {
        let sensor = escape_terminal(&report.subject.sensor);
        for standing in standings(&report.scores) {
            writeln!(out, "standing   {sensor}: {standing}")?;
        }
    }
    for report in reports {
        for skipped in &report.skipped {
            let sensor = escape_terminal(&report.subject.sensor);
            let what = escape_terminal(&skipped.what);
            writeln!(out, "skipped    {sensor}: {what}: {}", skipped.reason)?;
        }
    }
    Ok(())
}

/// Prints verdicts for sensors with exactly the same share of correctly classified gratings, found from the spacings that they resolve.
fn ties(reports: &[EvaluationReport], out: &mut dyn Write) -> io::Result<()> {
    let shares = |report: &EvaluationReport| -> Vec<(String, u64)> {
        let lines = lines(&report.scores).into_iter();
        lines
            .filter(|line| line.name == "sr")
            .filter_map(|line| Some((line.channel.to_owned(), line.value.number()?.to_bits())))
            .collect()
    };
    let mut all: Vec<(String, u64)> = reports.iter().flat_map(shares).collect();
    let count = all.len();
    all.sort_unstable();
    all.dedup();
    if all.len() == count {
        return Ok(());
    }
    let studies = reports.iter().map(page::study);
    let studies: Vec<Study> = studies
        .collect::<Result<_, _>>()
        .map_err(io::Error::other)?;
    for tie in taceva_report::ties(&studies) {
        writeln!(out, "verdict    {}", escape_terminal(&tie))?;
    }
    Ok(())
}

/// Published values of the sensor, one for each row; empty if no row has a published value with the same definition.
fn published(report: &EvaluationReport, lines: &[ScoreLine<'_>], rows: &[Row]) -> Vec<String> {
    let Some(sensor) = taceva_report::catalogue::find(&report.subject.sensor) else {
        return Vec::new();
    };
    let alike = |row: &Row| {
        let line = lines.iter().find(|line| row_of(line) == *row)?;
        let definition = &line.score.definition;
        let found = sensor.published_alike(&line.name, line.channel, definition, line.unit)?;
        // The value has only the published digits.
        Some(found.value.to_string())
    };
    let cells: Vec<Option<String>> = rows.iter().map(alike).collect();
    if cells.iter().all(Option::is_none) {
        return Vec::new();
    }
    let cells = cells.into_iter();
    cells
        .map(|cell| cell.unwrap_or_else(|| "–".to_owned()))
        .collect()
}

/// Columns of the table: text is left-aligned, numbers are right-aligned.
fn columns(reports: &[EvaluationReport], published: &[Vec<String>]) -> Vec<Column> {
    let sensors = reports.iter().zip(published).flat_map(|(report, cells)| {
        let beside = (!cells.is_empty()).then_some("published");
        [report.subject.sensor.as_str()].into_iter().chain(beside)
    });
    let words = |name: &str| Column::new(name).align(Align::Left);
    ["metric", "channel"]
        .map(words)
        .into_iter()
        .chain(sensors.map(|name| Column::new(name).align(Align::Right)))
        .chain([words("unit")])
        .collect()
}

/// Scores without variants. Scores of planes replace the scores of their axes.
fn headlines(report: &EvaluationReport) -> Vec<ScoreLine<'_>> {
    let lines = lines(&report.scores);
    let has = |name: &str, channel: &str| {
        let mut lines = lines.iter();
        lines.any(|line| line.name == name && line.channel == channel)
    };
    let is_in_a_plane: Vec<bool> = lines
        .iter()
        .map(|line| plane_of(line.channel).is_some_and(|plane| has(&line.name, plane)))
        .collect();
    let kept = lines.into_iter().zip(is_in_a_plane);
    kept.filter(|(line, is_in_a_plane)| line.is_headline && !is_in_a_plane)
        .map(|(line, _)| line)
        .collect()
}

/// Keys of all rows of the reports, in catalogue order.
fn rows(reports: &[Vec<ScoreLine<'_>>]) -> Vec<Row> {
    let mut rows = distinct(reports.iter().flatten().map(row_of));
    rows.sort_by_key(|[metric, ..]| catalogue::ALL.iter().position(|known| known.id == metric));
    rows
}

fn row_of(line: &ScoreLine<'_>) -> Row {
    let unit = match line.unit.symbol() {
        "1" => "",
        symbol => symbol,
    };
    [line.name.as_str(), line.channel, unit].map(str::to_owned)
}

fn cell(lines: &[ScoreLine<'_>], row: &Row) -> String {
    let line = lines.iter().find(|line| row_of(line) == *row);
    let formatted = line.map(|line| formatted(line).value);
    formatted
        .filter(|value| !value.is_empty())
        .unwrap_or_else(|| "–".to_owned())
}
