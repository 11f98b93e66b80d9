//! Finds the offsets of the rows of a CSV file in one pass over its bytes, without storing the bytes.

use std::io::{self, Read};

use serde::{Deserialize, Serialize};

use super::parts::PART_ROWS;

/// Start of a part of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Mark {
    /// Offset in the file, bytes.
    pub(super) byte: u64,
    /// Line of the file, from 1.
    pub(super) line: u64,
}

/// Result of a scan of a CSV file.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    /// End of the header, bytes.
    pub(super) header_end: u64,
    /// Start of each part.
    pub(super) marks: Vec<Mark>,
    pub(super) rows: u64,
    /// Number of quotes in the file.
    pub(super) quotes: u64,
    /// End of the file, bytes.
    pub(super) end: u64,
}

impl Found {
    pub(super) fn row(&mut self, mark: Mark) {
        if self.rows.is_multiple_of(PART_ROWS) {
            self.marks.push(mark);
        }
        self.rows += 1;
    }
}

/// Reader that returns the bytes of `inner` unchanged and finds rows as `split.rs` does. Each line is a row, the first is the header, and blank lines are
/// skipped.
pub(super) struct LineScan<R> {
    inner: R,
    found: Found,
    line: u64,
    /// Offset of the current line, bytes.
    start: u64,
    /// Last byte read.
    last: u8,
}

impl<R: Read> LineScan<R> {
    /// Scan of `inner`, which begins at byte `begin` of the file.
    pub(super) fn new(inner: R, begin: u64) -> LineScan<R> {
        LineScan {
            inner,
            found: Found {
                end: begin,
                ..Found::default()
            },
            line: 1,
            start: begin,
            last: b'\n',
        }
    }

    /// Returns the result, once all bytes are read.
    pub(super) fn finish(mut self) -> Found {
        if self.found.end > self.start || self.line == 1 {
            self.end_line(self.found.end, self.last);
        }
        self.found.header_end = self.found.header_end.min(self.found.end);
        self.found
    }

    fn take(&mut self, bytes: &[u8]) {
        let begin = self.found.end;
        self.found.quotes += bytes.iter().filter(|byte| **byte == b'"').count() as u64;
        let mut from = 0;
        while let Some(length) = bytes[from..].iter().position(|byte| *byte == b'\n') {
            let at = from + length;
            let before = match at {
                0 => self.last,
                at => bytes[at - 1],
            };
            self.end_line(begin + at as u64, before);
            from = at + 1;
            self.start = begin + from as u64;
        }
        self.last = bytes.last().copied().unwrap_or(self.last);
        self.found.end += bytes.len() as u64;
    }

    /// Ends the line before `end`. `before` is the byte that precedes `end`.
    fn end_line(&mut self, end: u64, before: u8) {
        let length = end - self.start;
        let is_blank = length == 0 || (length == 1 && before == b'\r');
        if self.line == 1 {
            self.found.header_end = end + 1;
        } else if !is_blank {
            self.found.row(Mark {
                byte: self.start,
                line: self.line,
            });
        }
        self.line += 1;
    }
}

impl<R: Read> Read for LineScan<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(into)?;
        self.take(&into[..count]);
        Ok(count)
    }
}

/// Reader of a quoted table. Returns its cells as `quotation.rs` stores them, each with a line end, and finds the start of each part.
pub(super) struct QuotedScan<R> {
    reader: csv::Reader<R>,
    record: csv::ByteRecord,
    found: Found,
    begin: u64,
    has_header: bool,
    pending: Vec<u8>,
    at: usize,
}

impl<R: Read> QuotedScan<R> {
    /// Scan of `inner`, which begins at byte `begin` of the file.
    pub(super) fn new(inner: R, begin: u64, delimiter: u8) -> QuotedScan<R> {
        QuotedScan {
            reader: csv::ReaderBuilder::new()
                .delimiter(delimiter)
                .has_headers(false)
                .flexible(true)
                .from_reader(inner),
            record: csv::ByteRecord::new(),
            found: Found::default(),
            begin,
            has_header: false,
            pending: Vec::new(),
            at: 0,
        }
    }

    /// Returns the result, once all bytes are read.
    pub(super) fn finish(mut self) -> Found {
        self.found.end = self.begin + self.reader.position().byte();
        self.found
    }
}

impl<R: Read> Read for QuotedScan<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        while self.at == self.pending.len() {
            self.pending.clear();
            self.at = 0;
            if !self
                .reader
                .read_byte_record(&mut self.record)
                .map_err(io::Error::other)?
            {
                return Ok(0);
            }
            if !self.has_header {
                self.has_header = true;
                self.found.header_end = self.begin + self.reader.position().byte();
                continue;
            }
            let place = self.record.position();
            self.found.row(Mark {
                byte: self.begin + place.map_or(0, csv::Position::byte),
                line: place.map_or(1, csv::Position::line),
            });
            for cell in &self.record {
                self.pending.extend(cell);
                self.pending.push(b'\n');
            }
        }
        let count = into.len().min(self.pending.len() - self.at);
        into[..count].copy_from_slice(&self.pending[self.at..self.at + count]);
        self.at += count;
        Ok(count)
    }
}
