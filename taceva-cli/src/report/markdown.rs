//! A Markdown table: a row a metric, a column a channel.

use std::io::{self, Write};

use taceva_metrics::Better;
use taceva_study::EvaluationReport;

use super::grid::Grid;

pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    let grid = Grid::of(report);
    writeln!(out, "| metric | {} |", grid.channels.join(" | "))?;
    writeln!(out, "|---{}|", "|---:".repeat(grid.channels.len()))?;
    for (metric, cells) in &grid.rows {
        let cells: Vec<String> = cells
            .iter()
            .map(|cell| match cell {
                Some(cell) => match &cell.interval {
                    Some([low, high]) => {
                        format!("{} ({low} … {high}){}", cell.value, spaced(&cell.unit))
                    }
                    None => format!("{}{}", cell.value, spaced(&cell.unit)),
                },
                None => "–".to_owned(),
            })
            .collect();
        writeln!(out, "| {} | {} |", Better::named(metric), cells.join(" | "))?;
    }
    writeln!(out)?;
    writeln!(out, "{}", super::grid::caption(report))
}

fn spaced(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    }
}
