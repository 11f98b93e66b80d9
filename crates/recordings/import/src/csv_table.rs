//! Text table that is completely in memory. Columns are parsed on request.

mod cells;
mod columns;
pub(crate) mod number;
pub(crate) mod parts;
mod quotation;
mod scan;
mod split;
pub(crate) mod stream;
mod table_with_units;
pub(crate) mod text_form;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use taceva_core::nearest;
use taceva_dataset::internal::{all_cores, limits, read_capped, shown};
use taceva_dataset::{Digest, Place};

use number::parse_number;
use split::Block;

use crate::error::{ImportError, table_error};

/// A CSV file with a header, in memory.
///
/// The separator (comma, semicolon or tab) is detected in the header. A byte order mark, CRLF, blank lines and quoted cells are accepted. A
/// decimal text becomes the nearest binary64; an empty cell is an absent value.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("truth.csv");
/// std::fs::write(&path, "id,Fz\na,0.5\nb,\n")?;
/// let table = taceva_import::CsvTable::read(&path)?;
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
    /// Line number of each row, if quoted cells may contain line ends; `None` if every row is one line of the text.
    lines: Option<Vec<u64>>,
    /// Cache of the line number of each row, filled on the first request.
    counted: OnceLock<Vec<u64>>,
    /// Number of lines in the text that are not in the file: the generated header of a headerless file.
    added_lines: u64,
    /// Number of lines of the file before the text, if the text is a part of the file.
    left_out_lines: u64,
}

impl CsvTable {
    /// Maximum size of a text in memory, bytes. [`CsvParts`](crate::CsvParts) reads tables of any length.
    pub const MOST_BYTES: u64 = limits::TABLE_BYTES;

    /// Reads the file at `path` on all cores.
    ///
    /// # Errors
    /// [`ImportError::Table`] naming the line if rows have different lengths, names repeat, a quote is not closed, or the text is not UTF-8;
    /// [`ImportError::Dataset`] if the file is not regular, exceeds 4 GiB or cannot be read.
    pub fn read(path: &Path) -> Result<CsvTable, ImportError> {
        CsvTable::read_with(path, all_cores())
    }

    /// Reads the file at `path` on `jobs` threads. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// Errors of [`read`](CsvTable::read).
    pub fn read_with(path: &Path, jobs: NonZeroUsize) -> Result<CsvTable, ImportError> {
        let text = as_text(path, read_capped(path, limits::TABLE_BYTES)?)?;
        let delimiter = delimiter_of(text.lines().next().unwrap_or(""));
        CsvTable::of_text(path, text, delimiter, jobs)
    }

    /// Reads the headerless file at `path`. The column names are the positions, from `0`.
    ///
    /// # Errors
    /// Errors of [`read`](CsvTable::read).
    pub(crate) fn read_headerless(path: &Path) -> Result<CsvTable, ImportError> {
        let text = as_text(path, read_capped(path, limits::TABLE_BYTES)?)?;
        let delimiter = delimiter_of(text.lines().next().unwrap_or(""));
        let names: Vec<String> = (0..cells_of_first_row(&text, delimiter))
            .map(|position| position.to_string())
            .collect();
        let header = names.join(&char::from(delimiter).to_string());
        let text = format!("{header}\n{text}");
        let read = CsvTable::of_text(path, text, delimiter, all_cores());
        let mut table = read.map_err(ImportError::a_line_above)?;
        table.added_lines = 1;
        Ok(table)
    }

