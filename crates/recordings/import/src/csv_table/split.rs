//! Splits the text of tables without quotes into cells, in parallel parts of whole lines.

use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::Path;

use super::cells::{Ragged, RowSplitter};
use super::{CsvTable, line_at};
use crate::error::{ImportError, Place};
use taceva_dataset::internal::each_part;

/// Minimum length of the text of a thread, bytes.
const LEAST_PART: usize = 1 << 16;

/// Range of rows with the bounds of each cell in the text.
#[derive(Debug)]
pub(super) struct Block {
    /// Row numbers in the table.
    pub(super) rows: Range<usize>,
    pub(super) columns: usize,
    /// For each row, the start of each cell, then the position after the end of the last cell, bytes.
    pub(super) bounds: Vec<u32>,
}

impl Block {
    /// Text range of a cell. One byte separates the cell from the next.
    pub(super) fn cell(&self, row: usize, column: usize) -> Range<usize> {
        let first = (row - self.rows.start) * (self.columns + 1) + column;
        self.bounds[first] as usize..self.bounds[first + 1] as usize - 1
    }
}

pub(super) fn read(
    path: &Path,
    text: String,
    delimiter: u8,
    jobs: NonZeroUsize,
) -> Result<CsvTable, ImportError> {
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
        let bounds = outcome.map_err(|ragged| {
            ImportError::table(
                Place::line(path, line_at(bytes, ragged.offset)),
                ragged.problem(columns),
            )
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

/// Divides the text from `start` into about `jobs` parts of whole lines.
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
    let bounds = Vec::with_capacity(part.len() / 8);
    let mut rows = RowSplitter::new(delimiter, columns, usize::MAX, bounds, part.start);
    rows.split(text, part.clone())?;
    rows.finish(text, part.end)?;
    Ok(rows.into_bounds())
}

#[cfg(test)]
mod tests {
    use super::*;

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
