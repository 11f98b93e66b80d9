//! A LaTeX table with booktabs, ready to be pasted into a paper.

use std::io::{self, Write};

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

/// Text that LaTeX prints as it stands.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '{' | '}' | '$' | '&' | '#' | '_' | '%' => escaped.extend(['\\', character]),
            '²' => escaped.push_str("$^2$"),
            '·' => escaped.push_str("$\\cdot$"),
            '…' => escaped.push_str("\\dots{}"),
            _ => escaped.push(character),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_that_latex_reads_specially_is_escaped() {
        assert_eq!(
            escape("a_b 5 % {x} \\ ~ ^ $ & #"),
            "a\\_b 5 \\% \\{x\\} \\textbackslash{} \\textasciitilde{} \\textasciicircum{} \\$ \\& \\#"
        );
        assert_eq!(
            [symbol("Fxy"), symbol("Pz"), symbol("shear_x")],
            ["$F_{xy}$", "$P_{z}$", "shear\\_x"]
        );
    }
}
