//! Tables as Markdown.

use super::{Row, Table, Words};

impl Table {
    /// Rows as Markdown, followed by the notes as paragraphs. Omits the caption.
    pub fn markdown(&self) -> String {
        let line = |cells: &[Words]| {
            let cells: Vec<String> = cells.iter().map(Words::in_markdown).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = (0..self.columns.len())
            .map(|column| if self.is_right(column) { "---:" } else { "---" });
        let head: Vec<Words> = self.columns.iter().map(|column| column.head()).collect();
        let mut out = line(&head);
        out += &format!("|{}|\n", rule.collect::<Vec<_>>().join("|"));
        let row = |row: &Row| line(&self.words_of(row));
        out.extend(self.rows.iter().map(row));
        for note in &self.notes {
            out += &format!("\n{}\n", note.in_markdown());
        }
        out
    }
}
