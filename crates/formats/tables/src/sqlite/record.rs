//! Rows of an SQLite table: a row number, then a head with the types, then the values. A row that exceeds its page continues in overflow pages.

use std::collections::HashSet;
use std::ops::Range;

use super::page::Pages;
use super::tree::Head;
use super::{RowPlace, SqliteTable};
use crate::error::TableError;
use crate::limits;

/// Value of one column in a row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Null,
    Integer(i64),
    Real(f64),
    Text(String),
    /// Blob, as its byte range in the row.
    Blob(Range<usize>),
}

/// Row of a table. Overflow pages are read only if they contain a requested value.
pub(crate) struct Record<'p, 'd> {
    pages: &'p mut Pages<'d>,
    page: u32,
    id: Option<usize>,
    number: i64,
    /// Type and range of each value.
    values: Vec<(u64, Range<usize>)>,
    /// Bytes of the row read so far.
    read: Vec<u8>,
    /// Size of the whole row, bytes.
    length: usize,
    /// Number of the overflow page that is read next.
    next: u32,
}

impl<'p, 'd> Record<'p, 'd> {
    /// Opens the row at `place`. Reads only the part of the row in its own page, and no overflow page.
    pub(crate) fn read(
        pages: &'p mut Pages<'d>,
        table: &SqliteTable,
        place: RowPlace,
    ) -> Result<Record<'p, 'd>, TableError> {
        let page = pages.page(place.page)?;
        let beyond = "a cell beyond its end";
        let head = Head::of(place.page, &page).filter(Head::is_leaf);
        let cell = head.and_then(|head| head.cell(&page, place.cell));
        let cell = cell.ok_or_else(|| pages.damaged(place.page, beyond))?;
        let (length, rest) = varint(cell).ok_or_else(|| pages.damaged(place.page, beyond))?;
        let (number, rest) = varint(rest).ok_or_else(|| pages.damaged(place.page, beyond))?;
        let source = &pages.database.source;
        let most = pages.database.announced_bytes();
        if length > most {
            let problem = format!("a row of {length} bytes, but the file has {most}");
            return Err(pages.damaged(place.page, problem));
        }
        if length > limits::CELL_BYTES {
            let problem = format!(
                "a row of {length} bytes, at most {} are accepted",
                limits::CELL_BYTES
            );
            return Err(source.too_large(crate::error::Place::of(&table.name), problem));
        }
        pages.count(place, length)?;
        let length = usize::try_from(length).unwrap_or(usize::MAX);
        let local = in_page(length, pages.database.usable as usize);
        let read = rest
            .get(..local)
            .ok_or_else(|| pages.damaged(place.page, beyond))?;
        let next = match local < length {
            false => 0,
            true => {
                let next = rest.get(local..).and_then(|rest| rest.first_chunk::<4>());
                u32::from_be_bytes(*next.ok_or_else(|| pages.damaged(place.page, beyond))?)
            }
        };
        let mut record = Record {
            read: read.to_vec(),
            values: Vec::new(),
            id: table.id,
            // A negative number is stored as the bits of an unsigned one.
            number: i64::from_ne_bytes(number.to_ne_bytes()),
            page: place.page,
            length,
            next,
            pages,
        };
        record.read_head()?;
        Ok(record)
    }

    /// Size of the whole row, bytes.
    pub(crate) fn bytes(&self) -> u64 {
        self.length as u64
    }

