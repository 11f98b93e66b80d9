//! CSV file read once, block by block: each block is digested, split and parsed while it is in the cache of a core.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::OnceLock;

use super::cells::RowSplitter;
use super::parts::{begin_of, header_line_of};
use super::split::Block;
use super::{CsvTable, delimiter_of, line_at};
use crate::error::ImportError;
use taceva_dataset::internal::{PartsDigest, open_regular};
use taceva_dataset::{Digest, Place};

/// Number of bytes per read.
const AHEAD: usize = 1 << 16;

/// Maximum size of a block of rows, bytes. A larger block is an error.
const MOST_BYTES: usize = 1 << 28;

/// Number of leading bytes that are searched for zero bytes, as in [`CsvTable::read`].
const BEGINNING: usize = 4_096;

/// A CSV file without quoted cells, of any length, read from its beginning to its end.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("truth.csv");
/// std::fs::write(&path, "id,Fz\na,0.5\nb,\nc,2\n")?;
/// let mut stream = taceva_import::CsvStream::open(&path)?;
/// let mut block = stream.block();
/// stream.read(2, &mut block)?;
/// assert_eq!(block.text("id")?, ["a", "b"]);
/// stream.read(2, &mut block)?;
/// assert_eq!(block.text("id")?, ["c"]);
/// stream.read(2, &mut block)?;
/// assert_eq!(block.rows(), 0);
/// assert_eq!(stream.digest(), taceva_import::CsvTable::read(&path)?.digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CsvStream {
    /// Table with the columns of the file and without rows.
    header: CsvTable,
    delimiter: u8,
    file: File,
    digest: PartsDigest,
    /// Bytes that were read beyond the last block.
    ahead: Vec<u8>,
    /// Number of lines of the file before `ahead`.
    lines: u64,
}

impl CsvStream {
    /// Opens the file at `path` and reads its header.
    ///
    /// # Errors
    /// [`ImportError::Table`] if the header is missing or has a quoted cell, or the file does not begin with text; [`ImportError::Dataset`] if the file is not
    /// regular or cannot be read.
    pub fn open(path: &Path) -> Result<CsvStream, ImportError> {
        let (mut file, _) = open_regular(path, u64::MAX)?;
        begin_of(&mut file).map_err(ImportError::io("read", path))?;
        let mut digest = PartsDigest::default();
        let mut ahead = Vec::with_capacity(2 * AHEAD);
        while !ahead.contains(&b'\n') && fill(path, &mut file, &mut digest, &mut ahead)? {}
        if let Some(at) = ahead.iter().take(BEGINNING).position(|byte| *byte == 0) {
            let problem = "a byte of value 0: UTF-16 or binary; save the table as UTF-8";
            return Err(wrong(path, line_at(&ahead, at), problem.to_owned()));
        }
        let end = ahead.iter().position(|byte| *byte == b'\n');
        let end = end.map_or(ahead.len(), |end| end + 1);
        let header = CsvTable::of_bytes(path, header_line_of(ahead[..end].to_vec()))?;
        let line = String::from_utf8_lossy(&ahead[..end]);
        let delimiter = delimiter_of(line.lines().next().unwrap_or(""));
        ahead.drain(..end);
        Ok(CsvStream {
            header,
            delimiter,
            file,
            digest,
            ahead,
            lines: 1,
        })
    }

    /// Table with the columns of the file and without rows.
    pub fn header(&self) -> &CsvTable {
        &self.header
    }

    /// Empty table, which [`read`](CsvStream::read) fills with the rows of a block.
    pub fn block(&self) -> CsvTable {
        CsvTable {
            path: self.header.path.clone(),
            names: self.header.names.clone(),
            text: String::new(),
            blocks: Vec::new(),
            rows: 0,
            lines: None,
            counted: OnceLock::new(),
            added_lines: 0,
            left_out_lines: 0,
        }
    }

    /// Replaces the rows of `block` with the next `rows` rows: fewer at the end of the file, then none. The memory of `block` is reused.
    ///
    /// # Errors
    /// Errors of [`CsvTable::read`]; also [`ImportError::Table`] for a quoted cell, whose end needs the whole file. After an error the stream cannot be read.
    pub fn read(&mut self, rows: usize, block: &mut CsvTable) -> Result<(), ImportError> {
        let CsvTable { path, names, .. } = &self.header;
        let mut text = std::mem::take(&mut block.text).into_bytes();
        text.clear();
        text.append(&mut self.ahead);
        let bounds = block.blocks.pop().map(|block| block.bounds);
        let (columns, bounds) = (names.len(), bounds.unwrap_or_default());
        let mut splitter = RowSplitter::new(self.delimiter, columns, rows, bounds, 0);
        let mut seen = 0;
        let end = loop {
            let found = splitter.split(&text, seen..text.len());
            seen = text.len();
            let end = match found {
                Ok(None) if fill(path, &mut self.file, &mut self.digest, &mut text)? => continue,
                Ok(None) => splitter.finish(&text, seen).map(|()| seen),
                Ok(Some(end)) => Ok(end),
                Err(ragged) => Err(ragged),
            };
            break end.map_err(|ragged| {
                let line = self.lines + line_at(&text, ragged.offset);
                wrong(path, line, ragged.problem(names.len()))
            })?;
        };
        self.ahead.extend_from_slice(&text[end..]);
        text.truncate(end);
        block.text = String::from_utf8(text).map_err(|error| {
            let at = line_at(error.as_bytes(), error.utf8_error().valid_up_to());
            let problem = "not UTF-8; save the table as UTF-8".to_owned();
            wrong(path, self.lines + at, problem)
        })?;
        block.rows = splitter.rows();
        block.counted = OnceLock::new();
        block.left_out_lines = self.lines;
        self.lines += splitter.lines();
        block.blocks.clear();
        block.blocks.push(Block {
            rows: 0..block.rows,
            columns: names.len(),
            bounds: splitter.into_bounds(),
        });
        Ok(())
    }

