//! CSV file read in parts, for tables larger than memory or shared by several machines.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::scan::{Found, LineScan, Mark, QuotedScan};
use super::{CsvTable, as_text, delimiter_of};
use crate::error::ImportError;
use taceva_dataset::Digest;
use taceva_dataset::internal::{limits, open_regular};

/// Number of rows of a part; the last part may have fewer.
pub(super) const PART_ROWS: u64 = 1 << 16;

/// Size of the read-ahead buffer of the scan, bytes.
const AHEAD: usize = 1 << 18;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// CSV file of any length, read in parts. Stores the offset of each part and the digest of the text.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("truth.csv");
/// std::fs::write(&path, "id,Fz\na,0.5\nb,\n")?;
/// let parts = taceva_import::CsvParts::scan(&path)?;
/// assert_eq!((parts.rows(), parts.count(), parts.rows_of(0)), (2, 1, 0..2));
/// assert_eq!(parts.read(0)?.text("id")?, ["a", "b"]);
/// assert_eq!(parts.digest(), taceva_import::CsvTable::read(&path)?.digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CsvParts {
    path: PathBuf,
    /// Byte range of the header in the file.
    header: [u64; 2],
    marks: Vec<Mark>,
    end: u64,
    rows: u64,
    digest: Digest,
}

impl CsvParts {
    /// Number of rows of a part; the last part may have fewer.
    pub const ROWS: u64 = PART_ROWS;

    /// Scans the file at `path` once, or twice if cells are quoted. The file may have any length.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] if the file is not regular or cannot be read; [`ImportError::Table`] if a quote is not closed.
    pub fn scan(path: &Path) -> Result<CsvParts, ImportError> {
        let (mut file, _) = open_regular(path, u64::MAX)?;
        let failed = |source| ImportError::io("read", path)(source);
        let begin = begin_of(&mut file).map_err(failed)?;
        let mut scan = LineScan::new(&mut file, begin);
        let digest = Digest::of_reader(&mut scan).map_err(failed)?;
        let found = scan.finish();
        if found.quotes % 2 == 1 {
            return Err(ImportError::table(
                path,
                "a quotation mark is never closed".to_owned(),
            ));
        }
        let (found, digest) = match found.quotes {
            0 => (found, digest),
            _ => quoted(path, file, begin).map_err(failed)?,
        };
        Ok(CsvParts {
            path: path.to_owned(),
            header: [begin, found.header_end],
            marks: found.marks,
            end: found.end,
            rows: found.rows,
            digest,
        })
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of rows, without the header.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Digest of the whole file, equal to [`CsvTable::digest`].
    pub fn digest(&self) -> Digest {
        self.digest
    }

    /// Number of parts.
    pub fn count(&self) -> usize {
        self.marks.len()
    }

    /// Row range of a part, from 0.
    pub fn rows_of(&self, part: usize) -> Range<u64> {
        let begin = part as u64 * PART_ROWS;
        begin.min(self.rows)..(begin + PART_ROWS).min(self.rows)
    }

    /// Table with the columns of the file and without rows.
    ///
    /// # Errors
    /// Errors of [`CsvTable::read`].
    pub fn header(&self) -> Result<CsvTable, ImportError> {
        let (mut file, _) = open_regular(&self.path, u64::MAX)?;
        let bytes = self.header_line(&mut file)?;
        CsvTable::of_bytes(&self.path, bytes)
    }

    /// Header line with the line end `\n`.
    fn header_line(&self, file: &mut File) -> Result<Vec<u8>, ImportError> {
        let bytes = self.bytes(file, self.header[0]..self.header[1])?;
        Ok(header_line_of(bytes))
    }

    /// Reads the rows of a part as a table. Errors name lines of the file.
    ///
    /// # Errors
    /// Errors of [`CsvTable::read`]; also [`ImportError::Table`] if the rows have changed since the scan.
    pub fn read(&self, part: usize) -> Result<CsvTable, ImportError> {
        let Some(mark) = self.marks.get(part) else {
            return self.header();
        };
        let end = self.marks.get(part + 1).map_or(self.end, |next| next.byte);
        let (mut file, _) = open_regular(&self.path, u64::MAX)?;
        let mut bytes = self.header_line(&mut file)?;
        let lines = bytes.iter().filter(|byte| **byte == b'\n').count() as u64;
        let left_out_lines = mark.line.saturating_sub(lines + 1);
        bytes.extend(self.bytes(&mut file, mark.byte..end)?);
        let read = CsvTable::of_bytes(&self.path, bytes);
        let mut table = read.map_err(|error| error.lines_below(left_out_lines))?;
        table.left_out_lines = left_out_lines;
        let expected = self.rows_of(part).end - self.rows_of(part).start;
        if table.rows() as u64 != expected {
            let problem = format!(
                "{} rows from line {} on, but {expected} were counted before: the file has changed, or its lines end in CR without LF",
                table.rows(),
                mark.line
            );
            return Err(ImportError::table(&self.path, problem));
        }
        Ok(table)
    }

    /// Bytes of the file in the range `bytes`; fewer at the end of the file.
    fn bytes(&self, file: &mut File, bytes: Range<u64>) -> Result<Vec<u8>, ImportError> {
        let length = bytes.end.saturating_sub(bytes.start);
        if length > limits::TABLE_BYTES {
            let problem = format!(
                "{length} bytes of {PART_ROWS} rows, expected at most {}",
                limits::TABLE_BYTES
            );
            return Err(ImportError::table(&self.path, problem));
        }
        let mut read = Vec::new();
        file.seek(SeekFrom::Start(bytes.start))
            .and_then(|_| file.take(length).read_to_end(&mut read))
            .map_err(ImportError::io("read", &self.path))?;
        Ok(read)
    }
}

impl CsvTable {
    /// Parses `bytes`, read from the file at `path`.
    pub(super) fn of_bytes(path: &Path, bytes: Vec<u8>) -> Result<CsvTable, ImportError> {
        let text = as_text(path, bytes)?;
        let delimiter = delimiter_of(text.lines().next().unwrap_or(""));
        CsvTable::of_text(path, text, delimiter, NonZeroUsize::MIN)
    }

