//! A LaTeX table with booktabs, ready to be pasted into a paper.

use std::io::{self, Write};

pub(super) use taceva_report::escape_latex as escape;
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
                Some(cell) if cell.unit.is_empty() => escape(&cell.value),
                Some(cell) => format!("{}\\,{}", escape(&cell.value), escape(&cell.unit)),
                None => "--".to_owned(),
            })
            .collect();
        writeln!(out, "    {} & {} \\\\", escape(metric), values.join(" & "))?;
        let intervals: Vec<String> = cells
            .iter()
            .map(
                |cell| match cell.as_ref().and_then(|cell| cell.interval.as_ref()) {
                    Some([low, high]) => format!("\\scriptsize [{low}, {high}]"),
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

/// `Fxy` as `$F_{xy}$`; other names as they are.
fn symbol(name: &str) -> String {
    let axes = name
        .strip_prefix('P')
        .map(|axes| ('P', axes))
        .or_else(|| name.strip_prefix('F').map(|axes| ('F', axes)));
    match axes {
        Some((quantity, axes)) if ["x", "y", "z", "xy"].contains(&axes) => {
            format!("${quantity}_{{{axes}}}$")
        }
        _ => escape(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_symbols_and_other_names_words() {
        assert_eq!(
            [symbol("Fxy"), symbol("Pz"), symbol("shear_x")],
            ["$F_{xy}$", "$P_{z}$", "shear\\_x"]
        );
    }
}
