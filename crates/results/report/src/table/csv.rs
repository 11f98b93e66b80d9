//! Tables as CSV.

use super::{Cell, Table};
use taceva_results::escape_csv;

impl Table {
    /// CSV for programs and spreadsheets. Text that begins like a formula gets a leading apostrophe.
    pub fn csv(&self) -> String {
        let mut writer = ::csv::Writer::from_writer(Vec::new());
        let mut write = |record: Vec<String>| {
            writer
                .write_record(record)
                .expect("a buffer takes whatever is written, and rows are equally long");
        };
        let (head, rows) = self.for_programs();
        write(head.iter().map(|name| escape_csv(name)).collect());
        for row in rows {
            let cell = |cell: &Cell| match cell {
                Cell::Number(text) | Cell::Rounded { exact: text, .. } => text.clone(),
                cell => escape_csv(&cell.plain()),
            };
            write(row.iter().map(cell).collect());
        }
        let bytes = writer
            .into_inner()
            .expect("a buffer takes whatever is written");
        String::from_utf8(bytes).expect("made of texts")
    }
}
