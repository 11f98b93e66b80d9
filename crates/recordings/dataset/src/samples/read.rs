//! Reads the columns of a Parquet file by name.

use std::collections::BTreeMap;
use std::fs::File;

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::limits;

/// Cells of a column in their stored type.
pub(super) enum Stored {
    Text(Vec<Option<String>>),
    Number(Vec<Option<f64>>),
    Count(Vec<Option<i64>>),
}

impl Stored {
    pub(super) fn len(&self) -> usize {
        match self {
            Stored::Text(cells) => cells.len(),
            Stored::Number(cells) => cells.len(),
            Stored::Count(cells) => cells.len(),
        }
    }
}

pub(super) fn read(file: File) -> Result<BTreeMap<String, Stored>, ParquetError> {
    let general = |text: &str| ParquetError::General(text.to_owned());
    let reader = SerializedFileReader::new(file)?;
    let metadata = reader.metadata();
    let rows = metadata.file_metadata().num_rows();
    let rows = u64::try_from(rows).map_err(|_| general("a negative number of rows"))?;
    if rows > limits::ROWS {
        return Err(general("more rows than a dataset may have"));
    }
    if metadata.num_row_groups() != 1 {
        return Err(general("expected one row group"));
    }
    let group = reader.get_row_group(0)?;
    let schema = metadata.file_metadata().schema_descr();
    let mut columns = BTreeMap::new();
    for (position, descriptor) in schema.columns().iter().enumerate() {
        if descriptor.max_def_level() != 1 || descriptor.max_rep_level() != 0 {
            return Err(general("expected flat optional columns"));
        }
        let stored = match group.get_column_reader(position)? {
            ColumnReader::DoubleColumnReader(column) => {
                Stored::Number(read_values(column, rows, Some)?)
            }
            ColumnReader::Int64ColumnReader(column) => {
                Stored::Count(read_values(column, rows, Some)?)
            }
            ColumnReader::ByteArrayColumnReader(column) => {
                Stored::Text(read_values(column, rows, |bytes: ByteArray| {
                    String::from_utf8(bytes.data().to_vec()).ok()
                })?)
            }
            _ => return Err(general("expected text, 64-bit numbers and counts")),
        };
        columns.insert(descriptor.name().to_owned(), stored);
    }
    Ok(columns)
}

fn read_values<T: DataType, V>(
    mut column: ColumnReaderImpl<T>,
    rows: u64,
    convert: impl Fn(T::T) -> Option<V>,
) -> Result<Vec<Option<V>>, ParquetError> {
    const BATCH: usize = 1 << 16;
    let mut cells = Vec::new();
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    while (cells.len() as u64) < rows {
        levels.clear();
        values.clear();
        let (records, _, _) = column.read_records(BATCH, Some(&mut levels), None, &mut values)?;
        if records == 0 {
            break;
        }
        let mut values = values.drain(..);
        for level in &levels {
            let cell = match level {
                0 => None,
                _ => {
                    let value = values.next().and_then(&convert);
                    Some(value.ok_or_else(|| {
                        ParquetError::General("a value is missing or not a string".to_owned())
                    })?)
                }
            };
            cells.push(cell);
        }
    }
    if cells.len() as u64 != rows {
        return Err(ParquetError::General(
            "columns of different lengths".to_owned(),
        ));
    }
    Ok(cells)
}
