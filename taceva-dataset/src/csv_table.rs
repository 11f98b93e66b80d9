//! A table of text, read whole and fast: columns are parsed when asked for.

mod number;
mod quoted;
mod split;

use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::{Path, PathBuf};

use taceva_core::Column;

use crate::digest::Digest;
use crate::error::{DatasetError, Place};
use crate::file::read_capped;
use crate::limits;
use crate::parallel::{all_cores, each_part};
use crate::text::{nearest, shown};

use number::parse_number;
use split::Block;

pub(crate) use number::number_hint;

/// A CSV file with a header, in memory.
///
/// Commas, semicolons and tabs are told apart by the header; a byte order mark, CRLF, blank lines and quoted cells are
/// understood. A decimal text becomes the nearest binary64, an empty cell is an absent value.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("truth.csv");
/// std::fs::write(&path, "id,Fz\na,0.5\nb,\n")?;
/// let table = taceva_dataset::CsvTable::read(&path)?;
/// assert_eq!(table.text("id")?, ["a", "b"]);
/// let force = table.numbers("Fz")?;
/// assert_eq!((force.get(0), force.get(1)), (Some(0.5), None));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CsvTable {
    path: PathBuf,
    names: Vec<String>,
    text: String,
    blocks: Vec<Block>,
    rows: usize,
    /// The line of each row, where quoted cells may hold line ends; else lines are counted in the text.
    lines: Option<Vec<u64>>,
}

/// What to do with a cell that is neither empty nor a finite number.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Invalid {
    Refuse,
    AsNan,
}

impl CsvTable {
    /// Reads the file at `path` on all cores.
    ///
    /// # Errors
    /// [`DatasetError::Table`] naming the line if rows have different lengths, names repeat, a quote is not closed, or the text is
    /// not UTF-8; [`DatasetError::Path`] if it is no regular file or above 4 GiB; [`DatasetError::Io`].
    pub fn read(path: &Path) -> Result<CsvTable, DatasetError> {
        CsvTable::read_with(path, all_cores())
    }

    /// Reads the file at `path` on `jobs` threads; the result is the same for any number.
    ///
    /// # Errors
    /// As [`read`](CsvTable::read).
    pub fn read_with(path: &Path, jobs: NonZeroUsize) -> Result<CsvTable, DatasetError> {
        let text = as_text(path, read_capped(path, limits::TABLE_BYTES)?)?;
        let first_line = text.lines().next().unwrap_or("");
        let delimiter = delimiter_of(first_line);
        let table = if text.as_bytes().contains(&b'"') {
            quoted::read(path, &text, delimiter)?
        } else {
            split::read(path, text, delimiter, jobs)?
        };
        table.check_names()?;
        Ok(table)
    }

    /// The file it was read from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The digest of its text.
    pub fn digest(&self) -> Digest {
        Digest::of(self.text.as_bytes())
    }

