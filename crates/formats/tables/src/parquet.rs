//! Tables in Parquet files.

mod arrow_schema;
mod assembly;
mod cells;
mod column_path;
mod column_writer;
mod kind;
mod leaf;
mod levels;
mod page_header;
mod pages;
mod row_range;
mod schema;
mod stream;
mod values;
mod writer;

use std::path::Path;

use parquet::file::metadata::{ParquetMetaData, ParquetMetaDataReader, RowGroupMetaData};

use self::assembly::Assembly;
use self::cells::Cells;
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::limits;
use crate::source::Source;

pub(crate) use self::column_path::{Found, names};
pub use self::column_writer::{WrittenColumn, WrittenKind, huggingface_features};
pub use self::kind::ColumnKind;
pub(crate) use self::schema::{LeafForm, Node, NodeKind};
pub use self::writer::ParquetWriter;

/// Number of rows decoded at once.
const ROWS_AT_ONCE: usize = 256;

/// Table in a Parquet file, by any writer: columns of numbers, texts, bytes, lists and structures.
///
/// Opening reads only the footer. Pages may be compressed with snappy, gzip, LZ4, brotli or Zstandard. Checksums are verified if present. Threads may share a
/// table, because every call has its own cursor.
///
/// ```
/// use taceva_tables::{Cell, ParquetTable};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.parquet");
/// let table = ParquetTable::open(path.as_ref())?;
/// assert_eq!(table.names(), ["t", "ft", "pose.x", "pose.y", "image.bytes", "image.path", "object"]);
/// assert_eq!(table.column("ft[2]")?, [Cell::Number(2.0), Cell::Number(3.5), Cell::Null]);
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Debug)]
pub struct ParquetTable {
    source: Source,
    metadata: ParquetMetaData,
    columns: Vec<Node>,
    rows: u64,
}

