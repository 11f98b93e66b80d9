//! Words and numbers in rows: one content, and a form for people, programs, pages and papers each.

mod directions;

pub use directions::Directions;

use std::borrow::Cow;

use crate::escape;
use crate::html::metric_link;
use crate::table::latex_number;

/// Letters of a cell that is broken into lines on a page.
const LONG: usize = 28;
/// Letters of a cell that is broken into long lines: short ones would make a tower of it.
const VERY_LONG: usize = 70;

/// Rows below a head.
///
/// # Shapes
/// Every row has as many cells as the head.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// What stands above it.
    pub caption: String,
    /// The names of the columns.
    pub head: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<String>>,
    /// What a reader must know, below it.
    pub notes: Vec<String>,
    /// Which of its numbers are good.
    pub directions: Directions,
}

impl Listing {
    /// A listing without rows.
    pub fn new(caption: &str, head: &[&str]) -> Listing {
        Listing {
            caption: caption.to_owned(),
            head: head.iter().map(|&name| name.to_owned()).collect(),
            ..Listing::default()
        }
    }

    /// For a terminal: columns as wide as their longest cell, numbers to the right, nothing that a terminal obeys.
    pub fn text(&self) -> String {
        let shown = self.for_people();
        let rows: Vec<Vec<String>> = std::iter::once(&shown.head)
            .chain(&shown.rows)
            .map(|row| row.iter().map(|cell| escape::terminal(cell)).collect())
            .collect();
        let width = |column: usize| {
            let cells = rows.iter().map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let mut out = format!("{}\n\n", escape::terminal(&self.caption));
        for row in &rows {
            let cells = row.iter().zip(&widths).enumerate();
            let cells = cells.map(|(column, (cell, width))| match self.is_of_numbers(column) {
                true => format!("{cell:>width$}"),
                false => format!("{cell:<width$}"),
            });
            let line = cells.collect::<Vec<_>>().join("  ");
            out += line.trim_end();
            out.push('\n');
        }
        for note in &self.notes {
            out += &format!("\n{}", escape::terminal(note));
        }
        if !self.notes.is_empty() {
            out.push('\n');
        }
        out
    }

    /// For programs that read tables.
    pub fn csv(&self) -> String {
        let mut writer = ::csv::Writer::from_writer(Vec::new());
        let told = self.for_programs();
        for row in std::iter::once(&told.head).chain(&told.rows) {
            let is_number = |cell: &str| cell.parse::<f64>().is_ok();
            let cells = row.iter().map(|cell| match is_number(cell) {
                true => cell.clone(),
                false => escape::csv(cell),
            });
            writer
                .write_record(cells)
                .expect("a buffer takes whatever is written, and rows are equally long");
        }
        let bytes = writer
            .into_inner()
            .expect("a buffer takes whatever is written");
        String::from_utf8(bytes).expect("made of texts")
    }

    /// For programs: the rows as objects by the names of the columns, under `schema`.
    pub fn json(&self, schema: &str) -> String {
        let told = self.for_programs();
        let row = |row: &Vec<String>| {
            let cells = told.head.iter().zip(row);
            let cells =
                cells.map(|(name, cell)| (name.clone(), serde_json::Value::from(cell.as_str())));
            serde_json::Value::Object(cells.collect())
        };
        let rows: Vec<serde_json::Value> = told.rows.iter().map(row).collect();
        let whole = serde_json::json!({
            "schema": schema,
            "caption": self.caption,
            "rows": rows,
            "notes": self.notes,
        });
        format!("{whole:#}\n")
    }

    /// For pages.
    pub fn markdown(&self) -> String {
        let line = |row: &[String]| {
            let cells: Vec<String> = row.iter().map(|cell| escape::markdown(cell)).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = (0..self.head.len()).map(|column| match self.is_of_numbers(column) {
            true => "---:",
            false => "---",
        });
        let shown = self.for_people();
        let mut out = line(&shown.head);
        out += &format!("|{}|\n", rule.collect::<Vec<_>>().join("|"));
        out.extend(shown.rows.iter().map(|row| line(row)));
        for note in &self.notes {
            out += &format!("\n{}\n", escape::markdown(note));
        }
        out
    }

    /// For papers, with booktabs.
    pub fn latex(&self) -> String {
        let line = |row: &[String]| {
            let cells: Vec<String> = row.iter().map(|cell| latex_number(cell)).collect();
            format!("    {} \\\\\n", cells.join(" & "))
        };
        let columns = (0..self.head.len()).map(|column| match self.is_of_numbers(column) {
            true => 'r',
            false => 'l',
        });
        let mut out = String::from("% needs \\usepackage{booktabs}\n\\begin{table}\n");
        out += &format!("  \\caption{{{}}}\n", escape::latex(&self.caption));
        out += &format!(
            "  \\begin{{tabular}}{{{}}}\n    \\toprule\n",
            columns.collect::<String>()
        );
        let shown = self.for_people();
        out += &line(&shown.head);
        out += "    \\midrule\n";
        out.extend(shown.rows.iter().map(|row| line(row)));
        out += "    \\bottomrule\n  \\end{tabular}\n";
        for note in &self.notes {
            out += &format!("\n  \\footnotesize {}\n", escape::latex(note));
        }
        out + "\\end{table}\n"
    }

    /// As a table of a page, that sorts.
    pub fn html(&self) -> String {
        self.for_people().table(|_, cell| escape::html(cell))
    }

    /// As a table of a page whose glossary says what the metrics of the column `metric` mean; in the column `verdict` what is not `pass` stands
    /// out.
    pub(crate) fn html_with_metrics(&self) -> String {
        self.table(|name, cell| match name {
            "metric" => metric_link(cell),
            "verdict" => format!(
                "<span class=\"{}\">{}</span>",
                if cell == "pass" { "pass" } else { "fail" },
                escape::html(cell)
            ),
            _ => escape::html(cell),
        })
    }

    /// The rows as people read them: with signs.
    fn for_people(&self) -> Cow<'_, Listing> {
        self.directions.signed(self)
    }

    /// The rows as programs read them: with words in a column of their own.
    fn for_programs(&self) -> Cow<'_, Listing> {
        self.directions.worded(self)
    }