    fn of_text(
        path: &Path,
        text: String,
        delimiter: u8,
        jobs: NonZeroUsize,
    ) -> Result<CsvTable, ImportError> {
        let table = if text.as_bytes().contains(&b'"') {
            quotation::read(path, &text, delimiter)?
        } else {
            split::read(path, text, delimiter, jobs)?
        };
        table.check_names()?;
        Ok(table)
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Digest of the text.
    pub fn digest(&self) -> Digest {
        Digest::of(self.text.as_bytes())
    }

    /// Names of the columns, in file order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows, without the header.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// True if the table has a column called `name`.
    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|known| known == name)
    }

    /// Position of the column called `name`, from 0.
    ///
    /// # Errors
    /// [`ImportError::Table`] if the column does not exist, with the existing columns and the nearest name.
    pub fn position(&self, name: &str) -> Result<usize, ImportError> {
        self.names
            .iter()
            .position(|known| known == name)
            .ok_or_else(|| {
                let known: Vec<String> = self.names.iter().map(|name| shown(name)).collect();
                let guess = nearest(name, self.names.iter().map(String::as_str))
                    .map_or_else(String::new, |guess| {
                        format!(", did you mean `{}`", shown(guess))
                    });
                table_error!(
                    &self.path,
                    "no column `{}`{guess}? the columns are {}",
                    shown(name),
                    known.join(", ")
                )
            })
    }

    /// The cell of a row (from 0) and a column (by position), without surrounding blanks.
    ///
    /// # Panics
    /// Panics if the row or column does not exist.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        self.text[self.block_of(row).cell(row, column)].trim()
    }

    /// Finite number in a cell; `None` if the cell is empty.
    ///
    /// # Errors
    /// [`ImportError::Table`] naming the place, if the cell contains something else.
    /// # Panics
    /// Panics if the row or column does not exist.
    pub fn number(&self, row: usize, column: usize) -> Result<Option<f64>, ImportError> {
        parse_number(&self.text, self.block_of(row).cell(row, column))
            .ok_or_else(|| self.not_a_number(row, column))
    }

    /// Error for a cell that contains something other than `expected`.
    ///
    /// # Panics
    /// Panics if the row or column does not exist.
    pub fn refuse(&self, row: usize, column: usize, expected: &str) -> ImportError {
        table_error!(
            self.place(row, column),
            "`{}`: {expected}",
            shown(self.cell(row, column))
        )
    }

    /// Place of a row (from 0) and column in the file, for messages.
    pub fn place(&self, row: usize, column: usize) -> Place {
        let place = Place::line(&self.path, self.line(row));
        match self.names.get(column) {
            Some(name) => place.in_column(name),
            None => place,
        }
    }

    fn line(&self, row: usize) -> u64 {
        let line = match &self.lines {
            Some(lines) => lines[row],
            None => self.counted.get_or_init(|| self.count_lines())[row],
        };
        line - self.added_lines + self.left_out_lines
    }

    /// Computes the line number of every row in one pass over the text.
    fn count_lines(&self) -> Vec<u64> {
        let (mut line, mut counted) = (1, 0);
        let rows = 0..self.rows;
        rows.map(|row| {
            let start = self.block_of(row).cell(row, 0).start;
            let between = &self.text.as_bytes()[counted..start];
            line += between.iter().filter(|byte| **byte == b'\n').count() as u64;
            counted = start;
            line
        })
        .collect()
    }

    /// Block that contains `row`.
    ///
    /// # Panics
    /// Panics if the row does not exist.
    fn block_of(&self, row: usize) -> &Block {
        let position = self.blocks.partition_point(|block| block.rows.end <= row);
        &self.blocks[position]
    }

    fn not_a_number(&self, row: usize, column: usize) -> ImportError {
        let cell = self.cell(row, column);
        table_error!(
            self.place(row, column),
            "`{}` {}",
            shown(cell),
            number::not_a_number(cell)
        )
    }

    fn check_names(&self) -> Result<(), ImportError> {
        let problem = if self.names.len() > limits::TABLE_COLUMNS {
            format!(
                "{} columns, expected at most {}",
                self.names.len(),
                limits::TABLE_COLUMNS
            )
        } else {
            let mut sorted: Vec<&String> = self.names.iter().collect();
            sorted.sort_unstable();
            match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                Some(pair) => format!("the column `{}` occurs twice", shown(pair[0])),
                None => return Ok(()),
            }
        };
        Err(ImportError::table(Place::line(&self.path, 1), problem))
    }
}

fn as_text(path: &Path, mut bytes: Vec<u8>) -> Result<String, ImportError> {
    let refused = |line: u64, problem: &str| ImportError::table(Place::line(path, line), problem);
    let start = &bytes[..bytes.len().min(4_096)];
    let is_utf16 = start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff");
    let nothing = start.iter().position(|byte| *byte == 0);
    match (is_utf16, nothing) {
        (true, _) => return Err(refused(1, "UTF-16 or binary; save the table as UTF-8")),
        (false, Some(at)) => {
            return Err(refused(
                line_at(&bytes, at),
                "a byte of value 0: UTF-16 or binary; save the table as UTF-8, without it",
            ));
        }
        (false, None) => {}
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
            "lines end in CR without LF; save the table with LF or CRLF",
        ));
    }
    Ok(text)
}

/// Line, from 1, of the byte at `offset`.
fn line_at(text: &[u8], offset: usize) -> u64 {
    1 + text[..offset].iter().filter(|byte| **byte == b'\n').count() as u64
}

/// Number of cells in the first row of `text`; 1 if the row cannot be parsed.
fn cells_of_first_row(text: &str, delimiter: u8) -> usize {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .has_headers(false)
        .from_reader(text.as_bytes());
    let mut record = csv::StringRecord::new();
    // An unreadable row is reported when the whole text is read.
    match reader.read_record(&mut record) {
        Ok(true) => record.len(),
        _ => 1,
    }
}

/// Most frequent separator in the header; a comma if the header contains no separator.
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
