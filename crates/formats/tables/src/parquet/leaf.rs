//! Leaf of a Parquet column: its values, and the levels that assign them to rows and lists.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use parquet::column::reader::{ColumnReader, get_column_reader};
use parquet::data_type::{ByteArray, FixedLenByteArray, Int96};
use parquet::errors::ParquetError;
use parquet::file::metadata::RowGroupMetaData;

use super::pages::Pages;
use super::schema::LeafForm;
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::scalar::{decimal, half, nanoseconds_in};
use crate::source::Source;

/// Reader of a leaf of a column in one row group, in batches of rows.
pub(super) struct Leaf {
    source: Source,
    name: String,
    form: LeafForm,
    reader: ColumnReader,
    max_definition: i16,
    has_repetition: bool,
    handed: Arc<AtomicU64>,
    values: Values,
    definitions: Vec<i16>,
    repetitions: Vec<i16>,
    /// Index of the next level. `next_value` is the index of the next non-null value.
    at: usize,
    next_value: usize,
}

enum Values {
    Bool(Vec<bool>),
    Int32(Vec<i32>),
    Int64(Vec<i64>),
    Int96(Vec<Int96>),
    Float(Vec<f32>),
    Double(Vec<f64>),
    Bytes(Vec<ByteArray>),
    Fixed(Vec<FixedLenByteArray>),
}

impl Leaf {
    /// Creates the reader of the leaf with the index `column` in the row group `group`.
    pub(super) fn new(
        source: &Source,
        group: &RowGroupMetaData,
        column: usize,
        form: LeafForm,
    ) -> Result<Leaf, TableError> {
        let Some(chunk) = group.columns().get(column) else {
            let problem = format!(
                "a row group has {} columns, but no column {column}",
                group.num_columns()
            );
            return Err(source.damaged(Place::default(), problem));
        };
        let name = chunk.column_path().string();
        let handed = Arc::new(AtomicU64::new(0));
        let pages = Pages::new(source, &name, chunk, Arc::clone(&handed))?;
        let described = chunk.column_descr_ptr();
        let (max_definition, max_repetition) =
            (described.max_def_level(), described.max_rep_level());
        let reader = get_column_reader(described, Box::new(pages));
        let values = match &reader {
            ColumnReader::BoolColumnReader(_) => Values::Bool(Vec::new()),
            ColumnReader::Int32ColumnReader(_) => Values::Int32(Vec::new()),
            ColumnReader::Int64ColumnReader(_) => Values::Int64(Vec::new()),
            ColumnReader::Int96ColumnReader(_) => Values::Int96(Vec::new()),
            ColumnReader::FloatColumnReader(_) => Values::Float(Vec::new()),
            ColumnReader::DoubleColumnReader(_) => Values::Double(Vec::new()),
            ColumnReader::ByteArrayColumnReader(_) => Values::Bytes(Vec::new()),
            ColumnReader::FixedLenByteArrayColumnReader(_) => Values::Fixed(Vec::new()),
        };
        Ok(Leaf {
            source: source.clone(),
            name,
            form,
            reader,
            max_definition,
            has_repetition: max_repetition > 0,
            handed,
            values,
            definitions: Vec::new(),
            repetitions: Vec::new(),
            at: 0,
            next_value: 0,
        })
    }

    /// Reads the next `rows` rows. The caller has taken all entries of earlier rows.
    pub(super) fn read(&mut self, rows: usize) -> Result<(), TableError> {
        self.handed.store(0, Ordering::Relaxed);
        (self.at, self.next_value) = (0, 0);
        self.definitions.clear();
        self.repetitions.clear();
        let (definitions, repetitions) = (&mut self.definitions, &mut self.repetitions);
        macro_rules! read {
            ($reader:expr, $values:expr) => {{
                $values.clear();
                $reader.read_records(rows, Some(definitions), Some(repetitions), $values)
            }};
        }
        let read = match (&mut self.reader, &mut self.values) {
            (ColumnReader::BoolColumnReader(reader), Values::Bool(values)) => read!(reader, values),
            (ColumnReader::Int32ColumnReader(reader), Values::Int32(values)) => {
                read!(reader, values)
            }
            (ColumnReader::Int64ColumnReader(reader), Values::Int64(values)) => {
                read!(reader, values)
            }
            (ColumnReader::Int96ColumnReader(reader), Values::Int96(values)) => {
                read!(reader, values)
            }
            (ColumnReader::FloatColumnReader(reader), Values::Float(values)) => {
                read!(reader, values)
            }
            (ColumnReader::DoubleColumnReader(reader), Values::Double(values)) => {
                read!(reader, values)
            }
            (ColumnReader::ByteArrayColumnReader(reader), Values::Bytes(values)) => {
                read!(reader, values)
            }
            (ColumnReader::FixedLenByteArrayColumnReader(reader), Values::Fixed(values)) => {
                read!(reader, values)
            }
            _ => unreachable!("the values have the type of the reader"),
        };
        let (found, values, levels) = read.map_err(|error| self.outer(error))?;
        if self.max_definition == 0 {
            self.definitions.resize(levels, 0);
        }
        let is_whole = found == rows && self.definitions.len() == levels;
        match is_whole
            && values <= levels
            && (!self.has_repetition || self.repetitions.len() == levels)
        {
            true => Ok(()),
            false => Err(self.damaged(format!(
                "the column ends {} rows early",
                rows.saturating_sub(found)
            ))),
        }
    }

