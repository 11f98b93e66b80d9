//! Tables of HTML pages.

use maud::{Markup, html};

use super::{Cell, Column, Direction, Row, Table};
use crate::escape;
use crate::markup::{metric_link, scroll};

/// Length of the longest cell above which a column wraps, in characters.
const LONG: usize = 28;
/// Length of the longest cell above which a column wraps to wide lines, in characters.
const VERY_LONG: usize = 70;

impl Table {
    /// HTML fragment for other pages, such as a notebook. Texts are escaped, and control characters are replaced.
    ///
    /// ```
    /// use taceva_report::{Cell, Table};
    /// let mut table = Table::new("Sensors", ["name"]);
    /// table.push([Cell::text("<script>")]);
    /// assert!(table.html_fragment().contains("&lt;script&gt;"));
    /// ```
    pub fn html_fragment(&self) -> String {
        escape::obeyed_replaced(&self.html().into_string())
    }

    /// Sortable table of a page.
    pub(crate) fn html(&self) -> Markup {
        self.html_with(|column, row, cell| {
            let better = row.better.filter(|_| column.direction.is_by_row());
            html! { (cell.words().directed(better).plain()) }
        })
    }

    /// Table of a page with a glossary. Names of metrics are links to glossary entries.
    pub(crate) fn html_with_links(&self) -> Markup {
        self.html_with(|column, _, cell| match (column.direction, cell) {
            (Direction::OfMetrics, cell) => metric_link(&cell.plain()),
            (_, Cell::Verdict(true)) => html! { span.pass { (cell.plain()) } },
            (_, Cell::Verdict(false)) => html! { span.fail { (cell.plain()) } },
            (_, cell) => html! { (cell.plain()) },
        })
    }

    /// Table whose cells are rendered by `written`.
    fn html_with(&self, written: impl Fn(&Column, &Row, &Cell) -> Markup) -> Markup {
        // Omits columns without words.
        let has_words = |at: &usize| {
            let mut rows = self.rows.iter();
            rows.any(|row| !row.cells[*at].plain().is_empty())
        };
        let shown = (0..self.columns.len()).filter(has_words);
        let shown: Vec<_> = shown.map(|at| (at, self.class(at))).collect();
        let table = html! {
            table.sorts {
                caption { (self.caption) }
                thead { tr { @for (at, class) in &shown { th scope="col" class=[class] { (self.columns[*at].head().plain()) } } } }
                tbody {
                    @for row in &self.rows {
                        tr {
                            @for (at, class) in &shown { td class=[class] data-v=[row.cells[*at].exact_text()] { (written(&self.columns[*at], row, &row.cells[*at])) } }
                        } "\n"
                    }
                }
            }
        };
        html! {
            @if self.rows.is_empty() { p { (self.caption) ": none." } "\n" } @else { (scroll(&self.caption, &table)) }
            @for note in &self.notes { p.note { (note.plain()) } "\n" }
        }
    }

    /// CSS class of the cells of a column, for alignment and wrapping.
    fn class(&self, column: usize) -> Option<&'static str> {
        let lengths = self.rows.iter().map(|row| &row.cells[column]);
        let lengths = lengths.map(|cell| cell.plain().chars().count());
        match lengths.max().unwrap_or(0) {
            _ if self.is_right(column) => Some("r"),
            letters if letters > VERY_LONG => Some("wrap long"),
            letters if letters > LONG => Some("wrap"),
            _ => None,
        }
    }
}
