//! Encodes a table as a Parquet file.

use std::io::Write;
use std::ops::Range;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use crate::table::{Cells, NamedColumn, Table};

pub(super) fn write(table: &Table) -> Result<Vec<u8>, ParquetError> {
    let columns = table.columns();
    let fields = columns
        .iter()
        .map(|column| field(column).map(Arc::new))
        .collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("samples")
        .with_fields(fields)
        .build()?;
    let properties = properties(units(table));
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for column in &columns {
        write_column(&mut group, &column.cells, 0..table.rows())?;
    }
    group.close()?;
    writer.into_inner()
}

/// Unit of each channel, as file metadata.
fn units(table: &Table) -> Vec<KeyValue> {
    let units = table.channels().iter().map(|channel| {
        KeyValue::new(
            format!("unit.{}", channel.name()),
            channel.unit().symbol().to_owned(),
        )
    });
    units.collect()
}

/// Writer settings that give the same bytes for the same table.
fn properties(metadata: Vec<KeyValue>) -> WriterProperties {
    WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by("taceva".to_owned())
        .set_key_value_metadata(Some(metadata))
        .build()
}

fn field(column: &NamedColumn<'_>) -> Result<Type, ParquetError> {
    let (physical, logical) = match column.cells {
        Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => (PhysicalType::DOUBLE, None),
        Cells::Count(_) | Cells::Class(..) => (PhysicalType::INT64, None),
        _ => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String)),
    };
    Type::primitive_type_builder(column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()
}

/// Writes the cells of a column in `rows`.
fn write_column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    cells: &Cells<'_>,
    rows: Range<usize>,
) -> Result<(), ParquetError> {
    match cells {
        Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => {
            write_values::<DoubleType, W>(group, rows.map(|row| cells.number(row)), 1)
        }
        Cells::Count(counts) | Cells::Class(counts, _) => write_values::<Int64Type, W>(
            group,
            counts[rows].iter().map(|count| count.map(i64::from)),
            1,
        ),
        _ => write_values::<ByteArrayType, W>(
            group,
            rows.map(|row| {
                cells
                    .text(row)
                    .map(|text| ByteArray::from(text.into_bytes()))
            }),
            1,
        ),
    }
}

/// Writes the next column; a non-null value is at the definition level `level`.
fn write_values<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    cells: impl Iterator<Item = Option<T::T>>,
    level: i16,
) -> Result<(), ParquetError> {
    let mut levels = Vec::new();
    let values: Vec<T::T> = cells
        .inspect(|cell| levels.push(if cell.is_some() { level } else { 0 }))
        .flatten()
        .collect();
    let mut column = group
        .next_column()?
        .ok_or_else(|| ParquetError::General("fewer columns than fields".to_owned()))?;
    column
        .typed::<T>()
        .write_batch(&values, Some(&levels), None)?;
    column.close()
}