    pub(super) fn skip(&mut self, rows: usize) -> Result<(), TableError> {
        self.handed.store(0, Ordering::Relaxed);
        let skipped = match &mut self.reader {
            ColumnReader::BoolColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::Int32ColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::Int64ColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::Int96ColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::FloatColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::DoubleColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::ByteArrayColumnReader(reader) => reader.skip_records(rows),
            ColumnReader::FixedLenByteArrayColumnReader(reader) => reader.skip_records(rows),
        };
        match skipped.map_err(|error| self.outer(error))? {
            passed if passed == rows => Ok(()),
            passed => Err(self.damaged(format!("the column ends {} rows early", rows - passed))),
        }
    }

    /// Definition and repetition level of the next entry; `None` after the last entry that was read.
    pub(super) fn peek(&self) -> Option<(i16, i16)> {
        let definition = *self.definitions.get(self.at)?;
        let repetition = match self.has_repetition {
            true => *self.repetitions.get(self.at)?,
            false => 0,
        };
        Some((definition, repetition))
    }

    /// Takes the next entry as a cell. The cell is null if the definition level of the entry is below the maximum of the leaf.
    pub(super) fn take(&mut self) -> Result<Cell, TableError> {
        let Some((definition, _)) = self.peek() else {
            return Err(self.damaged("it has fewer entries than the other columns"));
        };
        self.at += 1;
        if definition < self.max_definition {
            return Ok(Cell::Null);
        }
        let at = self.next_value;
        self.next_value += 1;
        self.value(at)
    }

    fn value(&self, at: usize) -> Result<Cell, TableError> {
        let cell = match &self.values {
            Values::Bool(values) => values.get(at).copied().map(Cell::Bool),
            Values::Int32(values) => values.get(at).map(|value| match self.form {
                LeafForm::Unsigned => Cell::Integer(value.cast_unsigned().into()),
                _ => self.integer((*value).into()),
            }),
            Values::Int64(values) => values.get(at).map(|value| match self.form {
                LeafForm::Unsigned => Cell::Integer(value.cast_unsigned().into()),
                _ => self.integer((*value).into()),
            }),
            Values::Int96(values) => values.get(at).map(|value| Cell::Time(nanoseconds(value))),
            Values::Float(values) => values.get(at).map(|value| Cell::Number((*value).into())),
            Values::Double(values) => values.get(at).map(|value| Cell::Number(*value)),
            Values::Bytes(values) => match values.get(at) {
                Some(value) => Some(self.bytes(value.data())?),
                None => None,
            },
            Values::Fixed(values) => match values.get(at) {
                Some(value) => Some(self.bytes(value.data())?),
                None => None,
            },
        };
        cell.ok_or_else(|| self.damaged("it has fewer values than its levels state"))
    }

    fn integer(&self, value: i128) -> Cell {
        match self.form {
            LeafForm::Decimal { scale } => decimal(value, scale),
            LeafForm::Time(unit) => Cell::Time(value * nanoseconds_in(unit)),
            _ => Cell::Integer(value),
        }
    }

    fn bytes(&self, bytes: &[u8]) -> Result<Cell, TableError> {
        Ok(match self.form {
            LeafForm::Text => match std::str::from_utf8(bytes) {
                Ok(text) => Cell::Text(text.to_owned()),
                Err(_) => return Err(self.damaged("a string is not UTF-8")),
            },
            LeafForm::Decimal { scale } => match bytes.len() {
                0 => Cell::Null,
                1..=16 => {
                    let sign = if bytes[0] & 0x80 == 0 { 0 } else { -1 };
                    let value = bytes
                        .iter()
                        .fold(sign, |value: i128, byte| (value << 8) | i128::from(*byte));
                    decimal(value, scale)
                }
                more => {
                    return Err(self.damaged(format!(
                        "a decimal number has {more} bytes, expected at most 16"
                    )));
                }
            },
            LeafForm::Half => match bytes {
                [low, high] => Cell::Number(half(u16::from_le_bytes([*low, *high]))),
                _ => return Err(self.damaged("a half-precision number does not have two bytes")),
            },
            _ => Cell::Bytes(bytes.to_vec()),
        })
    }

    /// Converts an error of the `parquet` crate. Unwraps an error of this crate that it passed on.
    fn outer(&self, error: ParquetError) -> TableError {
        match error {
            ParquetError::External(inner) => match inner.downcast::<TableError>() {
                Ok(ours) => *ours,
                Err(other) => self.damaged(other.to_string()),
            },
            other => self.damaged(other.to_string()),
        }
    }

    fn damaged(&self, problem: impl Into<String>) -> TableError {
        self.source.damaged(Place::of(&self.name), problem)
    }
}

/// Converts a 12-byte time stamp, nanoseconds of the day and Julian day, to nanoseconds since 1970.
fn nanoseconds(value: &Int96) -> i128 {
    let [low, high, day] = [value.data()[0], value.data()[1], value.data()[2]];
    let of_day = (i128::from(high) << 32) | i128::from(low);
    (i128::from(day) - 2_440_588) * 86_400_000_000_000 + of_day
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn old_time_stamps_count_from_1970() {
        let mut stamp = Int96::new();
        stamp.set_data(5, 0, 2_440_589);
        assert_eq!(nanoseconds(&stamp), 86_400_000_000_005);
    }
}