    /// Table of the cells in `rows`, each with as many cells as there are `names`. The table has the path `path`, but its line numbers do not refer to that
    /// file.
    ///
    /// ```
    /// use taceva_import::CsvTable;
    ///
    /// let rows = [["a", "0.5"], ["b,c", ""]];
    /// let table = CsvTable::of_cells("truth.parquet".as_ref(), &["id", "Fz"], rows)?;
    /// assert_eq!(table.text("id")?, ["a", "b,c"]);
    /// assert_eq!(table.numbers("Fz")?.get(0), Some(0.5));
    /// # Ok::<(), taceva_import::ImportError>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`read`](CsvTable::read).
    pub fn of_cells<'c, R: IntoIterator<Item = &'c str>>(
        path: &Path,
        names: &[&str],
        rows: impl IntoIterator<Item = R>,
    ) -> Result<CsvTable, ImportError> {
        let mut text = String::new();
        push_line(&mut text, names.iter().copied());
        for row in rows {
            push_line(&mut text, row);
        }
        if text.len() as u64 > limits::TABLE_BYTES {
            let problem = format!(
                "{} bytes as text, expected at most {} at once",
                text.len(),
                limits::TABLE_BYTES
            );
            return Err(ImportError::table(path, problem));
        }
        CsvTable::of_text(path, text, b',', NonZeroUsize::MIN)
    }
}

/// Adds a line of cells, quoted if necessary. A single empty cell is quoted, because a blank line is not a row.
fn push_line<'c>(text: &mut String, cells: impl IntoIterator<Item = &'c str>) {
    let start = text.len();
    for (at, cell) in cells.into_iter().enumerate() {
        if at > 0 {
            text.push(',');
        }
        match cell.contains([',', '"', '\n', '\r']) {
            true => {
                text.push('"');
                text.push_str(&cell.replace('"', "\"\""));
                text.push('"');
            }
            false => text.push_str(cell),
        }
    }
    if text.len() == start {
        text.push_str("\"\"");
    }
    text.push('\n');
}

/// Scans a table that has quoted cells.
fn quoted(path: &Path, mut file: File, begin: u64) -> std::io::Result<(Found, Digest)> {
    file.seek(SeekFrom::Start(begin))?;
    let mut first = String::new();
    // Invalid UTF-8 is reported when the part is read.
    let mut reader = BufReader::with_capacity(AHEAD, File::open(path)?);
    reader.seek(SeekFrom::Start(begin))?;
    let mut line = Vec::new();
    reader.read_until(b'\n', &mut line)?;
    first.push_str(&String::from_utf8_lossy(&line));
    let delimiter = delimiter_of(first.lines().next().unwrap_or(""));
    let mut scan = QuotedScan::new(BufReader::with_capacity(AHEAD, file), begin, delimiter);
    let digest = Digest::of_reader(&mut scan)?;
    Ok((scan.finish(), digest))
}

