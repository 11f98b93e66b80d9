//! Tables of pages.

use super::{Cell, Column, Direction, Row, Table};
use crate::escape;
use crate::html::metric_link;

/// Letters of a cell that is broken into lines on a page.
const LONG: usize = 28;
/// Letters of a cell that is broken into long lines: short ones would make a tower of it.
const VERY_LONG: usize = 70;

impl Table {
    /// As a table of a page, that sorts.
    pub fn html(&self) -> String {
        self.html_with(|column, row, cell| {
            let better = row.better.filter(|_| column.direction.is_by_row());
            let words = cell.words().directed(better);
            escape::html(words.plain())
        })
    }

    /// As a table of a page with a glossary: names of metrics are links to what they mean.
    pub(crate) fn html_with_links(&self) -> String {
        self.html_with(|column, _, cell| match (column.direction, cell) {
            (Direction::OfMetrics, cell) => metric_link(&cell.plain()),
            (_, Cell::Verdict(is_pass)) => format!(
                "<span class=\"{}\">{}</span>",
                if *is_pass { "pass" } else { "fail" },
                escape::html(&cell.plain())
            ),
            (_, cell) => escape::html(&cell.plain()),
        })
    }

    /// A table whose cells are HTML as `written` makes it.
    fn html_with(&self, written: impl Fn(&Column, &Row, &Cell) -> String) -> String {
        let caption = escape::html(&self.caption);
        if self.rows.is_empty() {
            return format!("<p>{caption}: none.</p>\n{}", self.html_notes());
        }
        let mut out = format!(
            "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{caption}\"><table class=\"sorts\"><caption>{caption}</caption><thead><tr>"
        );
        let classes: Vec<&str> = (0..self.columns.len()).map(|at| self.class(at)).collect();
        // A column without any words takes room from the others.
        let has_words = |at: &usize| {
            self.rows
                .iter()
                .any(|row| !row.cells[*at].plain().is_empty())
        };
        let shown: Vec<usize> = (0..self.columns.len()).filter(has_words).collect();
        for &at in &shown {
            let head = self.columns[at].head();
            out += &format!(
                "<th scope=\"col\"{}>{}</th>",
                classes[at],
                escape::html(head.plain())
            );
        }
        out += "</tr></thead><tbody>\n";
        for row in &self.rows {
            out += "<tr>";
            for &at in &shown {
                let cell = written(&self.columns[at], row, &row.cells[at]);
                out += &format!("<td{}>{cell}</td>", classes[at]);
            }
            out += "</tr>\n";
        }
        out + "</tbody></table></div>\n" + &self.html_notes()
    }

    /// The class of the cells of a column: on which side they stand, and how they are broken.
    fn class(&self, column: usize) -> &'static str {
        let lengths = self.rows.iter().map(|row| &row.cells[column]);
        let lengths = lengths.map(|cell| cell.plain().chars().count());
        match lengths.max().unwrap_or(0) {
            _ if self.is_right(column) => " class=\"r\"",
            letters if letters > VERY_LONG => " class=\"wrap long\"",
            letters if letters > LONG => " class=\"wrap\"",
            _ => "",
        }
    }

    fn html_notes(&self) -> String {
        let notes = self.notes.iter();
        let notes = notes.map(|note| {
            let words = escape::html(note.plain());
            format!("<p class=\"note\">{words}</p>\n")
        });
        notes.collect()
    }
}
