//! Tables as LaTeX with booktabs.

use super::room::{COLUMN_PT, PAGE_PT, breakable};
use super::{Row, Table, Words};
use crate::escape::{LETTER, LETTER_DEFINITION, latex as escape};

/// Number of letters in all column names above which the names are smaller than the numbers, in a page column.
const LETTERS: usize = 28;
/// Number of columns above which numbers in a page column are smaller.
const COLUMNS: usize = 5;

/// Placement of a table on a page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Float with caption and notes.
    #[default]
    Float,
    /// Float of the width of a page column, in small letters.
    Column,
    /// Float of the width of a page column, or of the page if the table is wider. A table wider than the page is divided into blocks of columns.
    Paper,
    /// Rows only.
    Rows,
}

impl Table {
    /// LaTeX with booktabs, placed by `layout`.
    pub fn latex(&self, layout: Layout) -> String {
        let table = self.latex_table(layout);
        let letters = match table.contains(LETTER) {
            true => LETTER_DEFINITION,
            false => "",
        };
        format!("% needs \\usepackage{{booktabs}}\n{letters}{table}")
    }

    /// Environment of the table, without definitions of commands.
    fn latex_table(&self, layout: Layout) -> String {
        let mut out = String::new();
        if layout == Layout::Rows {
            out += &format!("\\begin{{tabular}}{{{}}}\n", self.sides());
            out += &self.latex_rows("  ", "");
            return out + "\\end{tabular}\n";
        }
        let is_wide = layout == Layout::Paper && self.width_pt() > COLUMN_PT;
        let float = if is_wide { "table*" } else { "table" };
        out += &format!("\\begin{{{float}}}\n");
        if !self.caption.is_empty() {
            let caption = match layout {
                Layout::Column | Layout::Paper => breakable(&self.caption),
                _ => escape(&self.caption),
            };
            out += &format!("  \\caption{{{caption}}}\n");
        }
        match layout {
            Layout::Column => {
                out += &self.stretched("\\columnwidth", self.size(), self.size_of_names());
            }
            Layout::Paper => {
                let width_pt = if is_wide { PAGE_PT } else { COLUMN_PT };
                let blocks = self.blocks(width_pt);
                let blocks = blocks
                    .iter()
                    .map(|block| block.stretched("\\linewidth", "\\footnotesize", "\\scriptsize "));
                out += &blocks.collect::<Vec<_>>().join("\n  \\par\\medskip\n");
            }
            _ => {
                out += &format!("  \\begin{{tabular}}{{{}}}\n", self.sides());
                out += &self.latex_rows("    ", "");
                out += "  \\end{tabular}\n";
            }
        }
        for note in &self.notes {
            out += &match layout {
                Layout::Column | Layout::Paper => format!(
                    "\n  \\par\\vspace{{2pt}}\\noindent\\parbox{{\\linewidth}}{{\\scriptsize\\raggedright {}}}\n",
                    breakable(note.plain())
                ),
                _ => format!("\n  \\footnotesize {}\n", note.in_latex()),
            };
        }
        out + &format!("\\end{{{float}}}\n")
    }

    /// Rows in an environment of the width `width`, with numbers in the font size `size` and heads in `small`.
    fn stretched(&self, width: &str, size: &str, small: &str) -> String {
        let sides = self.sides();
        format!(
            "  {size}\\setlength{{\\tabcolsep}}{{2pt}}\n  \\begin{{tabular*}}{{{width}}}{{@{{}}l@{{\\extracolsep{{\\fill}}}}{}@{{}}}}\n{}  \\end{{tabular*}}\n",
            sides.get(1..).unwrap_or_default(),
            self.latex_rows("    ", small)
        )
    }

    /// Alignment letter of each column.
    fn sides(&self) -> String {
        let sides =
            (0..self.columns.len()).map(|column| if self.is_right(column) { 'r' } else { 'l' });
        sides.collect()
    }

