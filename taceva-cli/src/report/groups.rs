//! Errors of each group of a split, as a table.

use std::io::{self, Write};

use taceva_report::{Align, Column, Table, escape_terminal};
use taceva_results::EvaluationReport;

/// Writes one row for each group and channel. Writes nothing without groups.
pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    let Some(group) = report
        .provenance
        .group()
        .filter(|_| !report.by_group.is_empty())
    else {
        return Ok(());
    };
    let group = escape_terminal(group).to_string();
    let names = [group.as_str(), "channel", "mae ↓", "unit", "n"];
    let columns = names.map(|name| Column::new(name).align(Align::ByCell));
    let mut table = Table::new("", columns);
    for own in &report.by_group {
        for error in &own.errors {
            table.push([
                escape_terminal(&own.group).to_string(),
                escape_terminal(&error.channel).to_string(),
                taceva_report::FormattedValue::number(error.mae, None).value,
                error.unit.clone(),
                error.n.to_string(),
            ]);
        }
    }
    writeln!(out)?;
    out.write_all(table.text().as_bytes())?;
    writeln!(out, "no intervals: an interval needs several groups")
}
