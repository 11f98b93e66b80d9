//! Writer of Parquet files, row by row.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::column_writer::{WrittenColumn, write_column};
use crate::cell::Cell;
use crate::error::TableError;

/// Maximum number of rows of a row group. To read one row, a reader must read its whole group.
const GROUP_ROWS: usize = 1000;
/// Memory size of the cells of a row group at which the group ends before `GROUP_ROWS` rows, bytes.
const GROUP_BYTES: u64 = 16 << 20;

/// Writer of a Parquet file. Keeps one row group in memory and compresses it with snappy when it is full. Files of equal rows have equal bytes.
///
/// ```
/// use taceva_tables::{Cell, ParquetTable, ParquetWriter, WrittenColumn, WrittenKind};
///
/// # let path = std::env::temp_dir().join(format!("taceva-written-{}.parquet", std::process::id()));
/// let columns = [
///     WrittenColumn::new("press", WrittenKind::Text),
///     WrittenColumn::new("wrench", WrittenKind::Numbers(Some(2))),
/// ];
/// let mut writer = ParquetWriter::create(&path, &columns, &[("unit.wrench", "N")])?;
/// let wrench = vec![Cell::Number(0.5), Cell::Number(-2.0)];
/// writer.push(vec![Cell::Text("a".into()), Cell::List(wrench)])?;
/// writer.push(vec![Cell::Text("b".into()), Cell::Null])?;
/// writer.finish()?;
///
/// let table = ParquetTable::open(&path)?;
/// assert_eq!(table.column("wrench[1]")?, [Cell::Number(-2.0), Cell::Null]);
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
pub struct ParquetWriter {
    path: PathBuf,
    columns: Vec<WrittenColumn>,
    writer: SerializedFileWriter<File>,
    /// Cells of the rows that are not yet in a written row group, by column.
    held: Vec<Vec<Cell>>,
    held_bytes: u64,
}

impl ParquetWriter {
    /// Creates the file at `path`. `metadata` contains pairs of a key and a text.
    ///
    /// # Errors
    /// [`TableError::Write`] if the file exists already or cannot be created. [`TableError::Mismatch`] if two columns have the same name.
    pub fn create(
        path: &Path,
        columns: &[WrittenColumn],
        metadata: &[(&str, &str)],
    ) -> Result<ParquetWriter, TableError> {
        for (position, column) in columns.iter().enumerate() {
            if columns[..position]
                .iter()
                .any(|other| other.name == column.name)
            {
                return Err(mismatch(
                    path,
                    &column.name,
                    "two columns have this name".to_owned(),
                ));
            }
        }
        let failed = |error| failed(path, error);
        let fields = columns.iter().map(|column| column.field().map(Arc::new));
        let fields: Result<Vec<_>, ParquetError> = fields.collect();
        let schema = Type::group_type_builder("schema").with_fields(fields.map_err(failed)?);
        let schema = schema.build().map_err(failed)?;
        let metadata = metadata.iter();
        let metadata =
            metadata.map(|(key, text)| KeyValue::new((*key).to_owned(), (*text).to_owned()));
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_created_by("taceva".to_owned())
            .set_key_value_metadata(Some(metadata.collect()))
            .build();
        let file = File::create_new(path).map_err(|source| TableError::Write {
            path: path.to_owned(),
            source,
        })?;
        let writer = SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties));
        Ok(ParquetWriter {
            path: path.to_owned(),
            held: vec![Vec::new(); columns.len()],
            columns: columns.to_vec(),
            writer: writer.map_err(failed)?,
            held_bytes: 0,
        })
    }

    /// Adds a row, one cell for each column.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] if a cell has the wrong kind or the number of cells is wrong; the row is not written. [`TableError::Write`] if a row group
    /// cannot be written.
    pub fn push(&mut self, row: Vec<Cell>) -> Result<(), TableError> {
        if row.len() != self.columns.len() {
            let problem = format!("{} cells for {} columns", row.len(), self.columns.len());
            return Err(mismatch(&self.path, "row", problem));
        }
        for (column, cell) in self.columns.iter().zip(&row) {
            if !column.kind.takes(cell) {
                let problem = format!("`{}`, expected {}", cell.text(), column.kind);
                return Err(mismatch(&self.path, &column.name, problem));
            }
        }
        for (cells, cell) in self.held.iter_mut().zip(row) {
            self.held_bytes += cell.bytes();
            cells.push(cell);
        }
        let rows = self.held.first().map_or(0, Vec::len);
        match rows >= GROUP_ROWS || self.held_bytes >= GROUP_BYTES {
            true => self.write_group(),
            false => Ok(()),
        }
    }

    /// Approximate size of the file, bytes: the written content plus the uncompressed cells in memory.
    pub fn size_bytes(&self) -> u64 {
        self.writer.bytes_written() as u64 + self.held_bytes
    }

    /// Ends the file and syncs its content to the disk. The name of the file is not synced.
    ///
    /// # Errors
    /// [`TableError::Write`] if the file cannot be written.
    pub fn finish(mut self) -> Result<(), TableError> {
        if self.held.first().is_some_and(|cells| !cells.is_empty()) {
            self.write_group()?;
        }
        let path = self.path;
        let file = self
            .writer
            .into_inner()
            .map_err(|error| failed(&path, error))?;
        file.sync_all()
            .map_err(|source| TableError::Write { path, source })
    }

    fn write_group(&mut self) -> Result<(), TableError> {
        let failed = |error| failed(&self.path, error);
        let mut group = self.writer.next_row_group().map_err(failed)?;
        for (column, cells) in self.columns.iter().zip(&self.held) {
            write_column(&mut group, &column.kind, cells).map_err(failed)?;
        }
        group.close().map_err(failed)?;
        self.held.iter_mut().for_each(Vec::clear);
        self.held_bytes = 0;
        Ok(())
    }
}

impl std::fmt::Debug for ParquetWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParquetWriter")
            .field("path", &self.path)
            .field("columns", &self.columns)
            .finish_non_exhaustive()
    }
}

fn mismatch(path: &Path, name: &str, problem: String) -> TableError {
    TableError::Mismatch {
        path: path.to_owned(),
        name: name.to_owned(),
        problem,
    }
}

/// Extracts the error of the operating system from an error of the `parquet` crate.
fn failed(path: &Path, error: ParquetError) -> TableError {
    let source = match error {
        ParquetError::External(source) => match source.downcast::<io::Error>() {
            Ok(source) => *source,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other.to_string()),
    };
    TableError::Write {
        path: path.to_owned(),
        source,
    }
}
