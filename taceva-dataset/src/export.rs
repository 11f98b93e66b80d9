//! A dataset for other programs: its table as CSV, the whole as Parquet with pictures.

mod hugging_face;

use std::io::{self, Write};

use crate::dataset::Dataset;

pub use hugging_face::export_hugging_face;

/// Writes the labels of `dataset` as CSV: a row a sample, bare channel names, an empty cell where there is no value.
///
/// Numbers are in the shortest form that reads back to the same binary64; the units are those of the header. The column
/// `frame` is relative to the folder of the dataset.
///
/// # Errors
/// Those of `writer`.
pub fn export_csv(dataset: &Dataset, writer: impl Write) -> io::Result<()> {
    let table = dataset.table();
    let columns = table.columns();
    let mut writer = csv::Writer::from_writer(writer);
    writer.write_record(columns.iter().map(|column| column.name))?;
    for row in 0..table.rows() {
        writer.write_record(
            columns
                .iter()
                .map(|column| column.cells.text(row).unwrap_or_default()),
        )?;
    }
    writer.flush()
}
