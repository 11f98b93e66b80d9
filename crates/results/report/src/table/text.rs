//! Tables as plain text.

use super::{Align, Row, Table, Words};
use crate::escape;

impl Table {
    /// Text for a terminal: columns as wide as their longest cell, right-aligned numbers, escaped control characters.
    pub fn text(&self) -> String {
        let shown = |words: &[Words]| -> Vec<String> {
            let cells = words.iter().map(|words| escape::terminal(words.plain()));
            cells.collect()
        };
        let head: Vec<Words> = self.columns.iter().map(|column| column.head()).collect();
        let head = shown(&head);
        let rows: Vec<(&Row, Vec<String>)> = self
            .rows
            .iter()
            .map(|row| (row, shown(&self.words_of(row))))
            .collect();
        let widths: Vec<usize> = (0..head.len())
            .map(|column| {
                let cells = rows.iter().map(|(_, cells)| &cells[column]);
                let cells = cells.chain([&head[column]]);
                cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
            })
            .collect();
        let line = |cells: &[String], is_right: &dyn Fn(usize) -> bool| {
            let cells = cells.iter().zip(&widths).enumerate();
            let cells = cells.map(|(column, (cell, width))| match is_right(column) {
                true => format!("{cell:>width$}"),
                false => format!("{cell:<width$}"),
            });
            let line = cells.collect::<Vec<_>>().join("  ");
            format!("{}\n", line.trim_end())
        };
        let mut out = match self.caption.as_str() {
            "" => String::new(),
            caption => format!("{}\n\n", escape::terminal(caption)),
        };
        out += &line(&head, &|column| self.is_head_right(column));
        for (row, cells) in &rows {
            out += &line(cells, &|column| self.is_cell_right(row, column));
        }
        for note in &self.notes {
            out += &format!("\n{}", escape::terminal(note.plain()));
        }
        if !self.notes.is_empty() {
            out.push('\n');
        }
        out
    }

    fn is_head_right(&self, column: usize) -> bool {
        match self.columns[column].align {
            Align::ByCell => {
                let mut rows = self.rows.iter();
                rows.any(|row| row.cells[column].is_number())
            }
            _ => self.is_right(column),
        }
    }

    fn is_cell_right(&self, row: &Row, column: usize) -> bool {
        match self.columns[column].align {
            Align::ByCell => row.cells[column].is_number(),
            _ => self.is_right(column),
        }
    }
}
