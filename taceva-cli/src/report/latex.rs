//! A LaTeX table with booktabs, ready to be pasted into a paper.

use std::io::{self, Write};

pub(super) use taceva_report::escape_latex as escape;
use taceva_report::{latex_directed as directed, latex_number as number, latex_symbol as symbol};
use taceva_study::EvaluationReport;

use super::grid::{Grid, caption};

pub(super) fn write(report: &EvaluationReport, out: &mut dyn Write) -> io::Result<()> {
    let grid = Grid::of(report);
    writeln!(out, "% needs \\usepackage{{booktabs}}")?;
    writeln!(out, "\\begin{{table}}")?;
    writeln!(out, "  \\caption{{{}}}", escape(&caption(report)))?;
    writeln!(
        out,
        "  \\begin{{tabular}}{{l{}}}",
        "r".repeat(grid.channels.len())
    )?;
    writeln!(out, "    \\toprule")?;
    let names: Vec<String> = grid.channels.iter().map(|name| symbol(name)).collect();
    writeln!(out, "    metric & {} \\\\", names.join(" & "))?;
    writeln!(out, "    \\midrule")?;
    for (metric, cells) in &grid.rows {
        let values: Vec<String> = cells
            .iter()
            .map(|cell| match cell {
                Some(cell) if cell.unit.is_empty() => number(&cell.value),
                Some(cell) => format!("{}\\,{}", number(&cell.value), escape(&cell.unit)),
                None => "--".to_owned(),
            })
            .collect();
        writeln!(
            out,
            "    {} & {} \\\\",
            directed(metric, &escape(metric)),
            values.join(" & ")
        )?;
        let intervals: Vec<String> = cells
            .iter()
            .map(
                |cell| match cell.as_ref().and_then(|cell| cell.interval.as_ref()) {
                    Some([low, high]) => {
                        format!("\\scriptsize [{}, {}]", number(low), number(high))
                    }
                    None => String::new(),
                },
            )
            .collect();
        if intervals.iter().any(|interval| !interval.is_empty()) {
            writeln!(out, "     & {} \\\\", intervals.join(" & "))?;
        }
    }
    writeln!(out, "    \\bottomrule")?;
    writeln!(out, "  \\end{{tabular}}")?;
    writeln!(out, "\\end{{table}}")
}
