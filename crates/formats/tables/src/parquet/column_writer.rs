//! Columns of a Parquet file to be written, and the conversion of their cells to values and levels.

use std::fmt;
use std::io::Write;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::writer::SerializedRowGroupWriter;
use parquet::schema::types::{Type, TypePtr};
use serde_json::{Map, Value, json};

use crate::cell::Cell;

/// Column of a file to be written. All its cells may be null.
///
/// ```
/// use taceva_tables::{WrittenColumn, WrittenKind};
/// let column = WrittenColumn::new("Fz", WrittenKind::Number);
/// assert_eq!(column.name, "Fz");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WrittenColumn {
    /// Name of the column.
    pub name: String,
    /// Kind of the cells.
    pub kind: WrittenKind,
}

/// Kind of the non-null cells of a written column.
///
/// ```
/// use taceva_tables::{Cell, WrittenKind};
/// assert!(WrittenKind::Integer.takes(&Cell::Integer(7)));
/// assert!(!WrittenKind::Numbers(Some(2)).takes(&Cell::List(vec![Cell::Number(1.0)])));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WrittenKind {
    /// Signed integers of 64 bits.
    Integer,
    /// Numbers of double precision.
    Number,
    /// Numbers of single precision.
    Single,
    /// Texts.
    Text,
    /// Lists of numbers of double precision; `Some` is the required length.
    Numbers(Option<usize>),
    /// Lists of numbers of single precision; `Some` is the required length.
    Singles(Option<usize>),
    /// Lists of texts.
    Texts,
    /// Pictures as in the library `datasets`: structures of `bytes`, the content of a PNG or JPEG file, and `path`, its name.
    Picture,
}

impl WrittenColumn {
    /// Column `name` with cells of `kind`.
    pub fn new(name: impl Into<String>, kind: WrittenKind) -> WrittenColumn {
        WrittenColumn {
            name: name.into(),
            kind,
        }
    }

    pub(super) fn field(&self) -> Result<Type, ParquetError> {
        let leaf = |name: &str, physical: Physical| leaf(name, physical, None);
        let text = |name: &str| self::leaf(name, Physical::BYTE_ARRAY, Some(LogicalType::String));
        let list = |element: Type| list(&self.name, Arc::new(element));
        match self.kind {
            WrittenKind::Integer => leaf(&self.name, Physical::INT64),
            WrittenKind::Number => leaf(&self.name, Physical::DOUBLE),
            WrittenKind::Single => leaf(&self.name, Physical::FLOAT),
            WrittenKind::Text => text(&self.name),
            WrittenKind::Numbers(_) => list(leaf("element", Physical::DOUBLE)?),
            WrittenKind::Singles(_) => list(leaf("element", Physical::FLOAT)?),
            WrittenKind::Texts => list(text("element")?),
            WrittenKind::Picture => Type::group_type_builder(&self.name)
                .with_repetition(Repetition::OPTIONAL)
                .with_fields(vec![
                    Arc::new(leaf("bytes", Physical::BYTE_ARRAY)?),
                    Arc::new(text("path")?),
                ])
                .build(),
        }
    }
}

fn leaf(
    name: &str,
    physical: Physical,
    logical: Option<LogicalType>,
) -> Result<Type, ParquetError> {
    Type::primitive_type_builder(name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()
}

fn list(name: &str, element: TypePtr) -> Result<Type, ParquetError> {
    let repeated = Type::group_type_builder("list")
        .with_repetition(Repetition::REPEATED)
        .with_fields(vec![element])
        .build()?;
    Type::group_type_builder(name)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(Some(LogicalType::List))
        .with_fields(vec![Arc::new(repeated)])
        .build()
}

/// Description of the columns for the library `datasets` of Hugging Face. The metadata of a file stores it under the key `huggingface`.
///
/// ```
/// use taceva_tables::{WrittenColumn, WrittenKind, huggingface_features};
/// let said = huggingface_features(&[WrittenColumn::new("image", WrittenKind::Picture)]);
/// assert_eq!(said, r#"{"info":{"features":{"image":{"_type":"Image"}}}}"#);
/// ```
pub fn huggingface_features(columns: &[WrittenColumn]) -> String {
    let value = |dtype: &str| json!({ "dtype": dtype, "_type": "Value" });
    let list = |dtype: &str, length: Option<usize>| match length {
        Some(length) => json!({ "feature": value(dtype), "length": length, "_type": "Sequence" }),
        None => json!({ "feature": value(dtype), "_type": "Sequence" }),
    };
    let of = |column: &WrittenColumn| {
        let feature: Value = match column.kind {
            WrittenKind::Integer => value("int64"),
            WrittenKind::Number => value("float64"),
            WrittenKind::Single => value("float32"),
            WrittenKind::Text => value("string"),
            WrittenKind::Numbers(length) => list("float64", length),
            WrittenKind::Singles(length) => list("float32", length),
            WrittenKind::Texts => list("string", None),
            WrittenKind::Picture => json!({ "_type": "Image" }),
        };
        (column.name.clone(), feature)
    };
    let features: Map<String, Value> = columns.iter().map(of).collect();
    json!({ "info": { "features": features } }).to_string()
}

impl WrittenKind {
    /// True if a column of this kind accepts `cell`. Null is always accepted.
    pub fn takes(&self, cell: &Cell) -> bool {
        let is_number = |cell: &Cell| matches!(cell, Cell::Number(_) | Cell::Null);
        let is_text = |cell: &Cell| matches!(cell, Cell::Text(_) | Cell::Null);
        match (self, cell) {
            (_, Cell::Null) => true,
            (WrittenKind::Integer, Cell::Integer(value)) => i64::try_from(*value).is_ok(),
            (WrittenKind::Number | WrittenKind::Single, cell) => is_number(cell),
            (WrittenKind::Text, cell) => is_text(cell),
            (WrittenKind::Numbers(length) | WrittenKind::Singles(length), Cell::List(cells)) => {
                length.is_none_or(|length| length == cells.len()) && cells.iter().all(is_number)
            }
            (WrittenKind::Texts, Cell::List(cells)) => cells.iter().all(is_text),
            (WrittenKind::Picture, Cell::Struct(members)) => matches!(
                &members[..],
                [(bytes, Cell::Bytes(_)), (path, Cell::Text(_))] if bytes == "bytes" && path == "path"
            ),
            _ => false,
        }
    }
}

impl fmt::Display for WrittenKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let several = |f: &mut fmt::Formatter<'_>, length: &Option<usize>| match length {
            Some(length) => write!(f, "a list of {length} numbers"),
            None => f.write_str("a list of numbers"),
        };
        match self {
            WrittenKind::Integer => f.write_str("an integer of 64 bits"),
            WrittenKind::Number | WrittenKind::Single => f.write_str("a number"),
            WrittenKind::Text => f.write_str("a string"),
            WrittenKind::Numbers(length) | WrittenKind::Singles(length) => several(f, length),
            WrittenKind::Texts => f.write_str("a list of strings"),
            WrittenKind::Picture => f.write_str("`bytes` and `path` of a picture"),
        }
    }
}

