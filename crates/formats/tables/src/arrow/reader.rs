//! Conversion of the buffers of a batch to cells.

use std::collections::BTreeMap;
use std::fs::File;

use super::batch::Batch;
use super::field::{Field, FieldKind, Number};
use crate::cell::Cell;
use crate::codec;
use crate::error::{Place, TableError};
use crate::limits;
use crate::scalar::{decimal, half, nanoseconds_in};
use crate::source::Source;

/// Reader of the cells of a record batch.
pub(super) struct Reader<'t> {
    source: &'t Source,
    file: File,
    batch: &'t Batch,
    name: &'t str,
    /// Unpacked buffers by their index in the batch.
    unpacked: BTreeMap<usize, Vec<u8>>,
    /// Memory that further cells may take, bytes.
    pub(super) left: u64,
}

impl<'t> Reader<'t> {
    pub(super) fn new(
        source: &'t Source,
        batch: &'t Batch,
        name: &'t str,
    ) -> Result<Reader<'t>, TableError> {
        Ok(Reader {
            source,
            file: source.open()?,
            batch,
            name,
            unpacked: BTreeMap::new(),
            left: limits::COLUMN_BYTES,
        })
    }

    /// Cells of `count` entries of `field`, from the entry with the index `begin` on.
    pub(super) fn cells(
        &mut self,
        field: &Field,
        begin: u64,
        count: u64,
    ) -> Result<Vec<Cell>, TableError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        self.charge(count.saturating_mul(size_of::<Cell>() as u64))?;
        if begin.checked_add(count).is_none() {
            return Err(self.damaged(format!("{count} entries from entry {begin}")));
        }
        let entries = usize::try_from(count).unwrap_or(usize::MAX);
        if let FieldKind::Null = field.kind {
            return Ok(vec![Cell::Null; entries]);
        }
        let valid = match self.batch.buffers.get(field.buffer) {
            Some(buffer) if buffer.bytes > 0 => Some(self.bits(field.buffer, begin, count)?),
            _ => None,
        };
        let is_there = |at: usize| valid.as_ref().is_none_or(|valid| valid[at]);
        let mut cells = match &field.kind {
            FieldKind::Null => Vec::new(),
            FieldKind::Bool => {
                let bits = self.bits(field.buffer + 1, begin, count)?;
                bits.into_iter().map(Cell::Bool).collect()
            }
            FieldKind::Fixed(bytes, number) => {
                let raw = self.entries(field.buffer + 1, begin, count, *bytes)?;
                raw.chunks_exact(*bytes)
                    .map(|raw| cell(raw, *number))
                    .collect()
            }
            FieldKind::Bytes { is_text, offset } => {
                let offsets = self.offsets(field.buffer + 1, begin, count, *offset)?;
                let start = offsets[0];
                let bytes = offsets[entries] - start;
                self.charge(bytes)?;
                let raw = self.buffer(field.buffer + 2, start, bytes)?;
                let mut cells = Vec::with_capacity(entries);
                for (at, pair) in offsets.windows(2).enumerate() {
                    let place = |offset: u64| usize::try_from(offset - start).unwrap_or(usize::MAX);
                    let own = &raw[place(pair[0])..place(pair[1])];
                    cells.push(match (is_there(at), is_text) {
                        (false, _) => Cell::Null,
                        (true, false) => Cell::Bytes(own.to_vec()),
                        (true, true) => match std::str::from_utf8(own) {
                            Ok(text) => Cell::Text(text.to_owned()),
                            Err(_) => return Err(self.damaged("a string is not UTF-8")),
                        },
                    });
                }
                cells
            }
            FieldKind::Struct(members) => {
                let mut rows: Vec<Vec<(String, Cell)>> = Vec::new();
                rows.resize_with(entries, || Vec::with_capacity(members.len()));
                for member in members {
                    let name = member.name.len() + size_of::<String>();
                    self.charge(count.saturating_mul(name as u64))?;
                    let cells = self.cells(member, begin, count)?;
                    for (row, cell) in rows.iter_mut().zip(cells) {
                        row.push((member.name.clone(), cell));
                    }
                }
                rows.into_iter().map(Cell::Struct).collect()
            }
            FieldKind::List { offset, element } => {
                let offsets = self.offsets(field.buffer + 1, begin, count, *offset)?;
                let (start, end) = (offsets[0], offsets[entries]);
                let mut elements = self.cells(element, start, end - start)?.into_iter();
                let lists = offsets.windows(2).map(|pair| {
                    let length = usize::try_from(pair[1] - pair[0]).unwrap_or(usize::MAX);
                    Cell::List(elements.by_ref().take(length).collect())
                });
                lists.collect()
            }
            FieldKind::FixedList { length, element } => {
                let start = begin.checked_mul(*length);
                let all = count.checked_mul(*length);
                let (start, all) = start
                    .zip(all)
                    .ok_or_else(|| self.damaged(format!("{count} lists of {length} elements")))?;
                let mut elements = self.cells(element, start, all)?.into_iter();
                let length = usize::try_from(*length).unwrap_or(usize::MAX);
                let lists =
                    (0..count).map(|_| Cell::List(elements.by_ref().take(length).collect()));
                lists.collect()
            }
        };
        for (at, cell) in cells.iter_mut().enumerate() {
            if !is_there(at) {
                *cell = Cell::Null;
            }
        }
        Ok(cells)
    }

    fn charge(&mut self, bytes: u64) -> Result<(), TableError> {
        match self.left.checked_sub(bytes) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => {
                let problem = format!(
                    "more than {} bytes in memory; read a part, such as `{}[0]`, or save fewer rows per file",
                    limits::COLUMN_BYTES,
                    self.name
                );
                Err(self.source.too_large(Place::of(self.name), problem))
            }
        }
    }

    /// End of each of `count` entries from entry `begin` on, bytes or elements after the start of the first entry.
    fn offsets(
        &mut self,
        index: usize,
        begin: u64,
        count: u64,
        bytes: usize,
    ) -> Result<Vec<u64>, TableError> {
        let raw = self.entries(index, begin, count + 1, bytes)?;
        let offsets: Vec<u64> = raw.chunks_exact(bytes).map(unsigned).collect();
        // A negative offset exceeds any buffer.
        match offsets.windows(2).all(|pair| pair[0] <= pair[1]) {
            true => Ok(offsets),
            false => Err(self.damaged("decreasing offsets")),
        }
    }

    /// Bits of `count` entries from entry `begin` on, in the buffer `index`.
    fn bits(&mut self, index: usize, begin: u64, count: u64) -> Result<Vec<bool>, TableError> {
        let (first, end) = (begin / 8, (begin + count).div_ceil(8));
        let bytes = self.buffer(index, first, end - first)?;
        let start = begin - first * 8;
        let bit = |at: u64| {
            let byte = bytes[usize::try_from(at / 8).unwrap_or(usize::MAX)];
            byte >> (at % 8) & 1 == 1
        };
        Ok((start..start + count).map(bit).collect())
    }

    fn entries(
        &mut self,
        index: usize,
        begin: u64,
        count: u64,
        bytes: usize,
    ) -> Result<Vec<u8>, TableError> {
        let place = |entries: u64| entries.checked_mul(bytes as u64);
        match place(begin).zip(place(count)) {
            Some((at, bytes)) => self.buffer(index, at, bytes),
            None => Err(self.damaged(format!("{count} entries of {bytes} bytes"))),
        }
    }

    /// Reads `count` bytes of the buffer `index`, from byte `begin` on.
    fn buffer(&mut self, index: usize, begin: u64, count: u64) -> Result<Vec<u8>, TableError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let buffer = self.batch.buffers[index];
        let Some(codec) = self.batch.codec else {
            let end = begin.checked_add(count);
            if end.is_none_or(|end| end > buffer.bytes) {
                return Err(self.short(begin, count, buffer.bytes));
            }
            let at = buffer.at + begin;
            return self
                .source
                .bytes(&mut self.file, at, count, limits::PAGE_BYTES);
        };
        if !self.unpacked.contains_key(&index) {
            let packed =
                self.source
                    .bytes(&mut self.file, buffer.at, buffer.bytes, limits::PAGE_BYTES)?;
            let whole = unpacked(codec, &packed).map_err(|problem| self.damaged(problem))?;
            // Only the buffers of one column are needed at the same time.
            let held: usize = self.unpacked.values().map(Vec::len).sum();
            if (held + whole.len()) as u64 > limits::PAGE_BYTES {
                self.unpacked.clear();
            }
            self.unpacked.insert(index, whole);
        }
        let whole = &self.unpacked[&index];
        let range = usize::try_from(begin).ok().zip(usize::try_from(count).ok());
        let own = range.and_then(|(begin, count)| whole.get(begin..begin.checked_add(count)?));
        match own {
            Some(own) => Ok(own.to_vec()),
            None => Err(self.short(begin, count, whole.len() as u64)),
        }
    }

    fn short(&self, begin: u64, count: u64, there: u64) -> TableError {
        self.damaged(format!(
            "expected {count} bytes from byte {begin} of a buffer, but it has {there} bytes"
        ))
    }

    fn damaged(&self, problem: impl Into<String>) -> TableError {
        let place = Place::default().in_name(self.name);
        self.source.damaged(place, problem)
    }
}

