//! How results look. Each file is one form: a pure function of a finished report.

mod bench;
mod chart;
mod check;
mod csv;
pub(crate) mod devices;
mod grid;
mod json;
mod latex;
mod line;
mod markdown;
mod number;
pub(crate) mod page;
pub(crate) mod plan;
pub(crate) mod plugin;
pub(crate) mod plugin_check;
mod profile;
mod text;
mod thumbnail;
pub(crate) mod triple;

use std::io::{self, Write};

use taceva_study::bench::KernelBench;
use taceva_study::{CheckReport, EvaluationReport};

use crate::args::Format;

/// Writes an evaluation in the form asked for.
pub(crate) fn evaluation(
    report: &EvaluationReport,
    format: Format,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Text => text::write(report, out),
        Format::Json => json::write_sealed(report, out),
        Format::Csv => csv::write(report, out),
        Format::Md => markdown::write(report, out),
        Format::Tex => latex::write(report, out),
    }
}

/// Writes the evaluations of the studies of a scene: for people side by side where they are several, else one after the other.
pub(crate) fn profiles(
    reports: &[EvaluationReport],
    format: Format,
    out: &mut dyn Write,
) -> io::Result<()> {
    if format == Format::Json {
        return json::write_sealed(
            &Profiles {
                schema: taceva_report::RUN_SCHEMA,
                studies: reports,
            },
            out,
        );
    }
    if format == Format::Text && reports.len() > 1 {
        return profile::write(reports, out);
    }
    for (number, report) in reports.iter().enumerate() {
        if number > 0 {
            writeln!(out)?;
        }
        evaluation(report, format, out)?;
    }
    Ok(())
}

/// Schema [`taceva_report::RUN_SCHEMA`].
#[derive(serde::Serialize)]
struct Profiles<'a> {
    schema: &'static str,
    studies: &'a [EvaluationReport],
}

/// Writes findings in the form asked for.
pub(crate) fn findings(
    report: &CheckReport,
    format: Format,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Text => check::text(report, out),
        Format::Json => json::write(report, out),
        Format::Csv => check::csv(report, out),
        Format::Md => check::markdown(report, out),
        Format::Tex => check::latex(report, out),
    }
}

/// Writes a race of kernels in the form asked for.
pub(crate) fn kernel_bench(
    bench: &KernelBench,
    format: Format,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Text => bench::text(bench, out),
        Format::Json => json::write(bench, out),
        Format::Csv => bench::csv(bench, out),
        Format::Md => bench::markdown(bench, out),
        Format::Tex => bench::latex(bench, out),
    }
}

/// Draws a race of kernels.
pub(crate) fn kernel_chart(bench: &KernelBench, out: &mut dyn Write) -> io::Result<()> {
    chart::write(bench, out)
}