    /// Bytes of the row read so far. They contain all requested values.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.read
    }

    /// True if the row is complete, and false if a part of it is on a missing page of a truncated file.
    pub(crate) fn is_before_cut(&mut self) -> Result<bool, TableError> {
        match self.read_to(self.length) {
            Ok(()) => Ok(true),
            Err(_) if self.pages.is_beyond_cut(self.next) => {
                let absent = self.length.saturating_sub(self.read.len());
                self.pages.uncount(absent as u64);
                Ok(false)
            }
            Err(error) => Err(error),
        }
    }

    /// Value in the column at `position`, from 0; null if the row was written before the column was added.
    pub(crate) fn value(&mut self, position: usize) -> Result<Value, TableError> {
        let Some((kind, range)) = self.values.get(position).cloned() else {
            return Ok(Value::Null);
        };
        if kind == 0 && self.id == Some(position) {
            return Ok(Value::Integer(self.number));
        }
        self.read_to(range.end)?;
        let bytes = self.read.get(range.clone()).unwrap_or_default();
        Ok(match kind {
            0 => Value::Null,
            1..=6 => {
                let is_negative = bytes.first().is_some_and(|first| first & 0x80 != 0);
                let first = if is_negative { -1_i64 } else { 0 };
                let number = bytes
                    .iter()
                    .fold(first, |sum, byte| (sum << 8) | i64::from(*byte));
                Value::Integer(number)
            }
            7 => {
                let bytes = bytes.first_chunk::<8>().copied().unwrap_or_default();
                Value::Real(f64::from_be_bytes(bytes))
            }
            8 => Value::Integer(0),
            9 => Value::Integer(1),
            kind if kind % 2 == 0 => Value::Blob(range),
            _ => match std::str::from_utf8(bytes) {
                Ok(text) => Value::Text(text.to_owned()),
                Err(_) => return Err(self.pages.damaged(self.page, "a string is not UTF-8")),
            },
        })
    }

    /// Text in the column at `position`; empty for null.
    pub(crate) fn text(&mut self, position: usize) -> Result<String, TableError> {
        match self.value(position)? {
            Value::Text(text) => Ok(text),
            Value::Null => Ok(String::new()),
            other => {
                let problem = format!("{other:?}, expected a string");
                Err(self.pages.damaged(self.page, problem))
            }
        }
    }

    /// Reads the types of the values.
    fn read_head(&mut self) -> Result<(), TableError> {
        let head = varint(&self.read).map(|(size, _)| size);
        let size = head.and_then(|size| usize::try_from(size).ok());
        let size = size.filter(|size| *size <= self.length && *size <= limits::NAMES);
        let wrong = "the header of a row is longer than the row";
        let size = size.ok_or_else(|| self.pages.damaged(self.page, wrong))?;
        self.read_to(size)?;
        let mut rest = self.read.get(..size).unwrap_or_default();
        rest = varint(rest).map_or(&[][..], |(_, rest)| rest);
        let mut at = size;
        while !rest.is_empty() {
            let parsed = varint(rest);
            let sized = parsed.and_then(|(kind, after)| {
                let bytes = match kind {
                    0 | 8 | 9 => 0,
                    1..=4 => kind,
                    5 => 6,
                    6 | 7 => 8,
                    10 | 11 => return None,
                    kind => (kind - 12) / 2,
                };
                let end = at.checked_add(usize::try_from(bytes).ok()?)?;
                (end <= self.length).then_some((kind, end, after))
            });
            let Some((kind, end, after)) = sized else {
                return Err(self
                    .pages
                    .damaged(self.page, "values beyond the end of their row"));
            };
            self.values.push((kind, at..end));
            (at, rest) = (end, after);
        }
        Ok(())
    }

    /// Reads overflow pages until the first `end` bytes of the row are read.
    fn read_to(&mut self, end: usize) -> Result<(), TableError> {
        if self.read.len() >= end {
            return Ok(());
        }
        let mut seen = HashSet::new();
        let usable = self.pages.database.usable as usize;
        while self.read.len() < self.length {
            if !seen.insert(self.next) {
                return Err(self.pages.damaged(self.next, "a row uses this page twice"));
            }
            let page = self.pages.read(self.next)?;
            let Some((next, bytes)) = page
                .get(..usable)
                .and_then(|page| page.split_first_chunk::<4>())
            else {
                return Err(self.pages.damaged(self.next, "cut short"));
            };
            let count = bytes.len().min(self.length - self.read.len());
            self.read.extend_from_slice(&bytes[..count]);
            self.next = u32::from_be_bytes(*next);
        }
        Ok(())
    }
}

/// Number of bytes of a row of `length` bytes that are in its own page and not in overflow pages. `usable` is the usable size of a page.
fn in_page(length: usize, usable: usize) -> usize {
    let most = usable - 35;
    if length <= most {
        return length;
    }
    let least = (usable - 12) * 32 / 255 - 23;
    let even = least + (length - least) % (usable - 4);
    if even <= most { even } else { least }
}

/// Parses a varint of one to nine bytes, the most significant byte first. Also returns the bytes after it.
fn varint(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let mut number = 0_u64;
    for at in 0..8 {
        let byte = *bytes.get(at)?;
        number = (number << 7) | u64::from(byte & 0x7f);
        if byte & 0x80 == 0 {
            return Some((number, bytes.get(at + 1..)?));
        }
    }
    let last = *bytes.get(8)?;
    Some(((number << 8) | u64::from(last), bytes.get(9..)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_take_one_to_nine_bytes() {
        for (bytes, number) in [
            (&[0x7f][..], 0x7f),
            (&[0x81, 0x00], 0x80),
            (&[0xff; 9], u64::MAX),
            (&[0x81, 0x80, 0x01], 0x4001),
        ] {
            assert_eq!(varint(bytes), Some((number, &[][..])), "{bytes:?}");
            assert_eq!(varint(&bytes[..bytes.len() - 1]), None, "{bytes:?}");
        }
    }

    #[test]
    fn a_row_fills_its_last_page_of_others_where_that_leaves_enough_here() {
        for (length, usable, expected) in [
            (4061, 4096, 4061),
            (4062, 4096, 489),
            (5000, 4096, 908),
            (477, 512, 477),
            (478, 512, 39),
        ] {
            assert_eq!(in_page(length, usable), expected, "{length} of {usable}");
        }
    }
}
