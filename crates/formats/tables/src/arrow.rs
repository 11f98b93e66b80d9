//! Tables in Arrow files: streams of record batches, as `datasets` saves them, and Feather.

mod batch;
mod field;
mod reader;

use std::path::Path;

use self::batch::{Batch, Message};
use self::field::{Field, Schema};
use self::reader::Reader;
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::limits;
use crate::parquet::{ColumnKind, Found, Node, names};
use crate::source::Source;

/// Number of rows whose values are converted to cells at once.
const ROWS_AT_ONCE: u64 = 64;
/// First bytes of an Arrow file with a footer. A stream of messages follows.
const FILE_MARK: &[u8] = b"ARROW1\0\0";
/// Maximum number of record batches of a file.
const BATCHES: usize = 1 << 20;

/// Table in an Arrow file: a stream, as `datasets` of Hugging Face writes with `save_to_disk`, or Feather version 2.
///
/// Opening reads the metadata of all batches, but no cells. Buffers may be compressed with LZ4 or Zstandard. Threads may share a table.
///
/// ```
/// use taceva_tables::{ArrowTable, Cell, ColumnKind};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.arrow");
/// let table = ArrowTable::open(path.as_ref())?;
/// assert_eq!(table.names(), ["t", "ft", "image.bytes", "image.path"]);
/// assert_eq!(table.kind("ft")?, ColumnKind::List(Box::new(ColumnKind::Number)));
/// assert_eq!(table.column("ft[2]")?, [Cell::Number(2.0), Cell::Number(3.5)]);
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Debug)]
pub struct ArrowTable {
    source: Source,
    fields: Vec<Field>,
    columns: Vec<Node>,
    written: Vec<(String, String)>,
    batches: Vec<Batch>,
    rows: u64,
}

impl ArrowTable {
    /// Opens the table at `path`.
    ///
    /// # Errors
    /// [`TableError::Io`] if the file cannot be read; [`TableError::Damaged`] if it is not an Arrow file, is truncated or inconsistent;
    /// [`TableError::Unsupported`] for a column of an unsupported type; [`TableError::TooLarge`] above the limits.
    pub fn open(path: &Path) -> Result<ArrowTable, TableError> {
        let source = Source::new(path)?;
        let mut file = source.open()?;
        let start = source.bytes(&mut file, 0, source.length().min(8), 8)?;
        let mut at = if start == FILE_MARK { 8 } else { 0 };
        let mut schema: Option<Schema> = None;
        let mut batches = Vec::new();
        let mut rows = 0_u64;
        while let Some(message) = Message::next(&source, &mut file, &mut at)? {
            let place = Place::byte(message.at);
            match (&schema, message.kind) {
                (None, batch::SCHEMA) => {
                    let read = message.header().and_then(field::schema);
                    schema = Some(read.map_err(|problem| source.unsupported(place, problem))?);
                }
                (Some(schema), batch::RECORDS) => {
                    let read = Batch::new(&message, rows, schema.buffers);
                    let batch = read.map_err(|problem| source.damaged(place, problem))?;
                    rows = rows.saturating_add(batch.rows);
                    batches.push(batch);
                }
                (_, kind) => {
                    let problem = format!(
                        "a message has kind {kind}, expected {}",
                        match schema {
                            None => "the schema",
                            Some(_) => "a batch of rows",
                        }
                    );
                    return Err(source.damaged(place, problem));
                }
            }
            if rows > limits::ROWS || batches.len() > BATCHES {
                let problem = format!(
                    "{rows} rows in {} batches, at most {} in {BATCHES} are accepted",
                    batches.len(),
                    limits::ROWS
                );
                return Err(source.too_large(Place::default(), problem));
            }
        }
        let Some(schema) = schema else {
            return Err(source.damaged(Place::default(), "the Arrow stream has no schema"));
        };
        Ok(ArrowTable {
            columns: schema.fields.iter().map(Field::node).collect(),
            fields: schema.fields,
            written: schema.written,
            source,
            batches,
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

    /// Schema metadata under `key`, such as `huggingface`; `None` without this key.
    ///
    /// ```
    /// # use taceva_tables::ArrowTable;
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.arrow");
    /// assert_eq!(ArrowTable::open(path.as_ref())?.metadata("huggingface"), None);
    /// # Ok::<(), taceva_tables::TableError>(())
    /// ```
    pub fn metadata(&self, key: &str) -> Option<&str> {
        let found = self.written.iter().find(|(known, _)| known == key)?;
        Some(&found.1)
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
    /// [`TableError::Missing`] if the column does not exist; [`TableError::Mismatch`] if a list is too short for `name` in some row; [`TableError::TooLarge`]
    /// if the cells take more than 320 MiB of memory; [`TableError::Damaged`] if a batch is invalid.
    pub fn column(&self, name: &str) -> Result<Vec<Cell>, TableError> {
        let found = Found::new(&self.source, &self.columns, name)?;
        let field = self.field(name)?;
        let (mut cells, mut bytes) = (Vec::new(), 0_u64);
        for batch in &self.batches {
            let mut reader = Reader::new(&self.source, batch, name)?;
            let mut begin = 0;
            while begin < batch.rows {
                let count = ROWS_AT_ONCE.min(batch.rows - begin);
                reader.left = limits::COLUMN_BYTES.saturating_sub(bytes);
                for cell in reader.cells(&field, begin, count)? {
                    let cell = found.inside(&self.source, cells.len(), cell)?;
                    bytes = bytes.saturating_add(cell.bytes());
                    cells.push(cell);
                }
                begin += count;
            }
        }
        Ok(cells)
    }

    /// Calls `each` with each row of `sorted` and the bytes in the column `name`, such as `image.bytes`; [`None`] if the cell is null. Keeps one cell
    /// in memory, or the decompressed buffers of the column in one batch.
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
        let field = self.field(name)?;
        if found.kind() != Some(ColumnKind::Bytes) {
            let problem = "its cells are not bytes".to_owned();
            return Err(self.source.mismatch(name, problem).into());
        }
        crate::rows::check_sorted(&self.source, name, sorted, self.rows)?;
        let mut wanted = sorted;
        for batch in &self.batches {
            let end = batch.first + batch.rows;
            let (here, later) = wanted.split_at(wanted.partition_point(|row| *row < end));
            wanted = later;
            if here.is_empty() {
                continue;
            }
            let mut reader = Reader::new(&self.source, batch, name)?;
            for row in here {
                reader.left = limits::CELL_BYTES;
                let mut cells = reader.cells(&field, row - batch.first, 1)?;
                let cell = cells.pop().unwrap_or(Cell::Null);
                let bytes = match found.inside(&self.source, cells.len(), cell)? {
                    Cell::Bytes(bytes) => Some(bytes),
                    _ => None,
                };
                each(*row, bytes)?;
            }
        }
        Ok(())
    }

    /// Finds the column whose name `name` begins with. Of a structure, keeps only the member that `name` selects.
    fn field(&self, name: &str) -> Result<Field, TableError> {
        field::named(&self.fields, name).ok_or_else(|| self.source.missing(name, self.names()))
    }
}