    /// Digest of the whole file, equal to [`CsvTable::digest`]. Valid after the last block is read.
    pub fn digest(&self) -> Digest {
        self.digest.clone().finish()
    }
}

/// Appends the next bytes of the file to `bytes` and to the digest. Returns false at the end of the file.
fn fill(
    path: &Path,
    file: &mut File,
    digest: &mut PartsDigest,
    bytes: &mut Vec<u8>,
) -> Result<bool, ImportError> {
    let had = bytes.len();
    if had > MOST_BYTES {
        let problem = format!("rows of {had} bytes or more, expected at most {MOST_BYTES}");
        return Err(wrong(path, 1, problem));
    }
    let read = file.take(AHEAD as u64).read_to_end(bytes);
    let read = read.map_err(ImportError::io("read", path))?;
    let new = &bytes[had..];
    // Compares every byte without a branch, so that the loop vectorises.
    let quotes = new
        .iter()
        .fold(0, |any, byte| any | u8::from(*byte == b'"'));
    if quotes != 0 {
        let problem = "a quoted cell, expected none in a table that is read in parts".to_owned();
        return Err(wrong(path, 1, problem));
    }
    digest.fixed(new);
    Ok(read > 0)
}

fn wrong(path: &Path, line: u64, problem: String) -> ImportError {
    ImportError::table(Place::line(path, line), problem)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares the table read in blocks of `rows` rows with the table read at once.
    fn is_as_the_whole(path: &Path, rows: usize) {
        let whole = CsvTable::read(path).expect("a table");
        let mut stream = CsvStream::open(path).expect("plain");
        assert_eq!(stream.header().names(), whole.names());
        let mut block = stream.block();
        let mut first = 0;
        loop {
            stream.read(rows, &mut block).expect("plain");
            if block.rows() == 0 {
                break;
            }
            for row in 0..block.rows() {
                for column in 0..whole.names().len() {
                    let expected = whole.cell(first + row, column);
                    assert_eq!(block.cell(row, column), expected);
                    assert_eq!(block.place(row, column), whole.place(first + row, column));
                }
            }
            assert!(block.rows() == rows || first + block.rows() == whole.rows());
            first += block.rows();
        }
        assert_eq!(first, whole.rows());
        assert_eq!(stream.digest(), whole.digest());
    }

    #[test]
    fn blocks_of_any_size_have_the_rows_the_lines_and_the_digest_of_the_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        let rows = |count: u32| {
            let row = |row: u32| format!("p{},{}.25,µ\n", row / 4, row % 90);
            (0..count).map(row).collect::<String>()
        };
        for body in [
            rows(3),
            rows(20_000),
            rows(40).replace("\np3", "\n\n\np3"),
            rows(40).trim_end().to_owned(),
            rows(40).replace('\n', "\r\n"),
            rows(40) + "\n\n",
        ] {
            for mark in ["", "\u{feff}"] {
                let text = format!("{mark}point_id,Fz,note\n{body}");
                std::fs::write(&path, text).expect("written");
                for size in [1, 7, 4_096] {
                    is_as_the_whole(&path, size);
                }
            }
        }
    }

    #[test]
    fn a_table_without_a_row_has_its_columns_and_its_digest() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        for text in ["a;b", "a;b\r\n", "a;b\n\n"] {
            std::fs::write(&path, text).expect("written");
            is_as_the_whole(&path, 5);
        }
    }

    #[test]
    fn what_cannot_be_read_row_by_row_is_refused_by_its_line() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        let good = "1,2\n".repeat(50_000);
        for (text, word) in [
            (format!("a,b\n{good}1\n"), "line 50002: 1 cell, expected 2"),
            (format!("a,b\n{good}1,2,3"), "line 50002: 3 cells"),
            (format!("a,b\n{good}\"1\",2"), "a quoted cell"),
            ("\"a\",b\n".to_owned(), "a quoted cell"),
            ("a,b,a\n1,2,3\n".to_owned(), "the column `a` occurs twice"),
            ("a,b\n1,\0\n".to_owned(), "line 2: a byte of value 0"),
            (String::new(), "expected a header"),
        ] {
            std::fs::write(&path, text).expect("written");
            let error = first_error(&path);
            assert!(error.contains(word), "{error}");
        }
        let bytes = [b"a,b\n", good.as_bytes(), b"\xff,1\n"].concat();
        std::fs::write(&path, bytes).expect("written");
        let error = first_error(&path);
        assert!(error.contains("line 50002: not UTF-8"), "{error}");
        assert!(CsvStream::open(folder.path()).is_err(), "a folder");
    }

    fn first_error(path: &Path) -> String {
        let mut stream = match CsvStream::open(path) {
            Ok(stream) => stream,
            Err(error) => return error.to_string(),
        };
        let mut block = stream.block();
        loop {
            match stream.read(4_096, &mut block) {
                Ok(()) => assert_ne!(block.rows(), 0, "no error"),
                Err(error) => return error.to_string(),
            }
        }
    }
}
