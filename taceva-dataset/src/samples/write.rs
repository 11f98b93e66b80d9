//! A table as the bytes of a Parquet file.

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
    let units = table.channels().iter().map(|channel| {
        KeyValue::new(
            format!("unit.{}", channel.name()),
            channel.unit().symbol().to_owned(),
        )
    });
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by("taceva".to_owned())
        .set_key_value_metadata(Some(units.collect()))
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for column in &columns {
        write_column(&mut group, &column.cells, table.rows())?;
    }
    group.close()?;
    writer.into_inner()
}

fn field(column: &NamedColumn<'_>) -> Result<Type, ParquetError> {
    let (physical, logical) = match column.cells {
        Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => (PhysicalType::DOUBLE, None),
        Cells::Count(_) => (PhysicalType::INT64, None),
        _ => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String)),
    };
    Type::primitive_type_builder(column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()
}

fn write_column(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    cells: &Cells<'_>,
    rows: usize,
) -> Result<(), ParquetError> {
    match cells {
        Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => {
            write_values::<DoubleType>(group, (0..rows).map(|row| cells.number(row)))
        }
        Cells::Count(counts) => {
            write_values::<Int64Type>(group, counts.iter().map(|count| count.map(i64::from)))
        }
        _ => write_values::<ByteArrayType>(
            group,
            (0..rows).map(|row| {
                cells
                    .text(row)
                    .map(|text| ByteArray::from(text.into_bytes()))
            }),
        ),
    }
}

fn write_values<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let mut levels = Vec::new();
    let values: Vec<T::T> = cells
        .inspect(|cell| levels.push(i16::from(cell.is_some())))
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
