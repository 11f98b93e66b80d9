//! Tables as plain text of the width of a terminal.

use super::{Table, Words};
use crate::escape;
use crate::wrap::wrapped;

/// Gap between two columns of plain text, in characters.
const GAP: usize = 2;

impl Table {
    /// Text in lines of at most `width` characters. Columns that do not fit next to the first column follow below, again next to the first column.
    ///
    /// If no column fits, each column is a list of its head and one line for each row. A table without rows has no heads.
    ///
    /// ```
    /// use taceva_report::{Column, Table};
    /// let mut table = Table::new("", [Column::new("score"), Column::new("GelSight"), Column::new("MagicTac")]);
    /// table.push(["mae Fz (N)", "0.0361", "0.0544"]);
    /// assert_eq!(table.text_within(40), table.text());
    /// let narrow = "score       GelSight\nmae Fz (N)    0.0361\n\nscore       MagicTac\nmae Fz (N)    0.0544\n";
    /// assert_eq!(table.text_within(20), narrow);
    /// assert!(table.text_within(18).starts_with("GelSight\n  mae Fz (N):\n"));
    /// ```
    pub fn text_within(&self, width: usize) -> String {
        let widths = self.widths();
        let Some((first, others)) = widths.split_first() else {
            return self.text();
        };
        let fits = others.iter().all(|column| first + GAP + column <= width);
        let mut parts: Vec<String> = match self.caption.as_str() {
            "" => Vec::new(),
            caption => vec![wrapped(&escape::terminal(caption), width, 0)],
        };
        match fits {
            _ if self.rows.is_empty() => {}
            true => parts.extend(
                self.groups(&widths, width)
                    .iter()
                    .map(|of| self.part(of).text()),
            ),
            false => parts.extend((1..widths.len()).map(|column| self.list(column, width))),
        }
        let notes = self.notes.iter();
        parts.extend(notes.map(|note| wrapped(&escape::terminal(note.plain()), width, 0)));
        parts.join("\n")
    }

    /// Widest cell or head of each column, in characters.
    fn widths(&self) -> Vec<usize> {
        let count = |words: &Words| escape::terminal(words.plain()).chars().count();
        let mut widths: Vec<usize> = self.columns.iter().map(|of| count(&of.head())).collect();
        for row in &self.rows {
            for (width, words) in widths.iter_mut().zip(self.words_of(row)) {
                *width = (*width).max(count(&words));
            }
        }
        widths
    }

    /// Columns after the first column, in groups that fit next to the first column.
    fn groups(&self, widths: &[usize], width: usize) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut used = 0;
        for (column, of_column) in widths.iter().enumerate().skip(1) {
            let more = GAP + of_column;
            match groups.last_mut() {
                Some(group) if used + more <= width => {
                    group.push(column);
                    used += more;
                }
                _ => {
                    groups.push(vec![column]);
                    used = widths[0] + more;
                }
            }
        }
        if groups.is_empty() {
            groups.push(Vec::new());
        }
        groups
    }

    /// Table of the first column and the given columns, without caption and notes.
    fn part(&self, columns: &[usize]) -> Table {
        let shown: Vec<usize> = [0].into_iter().chain(columns.iter().copied()).collect();
        let Table { columns, rows, .. } = self.of_columns(&shown);
        Table {
            columns,
            rows,
            ..Table::default()
        }
    }

    /// One column as a list.
    fn list(&self, column: usize, width: usize) -> String {
        let head = self.columns[column].head();
        let mut out = wrapped(&escape::terminal(head.plain()), width, 0);
        for row in &self.rows {
            let words = self.words_of(row);
            let [name, value] = [0, column].map(|at| escape::terminal(words[at].plain()));
            out += &wrapped(&format!("{name}: {value}"), width, 2);
        }
        out
    }
}
