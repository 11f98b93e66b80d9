//! Tables without quotes: cut at line ends into parts, each split on its own core.

use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::Path;

use super::{CsvTable, line_at};
use crate::error::{DatasetError, Place};
use crate::parallel::each_part;

/// Text below this is not worth a second thread.
const LEAST_PART: usize = 1 << 16;

/// Some rows of a table: where each cell begins in the text, and where the row ends.
#[derive(Debug)]
pub(super) struct Block {
    /// Which rows of the table these are.
    pub(super) rows: Range<usize>,
    pub(super) columns: usize,
    /// For each row the start of each cell, then one past the end of the last.
    pub(super) bounds: Vec<u32>,
}

impl Block {
    /// Where the cell of a row of the table lies; one byte separates it from the next.
    pub(super) fn cell(&self, row: usize, column: usize) -> Range<usize> {
        let first = (row - self.rows.start) * (self.columns + 1) + column;
        self.bounds[first] as usize..self.bounds[first + 1] as usize - 1
    }
}

/// A row with more or fewer cells than the header.
struct Ragged {
    offset: usize,
    found: usize,
}

pub(super) fn read(
    path: &Path,
    text: String,
    delimiter: u8,
    jobs: NonZeroUsize,
) -> Result<CsvTable, DatasetError> {
    let header = text.lines().next().unwrap_or("");
    let names: Vec<String> = header
        .split(char::from(delimiter))
        .map(|name| name.trim().to_owned())
        .collect();
    let body = text.find('\n').map_or(text.len(), |end| end + 1);
    let columns = names.len();
    let bytes = text.as_bytes();
    let parts = line_parts(bytes, body, jobs);
    let mut blocks = Vec::with_capacity(parts.len());
    let mut rows = 0;
    for outcome in each_part(parts, |part| split_part(bytes, part, delimiter, columns)) {
        let bounds = outcome.map_err(|ragged| DatasetError::Table {
            place: Place::line(path, line_at(bytes, ragged.offset)),
            problem: format!(
                "{} cells, expected {columns} as in the header",
                ragged.found
            ),
        })?;
        let first = rows;
        rows += bounds.len() / (columns + 1);
        blocks.push(Block {
            rows: first..rows,
            columns,
            bounds,
        });
    }
    Ok(CsvTable {
        path: path.to_owned(),
        names,
        text,
        blocks,
        rows,
        lines: None,
        counted: std::sync::OnceLock::new(),
        added_lines: 0,
        left_out_lines: 0,
    })
}

/// The text from `start` in about `jobs` parts, each of whole lines.
fn line_parts(text: &[u8], start: usize, jobs: NonZeroUsize) -> Vec<Range<usize>> {
    let size = (text.len() - start).div_ceil(jobs.get()).max(LEAST_PART);
    let mut parts = Vec::new();
    let mut from = start;
    while from < text.len() {
        let wanted = (from + size).min(text.len());
        let to = text[wanted..]
            .iter()
            .position(|byte| *byte == b'\n')
            .map_or(text.len(), |end| wanted + end + 1);
        parts.push(from..to);
        from = to;
    }
    parts
}

fn split_part(
    text: &[u8],
    part: Range<usize>,
    delimiter: u8,
    columns: usize,
) -> Result<Vec<u32>, Ragged> {
    let mut rows = RowSplitter {
        text,
        columns,
        bounds: Vec::with_capacity(part.len() / 8),
        row: 0,
        line: part.start,
    };
    rows.begin(part.start);
    let bytes = &text[part.clone()];
    let words = bytes.chunks_exact(8);
    let tail = words.remainder();
    let mut offset = part.start;
    for word in words {
        let word = u64::from_le_bytes(word.try_into().expect("chunks of eight bytes"));
        let mut found = bytes_equal(word, delimiter) | bytes_equal(word, b'\n');
        while found != 0 {
            let at = offset + found.trailing_zeros() as usize / 8;
            rows.separator(at)?;
            found &= found - 1;
        }
        offset += 8;
    }
    for (position, byte) in tail.iter().enumerate() {
        if *byte == delimiter || *byte == b'\n' {
            rows.separator(offset + position)?;
        }
    }
    if rows.line < part.end {
        rows.end(part.end)?;
    } else {
        rows.bounds.pop();
    }
    Ok(rows.bounds)
}

/// The high bit of each byte of `word` that is `byte` (exact: no carry runs from one byte into the next).
fn bytes_equal(word: u64, byte: u8) -> u64 {
    const LOW_BITS: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    let difference = word ^ (u64::from(byte) * 0x0101_0101_0101_0101);
    !(((difference & LOW_BITS) + LOW_BITS) | difference | LOW_BITS)
}

struct RowSplitter<'a> {
    text: &'a [u8],
    columns: usize,
    bounds: Vec<u32>,
    /// Where the bounds of the current row begin.
    row: usize,
    /// Where the current line begins in the text.
    line: usize,
}

impl RowSplitter<'_> {
    fn begin(&mut self, line: usize) {
        self.line = line;
        self.row = self.bounds.len();
        self.bounds.push(bound(line));
    }

    fn separator(&mut self, at: usize) -> Result<(), Ragged> {
        if self.text[at] != b'\n' {
            self.bounds.push(bound(at + 1));
            return Ok(());
        }
        self.end(at)?;
        self.begin(at + 1);
        Ok(())
    }

    /// Ends the row whose line ends before `at`; a blank line is no row.
    fn end(&mut self, at: usize) -> Result<(), Ragged> {
        let has_return = at > self.line && self.text[at - 1] == b'\r';
        let end = at - usize::from(has_return);
        if end == self.line {
            self.bounds.truncate(self.row);
            return Ok(());
        }
        let found = self.bounds.len() - self.row;
        if found != self.columns {
            return Err(Ragged {
                offset: self.line,
                found,
            });
        }
        self.bounds.push(bound(end + 1));
        Ok(())
    }
}

fn bound(offset: usize) -> u32 {
    u32::try_from(offset).expect("the text is shorter than 2^32 - 1 bytes")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_bytes_are_found_wherever_they_stand() {
        for byte in [b',', b'\n', 0, 0x80, 0xff] {
            for pattern in 0..=255_u8 {
                let bytes: [u8; 8] = std::array::from_fn(|position| {
                    if pattern >> position & 1 == 1 {
                        byte
                    } else {
                        byte ^ 1
                    }
                });
                let mask = bytes_equal(u64::from_le_bytes(bytes), byte);
                let expected = (0..8).fold(0_u64, |mask, position| {
                    mask | u64::from(pattern >> position & 1) << (8 * position + 7)
                });
                assert_eq!(mask, expected);
            }
        }
    }

    #[test]
    fn parts_are_whole_lines_that_join_to_the_text() {
        let text = "a,b\n".repeat(100_000);
        let jobs = NonZeroUsize::new(3).expect("three");
        let parts = line_parts(text.as_bytes(), 4, jobs);
        assert_eq!(parts.len(), 3);
        assert_eq!((parts[0].start, parts[2].end), (4, text.len()));
        for pair in parts.windows(2) {
            assert_eq!(pair[0].end, pair[1].start);
            assert_eq!(text.as_bytes()[pair[0].end - 1], b'\n');
        }
    }
}
