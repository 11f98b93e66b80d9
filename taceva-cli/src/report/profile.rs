//! Several sensors side by side, a column each: what was measured in the same way can be read across.

use std::io::{self, Write};

use taceva_core::PressOutcome;
use taceva_metrics::catalogue;
use taceva_report::escape_terminal;
use taceva_study::EvaluationReport;

use super::line::{Line, lines};
use super::number::printed;
use super::text::presses;

/// A channel and the plane that says the same of it and its neighbour.
const IN_PLANES: [(&str, &str); 4] = [("Px", "Pxy"), ("Py", "Pxy"), ("Fx", "Fxy"), ("Fy", "Fxy")];

/// What a row is of: metric, channel, unit.
type Row = [String; 3];

pub(super) fn write(reports: &[EvaluationReport], out: &mut dyn Write) -> io::Result<()> {
    for report in reports {
        let subject = &report.subject;
        let [sensor, serial, gel] =
            [&subject.sensor, &subject.serial, &subject.gel].map(|name| escape_terminal(name));
        write!(out, "{sensor}   serial {serial}   gel {gel}")?;
        writeln!(out, "   {}", subject.source)?;
    }
    let is_model = |report: &EvaluationReport| report.subject.source != "recorded";
    if reports.iter().all(is_model) {
        writeln!(out, "Nothing here was measured: the samples are simulated.")?;
    } else if reports.iter().any(is_model) {
        writeln!(
            out,
            "Not everything here was measured: some of the samples are simulated."
        )?;
    }
    writeln!(out)?;
    let lines: Vec<Vec<Line<'_>>> = reports.iter().map(headlines).collect();
    let mut table = vec![head(reports)];
    for row in rows(&lines) {
        let cells = lines.iter().map(|lines| cell(lines, &row));
        let cells: Vec<String> = cells.collect();
        let [metric, channel, unit] = row;
        table.push([vec![metric, channel], cells, vec![unit]].concat());
    }
    print(&table, out)?;
    for report in reports {
        let counts = report.provenance.press_counts();
        let is_as_planned = counts.keys().all(|way| *way == PressOutcome::Complete);
        if let Some(presses) = presses(report).filter(|_| !is_as_planned) {
            writeln!(out, "presses    {}: {presses}", report.subject.sensor)?;
        }
    }
    for report in reports {
        for skipped in report.evaluation.skipped() {
            let sensor = escape_terminal(&report.subject.sensor);
            let what = escape_terminal(&skipped.what);
            writeln!(out, "skipped    {sensor}: {what}: {}", skipped.reason)?;
        }
    }
    Ok(())
}

fn head(reports: &[EvaluationReport]) -> Vec<String> {
    let sensors = reports
        .iter()
        .map(|report| escape_terminal(&report.subject.sensor));
    ["metric", "channel"]
        .map(str::to_owned)
        .into_iter()
        .chain(sensors)
        .chain(["unit".to_owned()])
        .collect()
}

/// The scores themselves, of planes where there are any.
fn headlines(report: &EvaluationReport) -> Vec<Line<'_>> {
    let lines = lines(&report.evaluation);
    let has = |name: &str, channel: &str| {
        let mut lines = lines.iter();
        lines.any(|line| line.name == name && line.channel == channel)
    };
    let is_in_a_plane: Vec<bool> = lines
        .iter()
        .map(|line| {
            let mut planes = IN_PLANES.into_iter();
            planes.any(|(channel, plane)| line.channel == channel && has(&line.name, plane))
        })
        .collect();
    let kept = lines.into_iter().zip(is_in_a_plane);
    kept.filter(|(line, is_in_a_plane)| line.is_headline && !is_in_a_plane)
        .map(|(line, _)| line)
        .collect()
}

/// Every row that some report has, in the order of the catalogue.
fn rows(reports: &[Vec<Line<'_>>]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for line in reports.iter().flatten() {
        let row = row_of(line);
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    rows.sort_by_key(|[metric, ..]| catalogue::ALL.iter().position(|known| known.id == metric));
    rows
}

fn row_of(line: &Line<'_>) -> Row {
    let unit = match line.unit.symbol() {
        "1" => "",
        symbol => symbol,
    };
    [line.name.as_str(), line.channel, unit].map(str::to_owned)
}

fn cell(lines: &[Line<'_>], row: &Row) -> String {
    let line = lines.iter().find(|line| row_of(line) == *row);
    let printed = line.map(|line| printed(line).value);
    printed
        .filter(|value| !value.is_empty())
        .unwrap_or_else(|| "–".to_owned())
}

/// Words to the left, numbers to the right; a metric is named once.
fn print(table: &[Vec<String>], out: &mut dyn Write) -> io::Result<()> {
    let columns = table.first().map_or(0, Vec::len);
    let width = |column: usize| {
        let cells = table.iter().map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut last = "";
    for row in table {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let cell = if column == 0 && cell == last {
                ""
            } else {
                cell
            };
            line += &if column < 2 || column + 1 == columns {
                format!("{cell:<width$}  ")
            } else {
                format!("{cell:>width$}  ")
            };
        }
        last = &row[0];
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}
