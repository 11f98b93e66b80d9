//! Findings of `taceva check`, in all formats.

use std::io::{self, Write};

use taceva_check::{CheckReport, Finding};
use taceva_core::counted;
use taceva_report::Table;

pub(super) fn text(report: &CheckReport, out: &mut dyn Write) -> io::Result<()> {
    let count = |severity: &str| {
        let findings = report.findings.iter();
        let of_it = findings.filter(|finding| finding.severity.to_string() == severity);
        counted(of_it.count(), severity)
    };
    for finding in &report.findings {
        writeln!(
            out,
            "{:<8} {} {}: {}",
            finding.severity, finding.code, finding.name, finding.message
        )?;
        if finding.count > 0 {
            writeln!(out, "         samples {}", samples(finding))?;
        }
        if !finding.hint.is_empty() {
            writeln!(out, "         hint: {}", finding.hint)?;
        }
    }
    for skipped in &report.skipped {
        writeln!(out, "skipped  {}: {}", skipped.what, skipped.reason)?;
    }
    writeln!(
        out,
        "{}, {}: {}, {}, {}",
        counted(report.samples, "sample"),
        counted(report.looked_for.len(), "check"),
        count("error"),
        count("warning"),
        count("note")
    )?;
    writeln!(
        out,
        "dataset  {}   frames decoded {}",
        report.dataset, report.frames_decoded
    )
}

/// Table with all columns of each finding.
pub(super) fn every_column(report: &CheckReport) -> Table {
    let names = [
        "code", "name", "severity", "message", "count", "samples", "hint",
    ];
    let mut table = Table::new("Findings", names);
    for finding in &report.findings {
        table.push([
            finding.code.to_owned(),
            finding.name.to_owned(),
            finding.severity.to_string(),
            finding.message.clone(),
            finding.count.to_string(),
            finding.samples.join(" "),
            finding.hint.to_owned(),
        ]);
    }
    table
}

/// Table with code, severity and message of each finding.
pub(super) fn main_columns(report: &CheckReport) -> Table {
    let mut table = Table::new("Findings", ["code", "severity", "finding"]);
    for finding in &report.findings {
        table.push([
            finding.code.to_owned(),
            finding.severity.to_string(),
            finding.message.clone(),
        ]);
    }
    table
}

fn samples(finding: &Finding) -> String {
    let more = finding.count - finding.samples.len();
    let tail = if more > 0 {
        format!(" and {more} more")
    } else {
        String::new()
    };
    format!("{}{tail}", finding.samples.join(", "))
}