    /// The names of the columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows, without the header.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether there is a column called `name`.
    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|known| known == name)
    }

    /// The numbers of the column called `name`; empty cells are absent.
    ///
    /// # Errors
    /// [`DatasetError::Table`] if there is no such column, or at the first cell that is no finite number.
    pub fn numbers(&self, name: &str) -> Result<Column, DatasetError> {
        self.parse(name, Invalid::Refuse)
    }

    /// The numbers of the column called `name`, with NaN for each cell that is no finite number, so that they can be counted.
    ///
    /// # Errors
    /// [`DatasetError::Table`] if there is no such column.
    pub fn numbers_with_invalid(&self, name: &str) -> Result<Column, DatasetError> {
        self.parse(name, Invalid::AsNan)
    }

    /// The cells of the column called `name` as they are written, without surrounding blanks.
    ///
    /// # Errors
    /// [`DatasetError::Table`] if there is no such column.
    pub fn text(&self, name: &str) -> Result<Vec<&str>, DatasetError> {
        let column = self.position(name)?;
        let mut cells = Vec::with_capacity(self.rows);
        for block in &self.blocks {
            cells.extend((0..block.rows()).map(|row| self.slice(block.cell(row, column)).trim()));
        }
        Ok(cells)
    }

    /// Where the column called `name` stands.
    ///
    /// # Errors
    /// [`DatasetError::Table`], listing the columns there are and suggesting the nearest.
    pub fn position(&self, name: &str) -> Result<usize, DatasetError> {
        self.names
            .iter()
            .position(|known| known == name)
            .ok_or_else(|| {
                let known: Vec<String> = self.names.iter().map(|name| shown(name)).collect();
                let guess = nearest(name, self.names.iter().map(String::as_str))
                    .map_or_else(String::new, |guess| {
                        format!(", did you mean `{}`", shown(guess))
                    });
                DatasetError::Table {
                    place: Place::file(&self.path),
                    problem: format!(
                        "no column `{}`{guess}? the columns are {}",
                        shown(name),
                        known.join(", ")
                    ),
                }
            })
    }

    /// The cell of a row (from 0) and a column (by position), without surrounding blanks.
    ///
    /// # Panics
    /// If there is no such row or column.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        let block = self
            .blocks
            .partition_point(|block| block.first_row + block.rows() <= row);
        let block = &self.blocks[block];
        self.slice(block.cell(row - block.first_row, column)).trim()
    }

    /// The finite number in a cell, or `None` if it is empty.
    ///
    /// # Errors
    /// [`DatasetError::Table`], naming the place, if it holds something else.
    /// # Panics
    /// If there is no such row or column.
    pub fn number(&self, row: usize, column: usize) -> Result<Option<f64>, DatasetError> {
        let cell = self.cell(row, column);
        match parse_number(cell) {
            Some(number) => Ok(number),
            None => Err(self.not_a_number(row, column)),
        }
    }

    /// Where a row (from 0) stands in the file, in the column at `column`.
    pub fn place(&self, row: usize, column: usize) -> Place {
        Place {
            path: self.path.clone(),
            line: Some(self.line(row)),
            column: self.names.get(column).cloned(),
        }
    }

    fn line(&self, row: usize) -> u64 {
        match &self.lines {
            Some(lines) => lines[row],
            None => {
                let block = self
                    .blocks
                    .partition_point(|block| block.first_row + block.rows() <= row);
                let block = &self.blocks[block];
                let start = block.cell(row - block.first_row, 0).start;
                line_at(self.text.as_bytes(), start)
            }
        }
    }

    fn parse(&self, name: &str, invalid: Invalid) -> Result<Column, DatasetError> {
        let column = self.position(name)?;
        let mut values = vec![0.0; self.rows];
        let mut rest = values.as_mut_slice();
        let mut parts = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let (part, after) = rest.split_at_mut(block.rows());
            parts.push((block, part));
            rest = after;
        }
        let outcomes = each_part(parts, |(block, values)| {
            self.parse_block(block, column, values, invalid)
        });
        let mut absent = Vec::new();
        for outcome in outcomes {
            absent.extend(outcome.map_err(|row| self.not_a_number(row, column))?);
        }
        Ok(with_absent(values, &absent))
    }

    /// Fills `values`; returns the rows that are absent, or the first row that is wrong.
    fn parse_block(
        &self,
        block: &Block,
        column: usize,
        values: &mut [f64],
        invalid: Invalid,
    ) -> Result<Vec<usize>, usize> {
        let mut absent = Vec::new();
        for (row, value) in values.iter_mut().enumerate() {
            match parse_number(self.slice(block.cell(row, column))) {
                Some(Some(number)) => *value = number,
                Some(None) => absent.push(block.first_row + row),
                None if invalid == Invalid::AsNan => *value = f64::NAN,
                None => return Err(block.first_row + row),
            }
        }
        Ok(absent)
    }

    fn not_a_number(&self, row: usize, column: usize) -> DatasetError {
        let cell = self.cell(row, column);
        DatasetError::Table {
            place: self.place(row, column),
            problem: format!("`{}` is no finite number{}", shown(cell), number_hint(cell)),
        }
    }

    fn slice(&self, range: Range<usize>) -> &str {
        &self.text[range]
    }

    fn check_names(&self) -> Result<(), DatasetError> {
        let problem = if self.names.len() > limits::TABLE_COLUMNS {
            format!(
                "{} columns, more than the {} that are accepted",
                self.names.len(),
                limits::TABLE_COLUMNS
            )
        } else {
            let mut sorted: Vec<&String> = self.names.iter().collect();
            sorted.sort_unstable();
            match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                Some(pair) => format!("the column `{}` comes twice", shown(pair[0])),
                None => return Ok(()),
            }
        };
        Err(DatasetError::Table {
            place: Place::line(&self.path, 1),
            problem,
        })
    }
}

fn as_text(path: &Path, mut bytes: Vec<u8>) -> Result<String, DatasetError> {
    let refused = |line: u64, problem: &str| DatasetError::Table {
        place: Place::line(path, line),
        problem: problem.to_owned(),
    };
    let start = &bytes[..bytes.len().min(4_096)];
    if start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") || start.contains(&0) {
        return Err(refused(1, "UTF-16 or binary; save the table as UTF-8"));
    }
    if start.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let line = line_at(error.as_bytes(), valid);
        refused(line, "not UTF-8; save the table as UTF-8")
    })?;
    if text.trim().is_empty() {
        return Err(refused(1, "empty, expected a header with column names"));
    }
    if text.contains('\r') && !text.contains('\n') {
        return Err(refused(
            1,
            "lines end in CR alone; save them with LF or CRLF",
        ));
    }
    Ok(text)
}

/// The line, from 1, on which the byte at `offset` stands.
fn line_at(text: &[u8], offset: usize) -> u64 {
    1 + text[..offset].iter().filter(|byte| **byte == b'\n').count() as u64
}

/// The separator that the header has most of; a comma if it has none.
fn delimiter_of(header: &str) -> u8 {
    let count = |delimiter: u8| header.bytes().filter(|byte| *byte == delimiter).count();
    let mut best = b',';
    for candidate in [b';', b'\t'] {
        if count(candidate) > count(best) {
            best = candidate;
        }
    }
    best
}

fn with_absent(values: Vec<f64>, absent: &[usize]) -> Column {
    if absent.is_empty() {
        return Column::full(values);
    }
    let mut absent = absent.iter().copied().peekable();
    let mut column = Column::default();
    for (row, value) in values.into_iter().enumerate() {
        let is_absent = absent.next_if_eq(&row).is_some();
        column.push((!is_absent).then_some(value));
    }
    column
}