/// Header line with the line end `\n`.
pub(super) fn header_line_of(mut bytes: Vec<u8>) -> Vec<u8> {
    while matches!(bytes.last(), Some(b'\r' | b'\n')) {
        bytes.pop();
    }
    bytes.push(b'\n');
    bytes
}

/// Offset of the text after the byte order mark, if any.
pub(super) fn begin_of(file: &mut File) -> std::io::Result<u64> {
    let mut start = Vec::new();
    file.by_ref().take(3).read_to_end(&mut start)?;
    let begin = match start == BYTE_ORDER_MARK {
        true => start.len() as u64,
        false => 0,
    };
    file.seek(SeekFrom::Start(begin))?;
    Ok(begin)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Text of a table that is longer than one part, with blank lines, and with some quoted cells if `is_quoted`.
    fn text(is_quoted: bool) -> String {
        let mut text = "id,Fz,note\n".to_owned();
        for row in 0..PART_ROWS + 77 {
            let note = match (is_quoted, row % 1000) {
                (true, 7) => "\"a, b\n\"\"c\"\"\"",
                (_, 9) => "\n",
                _ => "x",
            };
            let note = if note == "\n" { "x\n" } else { note };
            text += &format!("{row},{}.5,{note}\n", row % 90);
        }
        text
    }

    #[test]
    fn parts_have_the_rows_the_lines_and_the_digest_of_the_whole() {
        for is_quoted in [false, true] {
            for mark in ["", "\u{feff}"] {
                let folder = tempfile::tempdir().expect("a folder");
                let path = folder.path().join("table.csv");
                std::fs::write(&path, format!("{mark}{}", text(is_quoted))).expect("written");
                let whole = CsvTable::read(&path).expect("a table");
                let parts = CsvParts::scan(&path).expect("a table");
                assert_eq!(parts.rows(), whole.rows() as u64);
                assert_eq!(parts.digest(), whole.digest());
                assert_eq!(parts.count(), 2);
                assert_eq!(parts.header().expect("a header").names(), whole.names());
                for part in 0..2 {
                    let table = parts.read(part).expect("a part");
                    for (at, row) in parts.rows_of(part).enumerate() {
                        let row = usize::try_from(row).expect("small");
                        for column in 0..3 {
                            assert_eq!(table.cell(at, column), whole.cell(row, column));
                        }
                        assert_eq!(table.place(at, 0).line, whole.place(row, 0).line);
                    }
                }
            }
        }
    }

    #[test]
    fn line_ends_of_another_system_change_no_cell_of_any_part() {
        for is_quoted in [false, true] {
            let folder = tempfile::tempdir().expect("a folder");
            let path = folder.path().join("table.csv");
            std::fs::write(&path, text(is_quoted).replace('\n', "\r\n")).expect("written");
            let whole = CsvTable::read(&path).expect("a table");
            let parts = CsvParts::scan(&path).expect("a table");
            assert_eq!(parts.rows(), whole.rows() as u64);
            assert_eq!(parts.digest(), whole.digest());
            assert_eq!(parts.header().expect("a header").names(), whole.names());
            for part in 0..2 {
                let table = parts.read(part).expect("a part");
                for (at, row) in parts.rows_of(part).enumerate() {
                    let row = usize::try_from(row).expect("small");
                    for column in 0..3 {
                        assert_eq!(table.cell(at, column), whole.cell(row, column));
                    }
                }
            }
        }
    }

    #[test]
    fn a_ragged_row_of_a_later_part_is_named_by_its_line_of_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        let mut text = "a,b\n".to_owned() + &"1,2\n".repeat(70_000);
        text += "1\n";
        std::fs::write(&path, text).expect("written");
        let whole = CsvTable::read(&path).expect_err("ragged").to_string();
        let parts = CsvParts::scan(&path).expect("counted");
        let part = parts.read(1).expect_err("ragged").to_string();
        assert_eq!(part, whole);
        assert!(whole.contains("line 70002"), "{whole}");
    }

    #[test]
    fn a_file_that_changed_since_it_was_looked_through_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        std::fs::write(&path, "a\n1\n2\n3\n").expect("written");
        let parts = CsvParts::scan(&path).expect("a table");
        std::fs::write(&path, "a\n1\n\n\n3\n").expect("written");
        let error = parts.read(0).expect_err("changed").to_string();
        assert!(error.contains("3 were counted before"), "{error}");
    }

    #[test]
    fn a_quote_that_is_never_closed_is_refused_while_counting() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        std::fs::write(&path, "a\n\"1\n2\n").expect("written");
        let error = CsvParts::scan(&path).expect_err("open").to_string();
        assert!(error.contains("never closed"), "{error}");
    }
}