/// Writes `cells` of the kind `kind` as the next column of a row group.
pub(super) fn write_column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    kind: &WrittenKind,
    cells: &[Cell],
) -> Result<(), ParquetError> {
    match kind {
        WrittenKind::Integer => write_leaf::<Int64Type, W>(group, cells, integer),
        WrittenKind::Number => write_leaf::<DoubleType, W>(group, cells, number),
        WrittenKind::Single => write_leaf::<FloatType, W>(group, cells, single),
        WrittenKind::Text => write_leaf::<ByteArrayType, W>(group, cells, bytes),
        WrittenKind::Numbers(_) => write_lists::<DoubleType, W>(group, cells, number),
        WrittenKind::Singles(_) => write_lists::<FloatType, W>(group, cells, single),
        WrittenKind::Texts => write_lists::<ByteArrayType, W>(group, cells, bytes),
        WrittenKind::Picture => {
            for member in 0..2 {
                let inside = |cell: &Cell| match cell {
                    Cell::Struct(members) => members.get(member).and_then(|(_, cell)| bytes(cell)),
                    _ => None,
                };
                // A non-null value is below two optional levels.
                let levels = cells
                    .iter()
                    .map(|cell| 2 * i16::from(inside(cell).is_some()));
                let values = cells.iter().filter_map(inside).collect();
                write::<ByteArrayType, W>(group, values, levels.collect(), None)?;
            }
            Ok(())
        }
    }
}

/// Writes a column with one value per row.
fn write_leaf<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    cells: &[Cell],
    value: fn(&Cell) -> Option<T::T>,
) -> Result<(), ParquetError> {
    let levels = cells.iter().map(|cell| i16::from(value(cell).is_some()));
    let values = cells.iter().filter_map(value).collect();
    write::<T, W>(group, values, levels.collect(), None)
}

/// Writes a column with one list per row. Definition level 0 means no list, 1 an empty list, 2 a null element, 3 a value. Repetition level 1 marks
/// all elements except the first.
fn write_lists<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    cells: &[Cell],
    value: fn(&Cell) -> Option<T::T>,
) -> Result<(), ParquetError> {
    let mut values = Vec::new();
    let (mut definitions, mut repetitions) = (Vec::new(), Vec::new());
    for cell in cells {
        let Cell::List(elements) = cell else {
            definitions.push(0);
            repetitions.push(0);
            continue;
        };
        if elements.is_empty() {
            definitions.push(1);
            repetitions.push(0);
        }
        for (place, element) in elements.iter().enumerate() {
            let found = value(element);
            definitions.push(if found.is_some() { 3 } else { 2 });
            repetitions.push(i16::from(place > 0));
            values.extend(found);
        }
    }
    write::<T, W>(group, values, definitions, Some(repetitions))
}

fn write<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: Vec<T::T>,
    definitions: Vec<i16>,
    repetitions: Option<Vec<i16>>,
) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(|| {
        ParquetError::General("the table has fewer columns than fields".to_owned())
    })?;
    column
        .typed::<T>()
        .write_batch(&values, Some(&definitions), repetitions.as_deref())?;
    column.close()
}

fn integer(cell: &Cell) -> Option<i64> {
    match cell {
        Cell::Integer(value) => i64::try_from(*value).ok(),
        _ => None,
    }
}

fn number(cell: &Cell) -> Option<f64> {
    match cell {
        Cell::Number(value) => Some(*value),
        _ => None,
    }
}

fn single(cell: &Cell) -> Option<f32> {
    number(cell).map(taceva_core::single)
}

fn bytes(cell: &Cell) -> Option<ByteArray> {
    match cell {
        Cell::Text(text) => Some(ByteArray::from(text.as_bytes().to_vec())),
        Cell::Bytes(bytes) => Some(ByteArray::from(bytes.clone())),
        _ => None,
    }
}
