//! For papers: the main scores in the width of one column.

use super::latex::{cell, symbol};
use super::notation::{directed, metric};
use super::{ScoreCell, ScoreTable};
use crate::escape::latex as escape;

/// Letters of all names that a column has room for in the size of its numbers.
const LETTERS: usize = 28;

/// The main rows of a table as LaTeX with booktabs, as wide as a column: symbols of the field, one line a score, no intervals; the long table
/// has them. A value is bold only where it is shown to be better than all others of its row.
pub fn latex_column(table: &ScoreTable, caption: &str) -> String {
    let main = table.main();
    let columns = main.names.len();
    let letters: usize = main.names.iter().map(|name| name.chars().count()).sum();
    let small = match letters {
        0..=LETTERS => "",
        _ => "\\scriptsize ",
    };
    let names = main
        .names
        .iter()
        .map(|name| format!("{small}{}", escape(name)));
    let names: Vec<String> = names.collect();
    let size = match columns {
        0..=4 => "\\footnotesize",
        _ => "\\scriptsize",
    };
    let mut out = format!(
        "% needs \\usepackage{{booktabs}}\n\\begin{{table}}\n  \\caption{{{}}}\n  {size}\\setlength{{\\tabcolsep}}{{2pt}}\n",
        escape(caption)
    );
    out += &format!(
        "  \\begin{{tabular*}}{{\\columnwidth}}{{@{{}}l@{{\\extracolsep{{\\fill}}}}{}@{{}}}}\n    \\toprule\n     & {} \\\\\n    \\midrule\n",
        "r".repeat(columns),
        names.join(" & ")
    );
    for row in &main.rows {
        let unit = match row.unit.symbol() {
            "1" => String::new(),
            symbol => format!(" ({})", escape(symbol)),
        };
        let cells: Vec<String> = row.cells.iter().map(|of| short_cell(of.as_ref())).collect();
        out += &format!(
            "    {} & {} \\\\\n",
            directed(
                &row.metric,
                &format!("{} {}{unit}", metric(&row.metric), symbol(&row.channel))
            ),
            cells.join(" & ")
        );
    }
    out += "    \\bottomrule\n  \\end{tabular*}\n";
    if main.rows.iter().any(|row| row.metric == "repeatability") {
        out += "\n  \\footnotesize $\\sigma_{\\mathrm{rep}}$: repeatability.\n";
    }
    if columns > 1 {
        out += "\n  \\footnotesize Bold: better than every other sensor at a level of 5\\,\\% after Holm's adjustment.\n";
    }
    out + "\\end{table}\n"
}

/// A value with at most three digits: a column has no room for more, and the long table has them.
fn short_cell(of: Option<&ScoreCell>) -> String {
    let Some(value) = of.and_then(|of| of.value) else {
        return cell(of);
    };
    let mut short = of.cloned();
    if let Some(short) = &mut short {
        short.printed.value = crate::number::numeral(value);
    }
    cell(short.as_ref())
}