    /// A table whose cells are HTML as `written` makes it of the name of the column and the text.
    fn table(&self, written: impl Fn(&str, &str) -> String) -> String {
        let caption = escape::html(&self.caption);
        if self.rows.is_empty() {
            return format!("<p>{caption}: none.</p>\n{}", self.html_notes());
        }
        let mut out = format!(
            "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{caption}\"><table class=\"sorts\"><caption>{caption}</caption><thead><tr>"
        );
        let longest = |column: usize| {
            let cells = self.rows.iter().map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        };
        let classes: Vec<&str> = (0..self.head.len())
            .map(|column| match longest(column) {
                _ if self.is_of_numbers(column) => " class=\"r\"",
                letters if letters > VERY_LONG => " class=\"wrap long\"",
                letters if letters > LONG => " class=\"wrap\"",
                _ => "",
            })
            .collect();
        // A column in which nothing is said takes room from those in which something is.
        let is_said = |column: &usize| self.rows.iter().any(|row| !row[*column].is_empty());
        let columns: Vec<usize> = (0..self.head.len()).filter(is_said).collect();
        for (column, name) in columns.iter().map(|&column| (column, &self.head[column])) {
            out += &format!(
                "<th scope=\"col\"{}>{}</th>",
                classes[column],
                escape::html(name)
            );
        }
        out += "</tr></thead><tbody>\n";
        for row in &self.rows {
            out += "<tr>";
            for (column, cell) in columns.iter().map(|&column| (column, &row[column])) {
                let cell = written(&self.head[column], cell);
                out += &format!("<td{}>{cell}</td>", classes[column]);
            }
            out += "</tr>\n";
        }
        out + "</tbody></table></div>\n" + &self.html_notes()
    }

    fn html_notes(&self) -> String {
        let notes = self.notes.iter();
        let notes = notes.map(|note| format!("<p class=\"note\">{}</p>\n", escape::html(note)));
        notes.collect()
    }

    /// Whether a column holds numbers, or nothing, and at least one of them.
    fn is_of_numbers(&self, column: usize) -> bool {
        let is_number = |cell: &str| cell.replace('−', "-").parse::<f64>().is_ok();
        let mut cells = self.rows.iter().map(|row| row[column].as_str());
        let all = cells
            .clone()
            .all(|cell| matches!(cell, "" | "–") || is_number(cell));
        all && cells.any(is_number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_escapes_what_it_would_obey() {
        let mut listing = Listing::new("a|b <i> $", &["name", "n"]);
        listing
            .rows
            .push(vec!["=cmd\u{1b}[2J&".to_owned(), "3".to_owned()]);
        assert!(listing.text().contains("=cmd\\u{1b}[2J&  3"));
        assert!(listing.csv().contains("'=cmd"));
        assert!(listing.markdown().contains("=cmd\\[2J&amp; | 3"));
        assert!(listing.latex().contains("=cmd[2J\\& & 3"));
        assert!(
            listing
                .html()
                .contains("=cmd\u{fffd}[2J&amp;</td><td class=\"r\">3</td>")
        );
    }
}
