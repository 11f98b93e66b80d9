//! Rendering of results: pure functions of finished reports.

mod bench;
pub(crate) mod bundle;
mod chart;
mod check;
pub(crate) mod dataset;
pub(crate) mod devices;
mod groups;
mod json;
mod line;
mod number;
pub(crate) mod page;
pub(crate) mod plan;
pub(crate) mod plugin;
pub(crate) mod plugin_check;
pub(crate) mod presets;
mod profile;
mod recordings;
pub(crate) mod rig;
mod scores;
pub(crate) mod stress;
pub(crate) mod study_bench;
mod tasks;
mod text;
pub(crate) mod thumbnail;
pub(crate) mod triple;
pub(crate) mod verification_page;
pub(crate) mod wear;

use std::io::{self, Write};

use taceva_check::CheckReport;
use taceva_report::{Layout, ScoreTable, Study, escape_markdown};
use taceva_results::{EvaluationReport, RunReport};
use taceva_study::bench::KernelBench;

use crate::args::{Format, TableScores};

/// Writes an evaluation in the requested format. The main table has the rows of `channels`. If `channels` is empty, the rows are planes and single
/// channels.
pub(crate) fn evaluation(
    report: &EvaluationReport,
    format: Format,
    table: TableScores,
    channels: &[String],
    out: &mut dyn Write,
) -> io::Result<()> {
    if table == TableScores::Main && format != Format::Json {
        let study = Study::from(report.clone());
        let scores = ScoreTable::of(&[study]).of_channels(channels);
        return main_scores(&scores, format, None, out);
    }
    match format {
        Format::Text => text::write(report, out),
        Format::Json => json::write_sealed(report, out),
        Format::Csv => out.write_all(scores::every_number(report).csv().as_bytes()),
        Format::Md => out.write_all(scores::for_pages(report).markdown().as_bytes()),
        Format::Tex => {
            let table = scores::by_channel(report).latex(Layout::Float);
            out.write_all(table.as_bytes())
        }
    }
}

/// Writes the main scores in `format`, except JSON. Text has lines of at most `width` characters. Scores that do not fit form further tables.
pub(crate) fn main_scores(
    scores: &ScoreTable,
    format: Format,
    width: Option<usize>,
    out: &mut dyn Write,
) -> io::Result<()> {
    if format == Format::Csv {
        return out.write_all(scores.main().every_number().csv().as_bytes());
    }
    let tables = scores.for_column(&scores.caption());
    for (number, table) in tables.iter().enumerate() {
        if number > 0 {
            writeln!(out)?;
        }
        let text = match format {
            Format::Tex => table.latex(Layout::Column),
            Format::Md => {
                let caption = escape_markdown(&table.caption);
                format!("{caption}\n\n{}", table.markdown())
            }
            _ => match width {
                Some(width) => table.text_within(width),
                None => table.text(),
            },
        };
        out.write_all(text.as_bytes())?;
    }
    Ok(())
}

/// Writes the evaluations of the studies of a scene. Text shows several studies side by side; other formats have them in sequence.
pub(crate) fn profiles(
    reports: &[EvaluationReport],
    format: Format,
    table: TableScores,
    out: &mut dyn Write,
) -> io::Result<()> {
    if format == Format::Json {
        return json::write_sealed(&RunReport::new(reports), out);
    }
    if table == TableScores::Main {
        let studies: Vec<Study> = reports.iter().cloned().map(Study::from).collect();
        return main_scores(&ScoreTable::of(&studies), format, None, out);
    }
    if format == Format::Text && reports.len() > 1 {
        return profile::write(reports, out);
    }
    for (number, report) in reports.iter().enumerate() {
        if number > 0 {
            writeln!(out)?;
        }
        evaluation(report, format, table, &[], out)?;
    }
    Ok(())
}

/// Writes the findings of each recording in the requested format, in sequence. JSON of several recordings is a list.
pub(crate) fn findings(
    reports: &[(String, CheckReport)],
    format: Format,
    out: &mut dyn Write,
) -> io::Result<()> {
    let [(_, only)] = reports else {
        if format == Format::Json {
            let reports: Vec<&CheckReport> = reports.iter().map(|(_, report)| report).collect();
            return json::write(&reports, out);
        }
        for (number, (name, report)) in reports.iter().enumerate() {
            if number > 0 {
                writeln!(out)?;
            }
            writeln!(out, "{name}")?;
            findings_of(report, format, out)?;
        }
        return Ok(());
    };
    findings_of(only, format, out)
}

fn findings_of(report: &CheckReport, format: Format, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Text => check::text(report, out),
        Format::Json => json::write(report, out),
        Format::Csv => out.write_all(check::every_column(report).csv().as_bytes()),
        Format::Md => out.write_all(check::main_columns(report).markdown().as_bytes()),
        Format::Tex => {
            let table = check::main_columns(report).latex(Layout::Rows);
            out.write_all(table.as_bytes())
        }
    }
}

/// Writes a benchmark of kernels in the requested format.
pub(crate) fn kernel_bench(
    bench: &KernelBench,
    format: Format,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Text => bench::text(bench, out),
        Format::Json => json::write(bench, out),
        Format::Csv => out.write_all(bench::every_number(bench).csv().as_bytes()),
        Format::Md => out.write_all(bench::for_pages(bench).markdown().as_bytes()),
        Format::Tex => {
            let table = bench::rows(bench).latex(Layout::Rows);
            out.write_all(table.as_bytes())
        }
    }
}

/// Draws a benchmark of kernels.
pub(crate) fn kernel_chart(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    chart::write(bench, out)
}
