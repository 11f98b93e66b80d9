//! Tables as LaTeX with booktabs.

use super::{Row, Table, Words};
use crate::escape::latex as escape;

/// Letters of all names that a column of a page has room for in the size of its numbers.
const LETTERS: usize = 28;
/// Columns beyond which numbers of a table as wide as a column of a page are set smaller.
const COLUMNS: usize = 5;

/// How a table is placed on a page of paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// As a float with caption and notes.
    #[default]
    Float,
    /// The same, as wide as a column of the page, in small letters.
    Column,
    /// The rows alone.
    Rows,
}

impl Table {
    /// As LaTeX with booktabs, placed as `layout` says.
    pub fn latex(&self, layout: Layout) -> String {
        let mut out = String::from("% needs \\usepackage{booktabs}\n");
        if layout == Layout::Rows {
            out += &format!("\\begin{{tabular}}{{{}}}\n", self.sides());
            out += &self.latex_rows("  ", "");
            return out + "\\end{tabular}\n";
        }
        out += "\\begin{table}\n";
        if !self.caption.is_empty() {
            out += &format!("  \\caption{{{}}}\n", escape(&self.caption));
        }
        match layout {
            Layout::Column => {
                out += &format!(
                    "  {}\\setlength{{\\tabcolsep}}{{2pt}}\n  \\begin{{tabular*}}{{\\columnwidth}}{{@{{}}l@{{\\extracolsep{{\\fill}}}}{}@{{}}}}\n",
                    self.size(),
                    self.sides().get(1..).unwrap_or_default()
                );
                out += &self.latex_rows("    ", self.size_of_names());
                out += "  \\end{tabular*}\n";
            }
            _ => {
                out += &format!("  \\begin{{tabular}}{{{}}}\n", self.sides());
                out += &self.latex_rows("    ", "");
                out += "  \\end{tabular}\n";
            }
        }
        for note in &self.notes {
            out += &format!("\n  \\footnotesize {}\n", note.in_latex());
        }
        out + "\\end{table}\n"
    }

    /// A letter for the side of each column.
    fn sides(&self) -> String {
        let sides = (0..self.columns.len()).map(|column| match self.is_right(column) {
            true => 'r',
            false => 'l',
        });
        sides.collect()
    }

    /// The size of numbers in a column of a page.
    fn size(&self) -> &'static str {
        match self.columns.len() {
            0..=COLUMNS => "\\footnotesize",
            _ => "\\scriptsize",
        }
    }

    /// The size of the heads in a column of a page, where they have no room in that of the numbers.
    fn size_of_names(&self) -> &'static str {
        let names = self.columns.iter().map(|column| column.name.plain());
        match names.map(|name| name.chars().count()).sum() {
            0..=LETTERS => "",
            _ => "\\scriptsize ",
        }
    }

    /// Heads and rows between the rules of booktabs, the heads in the size `small`.
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

/// The line below a row that has intervals.
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

/// A printed number as papers set it: a minus as wide as a plus, and `2.3e-7` with its power of ten; what is no number is escaped.
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

/// The symbol of a channel, `Fxy` as `$F_{xy}$`; other names as they are.
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