impl ParquetTable {
    /// Opens the table at `path`.
    ///
    /// # Errors
    /// [`TableError::Io`] if the file cannot be read; [`TableError::Damaged`] if it is not a Parquet file or its footer is inconsistent;
    /// [`TableError::Unsupported`] for an encrypted footer or unsupported schema; [`TableError::TooLarge`] if the footer or table exceeds the limits.
    pub fn open(path: &Path) -> Result<ParquetTable, TableError> {
        let source = Source::new(path)?;
        let mut file = source.open()?;
        check_footer(&source, &mut file)?;
        let metadata = ParquetMetaDataReader::new()
            .parse_and_finish(&file)
            .map_err(|error| {
                source.damaged(Place::default(), format!("invalid footer: {error}"))
            })?;
        let mut columns = schema::columns(metadata.file_metadata().schema_descr())
            .map_err(|problem| source.unsupported(Place::default(), problem))?;
        if let Some(text) = written(&metadata, "ARROW:schema") {
            arrow_schema::apply(text, &mut columns);
        }
        let mut rows = 0_u64;
        for (at, group) in metadata.row_groups().iter().enumerate() {
            let more = u64::try_from(group.num_rows()).map_err(|_| {
                let problem = format!("group {at} has {} rows", group.num_rows());
                source.damaged(Place::default(), problem)
            })?;
            rows = rows.saturating_add(more);
        }
        if rows > limits::ROWS {
            let problem = format!("{rows} rows, at most {} are accepted", limits::ROWS);
            return Err(source.too_large(Place::default(), problem));
        }
        let stated = metadata.file_metadata().num_rows();
        if u64::try_from(stated) != Ok(rows) {
            let problem = format!("the footer states {stated} rows, but its groups have {rows}");
            return Err(source.damaged(Place::default(), problem));
        }
        Ok(ParquetTable {
            source,
            metadata,
            columns,
            rows,
        })
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        self.source.path()
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Names of the columns, in the order of the schema. The list has the members of a structure, such as `pose.x`, and not the structure.
    pub fn names(&self) -> Vec<String> {
        names(&self.columns)
    }

    /// Metadata of the table under `key`, such as `huggingface`, whose JSON contains the names of classes; `None` without this key.
    ///
    /// ```
    /// # use taceva_tables::ParquetTable;
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.parquet");
    /// assert_eq!(ParquetTable::open(path.as_ref())?.metadata("huggingface"), None);
    /// # Ok::<(), taceva_tables::TableError>(())
    /// ```
    pub fn metadata(&self, key: &str) -> Option<&str> {
        written(&self.metadata, key)
    }

    /// Kind of the cells of the column `name`, which may be a structure or an element of lists.
    ///
    /// # Errors
    /// [`TableError::Missing`] if the column does not exist.
    pub fn kind(&self, name: &str) -> Result<ColumnKind, TableError> {
        let kind = Found::new(&self.source, &self.columns, name)?.kind();
        kind.ok_or_else(|| self.source.missing(name, self.names()))
    }

    /// Cells of the column `name`, row by row. `name` is one of [`names`](Self::names), a whole structure, or an element of lists: `ft[2]`,
    /// `ft[2,0]`.
    ///
    /// # Errors
    /// [`TableError::Missing`] if the column does not exist. [`TableError::Mismatch`] if a list is too short for `name` in some row. [`TableError::TooLarge`]
    /// if the cells exceed a limit of 96 to 320 MiB, which depends on the size of the file. [`TableError::Damaged`] for an invalid page.
    pub fn column(&self, name: &str) -> Result<Vec<Cell>, TableError> {
        let mut cells = Vec::new();
        self.read_column(name, &mut 0, &mut cells)?;
        Ok(cells)
    }

    /// Appends the cells of the column `name` to `cells`. Adds their memory in bytes to `bytes`.
    pub(crate) fn read_column(
        &self,
        name: &str,
        bytes: &mut u64,
        cells: &mut Vec<Cell>,
    ) -> Result<(), TableError> {
        let found = Found::new(&self.source, &self.columns, name)?;
        let before = cells.len();
        let most = limits::column_bytes(self.source.length());
        for group in self.metadata.row_groups() {
            let mut assembly = Assembly::new(&self.source, group, found.column())?;
            let mut left = rows_of(group);
            while left > 0 {
                let rows = left.min(ROWS_AT_ONCE);
                assembly.read(&self.source, rows, &mut |cell| {
                    let cell = found.inside(&self.source, cells.len() - before, cell)?;
                    *bytes = bytes.saturating_add(cell.bytes());
                    if *bytes > most {
                        let problem = format!(
                            "more than {most} bytes in memory, for a file of {}; split the file, or read a part of a list, such \
                             as `{name}[0]`",
                            self.source.length()
                        );
                        return Err(self.source.too_large(Place::of(name), problem));
                    }
                    cells.push(cell);
                    Ok(())
                })?;
                left -= rows;
            }
        }
        Ok(())
    }

    /// Calls `each` with each row of `sorted` and the bytes in the column `name`, such as `image.bytes`; [`None`] if the cell is null. Keeps one cell
    /// and its decoder in memory, or one page if its encoding is not `PLAIN`.
    ///
    /// `sorted` must be ascending. A row listed twice is passed twice.
    ///
    /// # Errors
    /// Errors of [`column`](Self::column). [`TableError::Mismatch`] if the column has no bytes, or if `sorted` is not ascending or contains a row that does not
    /// exist. Also the errors of `each`.
    pub fn visit_bytes<E: From<TableError>>(
        &self,
        name: &str,
        sorted: &[u64],
        each: &mut dyn FnMut(u64, Option<Vec<u8>>) -> Result<(), E>,
    ) -> Result<(), E> {
        let found = Found::new(&self.source, &self.columns, name)?;
        crate::rows::check_sorted(&self.source, name, sorted, self.rows)?;
        let mut wanted = sorted;
        let mut begin = 0;
        for group in self.metadata.row_groups() {
            let end = begin + rows_of(group) as u64;
            let (here, later) = wanted.split_at(wanted.partition_point(|row| *row < end));
            wanted = later;
            if !here.is_empty() {
                let mut cells = Cells::new(&self.source, group, &found)?;
                let mut next = begin;
                for run in here.chunk_by(|a, b| a == b) {
                    let row = run[0];
                    cells.skip(row - next)?;
                    next = row + 1;
                    let bytes = cells.next(&self.source, &found, row)?;
                    for _ in &run[1..] {
                        each(row, bytes.clone())?;
                    }
                    each(row, bytes)?;
                }
            }
            begin = end;
        }
        Ok(())
    }
}

/// Metadata in the footer under `key`.
fn written<'m>(metadata: &'m ParquetMetaData, key: &str) -> Option<&'m str> {
    let all = metadata.file_metadata().key_value_metadata()?;
    let found = all.iter().find(|entry| entry.key == key)?;
    found.value.as_deref()
}

/// Number of rows of a row group. The sum over all groups was checked when the file was opened.
fn rows_of(group: &RowGroupMetaData) -> usize {
    usize::try_from(group.num_rows()).unwrap_or(0)
}

/// Checks the last 8 bytes: the length of the footer must fit the file and the limit, and the magic bytes must follow.
fn check_footer(source: &Source, file: &mut std::fs::File) -> Result<(), TableError> {
    let Some(at) = source.length().checked_sub(8) else {
        let problem = format!("{} bytes are too few for a Parquet file", source.length());
        return Err(source.damaged(Place::default(), problem));
    };
    let end = source.bytes(file, at, 8, 8)?;
    let (length, mark) = end.split_at(4);
    match mark {
        b"PAR1" => {}
        b"PARE" => {
            let problem = "the footer is encrypted, which is not supported";
            return Err(source.unsupported(Place::byte(at), problem));
        }
        _ => {
            let problem = "not a Parquet file, or cut short: it does not end with `PAR1`";
            return Err(source.damaged(Place::byte(at), problem));
        }
    }
    let length = u64::from(u32::from_le_bytes([
        length[0], length[1], length[2], length[3],
    ]));
    if length > limits::DESCRIPTION_BYTES {
        let problem = format!(
            "the footer has {length} bytes, at most {} are accepted",
            limits::DESCRIPTION_BYTES
        );
        return Err(source.too_large(Place::byte(at), problem));
    }
    match length <= at {
        true => Ok(()),
        false => Err(source.damaged(
            Place::byte(at),
            format!("the footer has {length} bytes, but only {at} bytes are before its end"),
        )),
    }
}
