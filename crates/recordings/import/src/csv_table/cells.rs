//! Finds cell bounds in text without quoted cells: each line is a row.

use std::ops::Range;

/// A row with more or fewer cells than the header.
#[derive(Debug)]
pub(super) struct Ragged {
    /// Offset of the row in the text, bytes.
    pub(super) offset: usize,
    pub(super) found: usize,
}

impl Ragged {
    pub(super) fn problem(&self, columns: usize) -> String {
        format!(
            "{}, expected {columns} as in the header",
            taceva_core::counted(self.found, "cell")
        )
    }
}

/// Finds the cells of rows in a text that may still grow.
pub(super) struct RowSplitter {
    delimiter: u8,
    columns: usize,
    /// Maximum number of rows to find.
    most: usize,
    rows: usize,
    /// Number of line ends found, including blank lines.
    lines: u64,
    /// For each row, the start of each cell, then the position after the end of the last cell, bytes.
    bounds: Vec<u32>,
    /// Index in `bounds` of the first bound of the current row.
    row: usize,
    /// Offset of the current line in the text, bytes.
    line: usize,
}

impl RowSplitter {
    /// Starts a search for up to `most` rows from `start`. Clears `bounds`, which receives the cell bounds.
    pub(super) fn new(
        delimiter: u8,
        columns: usize,
        most: usize,
        mut bounds: Vec<u32>,
        start: usize,
    ) -> RowSplitter {
        bounds.clear();
        let mut splitter = RowSplitter {
            delimiter,
            columns,
            most,
            rows: 0,
            lines: 0,
            bounds,
            row: 0,
            line: start,
        };
        splitter.begin(start);
        splitter
    }

    /// Continues with `part` of the text, which begins at the end of the previous part. Returns the end of the last requested row, or `None` if the part ends
    /// before it.
    pub(super) fn split(
        &mut self,
        text: &[u8],
        part: Range<usize>,
    ) -> Result<Option<usize>, Ragged> {
        let bytes = &text[part.clone()];
        let words = bytes.chunks_exact(8);
        let tail = words.remainder();
        let mut offset = part.start;
        for word in words {
            let word = u64::from_le_bytes(word.try_into().expect("chunks of eight bytes"));
            let ends = bytes_equal(word, b'\n');
            let mut found = bytes_equal(word, self.delimiter) | ends;
            while found != 0 {
                let at = offset + found.trailing_zeros() as usize / 8;
                let is_end = ends & found & found.wrapping_neg() != 0;
                if self.separator(text, at, is_end)? {
                    return Ok(Some(at + 1));
                }
                found &= found - 1;
            }
            offset += 8;
        }
        for (position, byte) in tail.iter().enumerate() {
            let is_end = *byte == b'\n';
            let at = offset + position;
            if (is_end || *byte == self.delimiter) && self.separator(text, at, is_end)? {
                return Ok(Some(at + 1));
            }
        }
        Ok(None)
    }

    /// Ends the last row of the text at `end`, if no line end precedes `end`.
    pub(super) fn finish(&mut self, text: &[u8], end: usize) -> Result<(), Ragged> {
        if self.line < end {
            self.end(text, end)
        } else {
            self.bounds.truncate(self.row);
            Ok(())
        }
    }

    /// Number of rows found.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// Number of line ends found, including blank lines.
    pub(super) fn lines(&self) -> u64 {
        self.lines
    }

    pub(super) fn into_bounds(self) -> Vec<u32> {
        self.bounds
    }

    fn begin(&mut self, line: usize) {
        self.line = line;
        self.row = self.bounds.len();
        self.bounds.push(bound(line));
    }

    /// Handles the delimiter or line end at byte `at`. Returns true at the end of the last requested row.
    fn separator(&mut self, text: &[u8], at: usize, is_end: bool) -> Result<bool, Ragged> {
        if !is_end {
            self.bounds.push(bound(at + 1));
            return Ok(false);
        }
        self.lines += 1;
        self.end(text, at)?;
        if self.rows == self.most {
            return Ok(true);
        }
        self.begin(at + 1);
        Ok(false)
    }

    /// Ends the row of the line that ends before `at`. Blank lines are skipped.
    fn end(&mut self, text: &[u8], at: usize) -> Result<(), Ragged> {
        let has_return = at > self.line && text[at - 1] == b'\r';
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
        self.rows += 1;
        Ok(())
    }
}

fn bound(offset: usize) -> u32 {
    u32::try_from(offset).expect("the text is shorter than 2^32 - 1 bytes")
}

/// Sets the high bit of each byte of `word` that equals `byte`. Exact, because no carry crosses a byte boundary.
fn bytes_equal(word: u64, byte: u8) -> u64 {
    const LOW_BITS: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    let difference = word ^ (u64::from(byte) * 0x0101_0101_0101_0101);
    !(((difference & LOW_BITS) + LOW_BITS) | difference | LOW_BITS)
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
    fn rows_of_a_text_that_grows_are_those_of_the_whole_and_no_more_than_are_looked_for() {
        let text = b"1,22,333\r\n\n4,,5\n\r\n66666,7,8\n9,9,9";
        let whole = |most: usize| {
            let mut rows = RowSplitter::new(b',', 3, most, vec![7; 3], 0);
            let end = rows.split(text, 0..text.len()).expect("even");
            if end.is_none() {
                rows.finish(text, text.len()).expect("even");
            }
            (end, rows.rows(), rows.lines(), rows.into_bounds())
        };
        assert_eq!((whole(2).0, whole(2).1, whole(2).2), (Some(16), 2, 3));
        assert_eq!((whole(9).0, whole(9).1, whole(9).2), (None, 4, 5));
        assert_eq!(whole(9).3[..4], [0, 2, 5, 9]);
        for most in 1..=5 {
            for cut in 0..=text.len() {
                let mut rows = RowSplitter::new(b',', 3, most, Vec::new(), 0);
                let mut end = rows.split(text, 0..cut).expect("even");
                if end.is_none() {
                    end = rows.split(text, cut..text.len()).expect("even");
                }
                if end.is_none() {
                    rows.finish(text, text.len()).expect("even");
                }
                let found = (end, rows.rows(), rows.lines(), rows.into_bounds());
                assert_eq!(found, whole(most), "{most} rows, cut at {cut}");
            }
        }
    }
}