/// Unpacks a compressed buffer. The buffer contains its unpacked length (−1 if uncompressed), then the bytes.
fn unpacked(codec: codec::Codec, packed: &[u8]) -> Result<Vec<u8>, String> {
    let Some((length, rest)) = packed.split_first_chunk() else {
        return Err(format!(
            "a compressed buffer has {} bytes, expected at least 8",
            packed.len()
        ));
    };
    match i64::from_le_bytes(*length) {
        -1 => Ok(rest.to_vec()),
        length => {
            let size = usize::try_from(length).ok();
            let size = size.filter(|size| *size as u64 <= limits::PAGE_BYTES);
            let size = size.ok_or_else(|| {
                format!(
                    "a buffer of {length} bytes, at most {} are decompressed at once",
                    limits::PAGE_BYTES
                )
            })?;
            codec::unpack(codec, rest, size)
        }
    }
}

/// Converts a number of up to 16 bytes to a cell. Opaque values may have any length.
fn cell(raw: &[u8], number: Number) -> Cell {
    match number {
        Number::Signed => Cell::Integer(signed(raw)),
        Number::Unsigned => Cell::Integer(unsigned(raw).into()),
        Number::Decimal(scale) => decimal(signed(raw), scale),
        Number::Time(unit) => Cell::Time(signed(raw) * nanoseconds_in(unit)),
        Number::Float => Cell::Number(match raw {
            [a, b] => half(u16::from_le_bytes([*a, *b])),
            [a, b, c, d] => f32::from_le_bytes([*a, *b, *c, *d]).into(),
            _ => f64::from_bits(unsigned(raw)),
        }),
        Number::Opaque => Cell::Bytes(raw.to_vec()),
    }
}

fn signed(raw: &[u8]) -> i128 {
    let sign = if raw.last().is_some_and(|byte| byte & 0x80 != 0) {
        -1
    } else {
        0
    };
    let bytes = raw.iter().rev();
    bytes.fold(sign, |value: i128, byte| (value << 8) | i128::from(*byte))
}

/// Converts up to 8 little-endian bytes to a number.
fn unsigned(raw: &[u8]) -> u64 {
    let bytes = raw.iter().rev();
    bytes.fold(0, |value: u64, byte| (value << 8) | u64::from(*byte))
}
