//! Findings of `taceva check`, in every form.

use std::io::{self, Write};

use taceva_report::{escape_csv, escape_latex as escape, escape_markdown};
use taceva_study::{CheckReport, Finding};

pub(super) fn text(report: &CheckReport, out: &mut dyn Write) -> io::Result<()> {
    let count = |severity: &str| {
        report
            .findings
            .iter()
            .filter(|finding| finding.severity.to_string() == severity)
            .count()
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
        writeln!(out, "         hint: {}", finding.hint)?;
    }
    for skipped in &report.skipped {
        writeln!(out, "skipped  {}: {}", skipped.what, skipped.reason)?;
    }
    writeln!(
        out,
        "{} samples, {} checks: {} errors, {} warnings, {} notes",
        report.samples,
        report.looked_for.len(),
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

pub(super) fn csv(report: &CheckReport, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record([
        "code", "name", "severity", "message", "count", "samples", "hint",
    ])?;
    for finding in &report.findings {
        writer.write_record([
            finding.code,
            finding.name,
            &finding.severity.to_string(),
            &escape_csv(&finding.message),
            &finding.count.to_string(),
            &escape_csv(&finding.samples.join(" ")),
            finding.hint,
        ])?;
    }
    writer.flush()
}

pub(super) fn markdown(report: &CheckReport, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "| code | severity | finding |")?;
    writeln!(out, "|---|---|---|")?;
    for finding in &report.findings {
        writeln!(
            out,
            "| {} | {} | {} |",
            finding.code,
            finding.severity,
            escape_markdown(&finding.message)
        )?;
    }
    Ok(())
}

pub(super) fn latex(report: &CheckReport, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "\\begin{{tabular}}{{lll}}")?;
    writeln!(out, "  \\toprule")?;
    writeln!(out, "  code & severity & finding \\\\")?;
    writeln!(out, "  \\midrule")?;
    for finding in &report.findings {
        writeln!(
            out,
            "  {} & {} & {} \\\\",
            finding.code,
            finding.severity,
            escape(&finding.message)
        )?;
    }
    writeln!(out, "  \\bottomrule")?;
    writeln!(out, "\\end{{tabular}}")
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