    /// Font size of numbers in a page column.
    fn size(&self) -> &'static str {
        match self.columns.len() {
            0..=COLUMNS => "\\footnotesize",
            _ => "\\scriptsize",
        }
    }

    /// Font size of the heads in a page column, reduced if they are too wide at the number size.
    fn size_of_names(&self) -> &'static str {
        let names = self.columns.iter().map(|column| column.name.plain());
        match names.map(|name| name.chars().count()).sum() {
            0..=LETTERS => "",
            _ => "\\scriptsize ",
        }
    }

    /// Heads and rows between the booktabs rules, with heads in the size `small`.
    fn latex_rows(&self, indent: &str, small: &str) -> String {
        let heads = self.columns.iter().map(|column| {
            let head = column.head().in_latex();
            match head.is_empty() {
                true => head,
                false => format!("{small}{head}"),
            }
        });
        let mut out = format!("{indent}\\toprule\n");
        out += &line(indent, &heads.collect::<Vec<_>>());
        out += &format!("{indent}\\midrule\n");
        for row in &self.rows {
            if row.begins_group {
                out += &format!("{indent}\\addlinespace\n");
            }
            if let Some(heading) = &row.heading {
                let (count, heading) = (self.columns.len(), heading.in_latex());
                out += &format!("{indent}\\multicolumn{{{count}}}{{@{{}}l}}{{{heading}}} \\\\\n");
            }
            let cells = self.words_of(row);
            let cells: Vec<String> = cells.iter().map(Words::in_latex).collect();
            out += &line(indent, &cells);
            out += &below(indent, row);
        }
        out + &format!("{indent}\\bottomrule\n")
    }
}

fn line(indent: &str, cells: &[String]) -> String {
    format!("{indent}{} \\\\\n", cells.join(" & "))
}

/// Line of LaTeX with the intervals of a row, below its values.
fn below(indent: &str, row: &Row) -> String {
    let cells: Vec<Option<String>> = row.cells.iter().map(|cell| cell.latex_below()).collect();
    if cells.iter().flatten().all(String::is_empty) {
        return String::new();
    }
    let words = cells.iter().take_while(|cell| cell.is_none()).count();
    let rest: Vec<String> = cells
        .into_iter()
        .skip(words)
        .map(Option::unwrap_or_default)
        .collect();
    format!("{indent}{} {} \\\\\n", " &".repeat(words), rest.join(" & "))
}

/// Number in LaTeX maths, with a typographic minus and with a power of ten for `2.3e-7`. Escapes other text.
///
/// ```
/// assert_eq!(taceva_report::latex_number("-0.5"), "$-0.5$");
/// assert_eq!(taceva_report::latex_number("2.3e-7"), "$2.3\\times 10^{-7}$");
/// ```
pub fn number(text: &str) -> String {
    let plain = text.replace('−', "-");
    if plain.parse::<f64>().is_err() {
        return escape(text);
    }
    match plain.split_once('e') {
        Some((digits, power)) => format!("${digits}\\times 10^{{{power}}}$"),
        None if plain.starts_with('-') => format!("${plain}$"),
        None => plain,
    }
}

/// LaTeX symbol of a channel, such as `$F_{xy}$` for `Fxy`. Escapes other names.
///
/// ```
/// assert_eq!(taceva_report::latex_symbol("Fxy"), "$F_{xy}$");
/// assert_eq!(taceva_report::latex_symbol("shear_x"), "shear\\_x");
/// ```
pub fn symbol(name: &str) -> String {
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

    #[test]
    fn numbers_are_set_and_words_escaped() {
        let texts = ["0.25", "−0.25", "-1.5e-9", "50 %", "–", "inf_1"];
        assert_eq!(
            texts.map(number),
            [
                "0.25",
                "$-0.25$",
                "$-1.5\\times 10^{-9}$",
                "50 \\%",
                "--",
                "inf\\_1"
            ]
        );
    }
}
