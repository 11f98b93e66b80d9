//! `samples.parquet`: a table as a file, a column a column.

use std::collections::BTreeMap;
use std::fs::File;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as PhysicalType};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use taceva_core::{Channels, GratingKind, Limit, MAGNITUDE_MAX, Nanometre, Phase, is_scorable};

use crate::digest::Digest;
use crate::guard::guarded;
use crate::limits;
use crate::table::{Cells, FrameEntry, NamedColumn, Row, Table};

/// The bytes of the file that holds `table`.
pub(crate) fn to_parquet(table: &Table) -> Result<Vec<u8>, String> {
    guarded(|| write(table).map_err(|error| error.to_string()))?
}

/// The table in `file`, whose digest the caller has checked.
pub(crate) fn from_parquet(
    file: File,
    channels: &Channels,
    attributes: &[String],
) -> Result<Table, String> {
    let columns = guarded(|| read(file).map_err(|error| error.to_string()))??;
    assemble(columns, channels, attributes)
}

fn write(table: &Table) -> Result<Vec<u8>, ParquetError> {
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

/// The cells of a column as they stand in the file.
enum Stored {
    Text(Vec<Option<String>>),
    Number(Vec<Option<f64>>),
    Count(Vec<Option<i64>>),
}

impl Stored {
    fn len(&self) -> usize {
        match self {
            Stored::Text(cells) => cells.len(),
            Stored::Number(cells) => cells.len(),
            Stored::Count(cells) => cells.len(),
        }
    }
}

fn read(file: File) -> Result<BTreeMap<String, Stored>, ParquetError> {
    let general = |text: &str| ParquetError::General(text.to_owned());
    let reader = SerializedFileReader::new(file)?;
    let metadata = reader.metadata();
    let rows = metadata.file_metadata().num_rows();
    let rows = u64::try_from(rows).map_err(|_| general("a negative number of rows"))?;
    if rows > limits::ROWS {
        return Err(general("more rows than are accepted"));
    }
    if metadata.num_row_groups() != 1 {
        return Err(general("expected one row group"));
    }
    let group = reader.get_row_group(0)?;
    let schema = metadata.file_metadata().schema_descr();
    let mut columns = BTreeMap::new();
    for (position, descriptor) in schema.columns().iter().enumerate() {
        if descriptor.max_def_level() != 1 || descriptor.max_rep_level() != 0 {
            return Err(general("expected flat optional columns"));
        }
        let stored = match group.get_column_reader(position)? {
            ColumnReader::DoubleColumnReader(column) => {
                Stored::Number(read_values(column, rows, Some)?)
            }
            ColumnReader::Int64ColumnReader(column) => {
                Stored::Count(read_values(column, rows, Some)?)
            }
            ColumnReader::ByteArrayColumnReader(column) => {
                Stored::Text(read_values(column, rows, |bytes: ByteArray| {
                    String::from_utf8(bytes.data().to_vec()).ok()
                })?)
            }
            _ => return Err(general("expected text, 64-bit numbers and counts")),
        };
        columns.insert(descriptor.name().to_owned(), stored);
    }
    Ok(columns)
}

fn read_values<T: DataType, V>(
    mut column: ColumnReaderImpl<T>,
    rows: u64,
    convert: impl Fn(T::T) -> Option<V>,
) -> Result<Vec<Option<V>>, ParquetError> {
    const BATCH: usize = 1 << 16;
    let mut cells = Vec::new();
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    while (cells.len() as u64) < rows {
        levels.clear();
        values.clear();
        let (records, _, _) = column.read_records(BATCH, Some(&mut levels), None, &mut values)?;
        if records == 0 {
            break;
        }
        let mut values = values.drain(..);
        for level in &levels {
            let cell = match level {
                0 => None,
                _ => {
                    let value = values.next().and_then(&convert);
                    Some(value.ok_or_else(|| {
                        ParquetError::General("a value is missing or no text".to_owned())
                    })?)
                }
            };
            cells.push(cell);
        }
    }
    if cells.len() as u64 != rows {
        return Err(ParquetError::General(
            "columns of different lengths".to_owned(),
        ));
    }
    Ok(cells)
}

/// Takes the columns of a file apart by name.
struct Columns(BTreeMap<String, Stored>);

impl Columns {
    fn text(&mut self, name: &str, row: usize) -> Result<Option<String>, String> {
        match self.0.get_mut(name) {
            None => Ok(None),
            Some(Stored::Text(cells)) => Ok(cells[row].take()),
            Some(_) => Err(format!("column `{name}` holds numbers, expected text")),
        }
    }

    fn number(&self, name: &str, row: usize) -> Result<Option<f64>, String> {
        match self.0.get(name) {
            None => Ok(None),
            Some(Stored::Number(cells)) => match cells[row] {
                Some(number) if !is_scorable(number) => Err(format!(
                    "column `{name}`, row {row}: {number:e} is no finite number up to {MAGNITUDE_MAX:.3e}"
                )),
                cell => Ok(cell),
            },
            Some(_) => Err(format!("column `{name}` holds no numbers")),
        }
    }

    fn count(&self, name: &str, row: usize) -> Result<Option<u32>, String> {
        match self.0.get(name) {
            None => Ok(None),
            Some(Stored::Count(cells)) => cells[row]
                .map(u32::try_from)
                .transpose()
                .map_err(|_| format!("column `{name}`, row {row}: out of range")),
            Some(_) => Err(format!("column `{name}` holds no counts")),
        }
    }
}

fn assemble(
    columns: BTreeMap<String, Stored>,
    channels: &Channels,
    attributes: &[String],
) -> Result<Table, String> {
    let rows = columns.values().map(Stored::len).max().unwrap_or(0);
    if rows > 0 {
        let missing = channels
            .iter()
            .find(|channel| !columns.contains_key(channel.name()));
        if let Some(channel) = missing {
            return Err(format!("no column `{channel}`"));
        }
    }
    // Before format 1.2 a lab could give this name to a column of its own.
    let is_own_limit = attributes.iter().any(|name| name == "limited_by");
    let mut columns = Columns(columns);
    let mut table = Table::new(channels.clone(), attributes.to_vec());
    for row in 0..rows {
        let limit = match is_own_limit {
            true => None,
            false => columns.text("limited_by", row)?,
        };
        let frame = columns.text("frame", row)?;
        let digest = columns.text("frame_sha256", row)?;
        table.push(Row {
            sample: columns
                .text("sample", row)?
                .ok_or_else(|| format!("row {row} has no sample name"))?,
            point_id: columns.text("point_id", row)?,
            unit_id: columns.text("unit_id", row)?,
            scene: columns.text("scene", row)?,
            depth_step: columns.count("depth_step", row)?,
            repeat: columns.count("repeat", row)?,
            phase: known(columns.text("phase", row)?, Phase::from_name)
                .ok_or_else(|| format!("row {row}: no such phase"))?,
            limited_by: known(limit, Limit::from_name)
                .ok_or_else(|| format!("row {row}: no such limit"))?,
            part: columns.text("part", row)?,
            t_s: columns.number("t_s", row)?,
            kind: known(columns.text("kind", row)?, GratingKind::from_name)
                .ok_or_else(|| format!("row {row}: no such kind of grating"))?,
            spacing: columns
                .number("spacing_mm", row)?
                .map(|length| {
                    Nanometre::from_millimetres(length)
                        .ok_or_else(|| format!("row {row}: {length} mm is no spacing"))
                })
                .transpose()?,
            intensity: columns.number("intensity", row)?,
            truth: channels
                .iter()
                .map(|channel| columns.number(channel.name(), row))
                .collect::<Result<_, _>>()?,
            attributes: attributes
                .iter()
                .map(|name| columns.text(name, row))
                .collect::<Result<_, _>>()?,
            frame: frame_entry(row, frame, digest)?,
        });
    }
    Ok(table)
}

/// What a name in a cell says; `None` of a name that says nothing here.
fn known<T>(name: Option<String>, of: impl Fn(&str) -> Option<T>) -> Option<Option<T>> {
    name.map_or(Some(None), |name| of(&name).map(Some))
}

fn frame_entry(
    row: usize,
    path: Option<String>,
    digest: Option<String>,
) -> Result<Option<FrameEntry>, String> {
    match (path, digest) {
        (None, None) => Ok(None),
        (Some(path), Some(digest)) => {
            let digest: Digest = digest
                .parse()
                .map_err(|error| format!("row {row}: {error}"))?;
            Ok(Some(FrameEntry::at(path, digest)))
        }
        _ => Err(format!(
            "row {row} has a frame without digest or a digest without frame"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Seek, SeekFrom, Write};
    use taceva_core::Channel;

    fn table(rows: u8) -> Table {
        let channels = Channels::new([Channel::FZ, Channel::PZ]).expect("distinct");
        let mut table = Table::new(channels, vec!["video".to_owned()]);
        for row in 0..rows {
            let is_even = row % 2 == 0;
            table.push(Row {
                sample: format!("sample {row}"),
                point_id: is_even.then(|| format!("p{}", row / 4)),
                repeat: Some(u32::MAX - u32::from(row)),
                phase: is_even.then_some(Phase::Load),
                limited_by: (row == 4).then_some(Limit::NormalForce),
                t_s: Some(1.7e9 + f64::from(row)),
                kind: is_even.then_some(GratingKind::Dot),
                spacing: Some(Nanometre(350_000 + i64::from(row))),
                intensity: is_even.then_some(107.3),
                truth: vec![is_even.then_some(-0.0), Some(f64::from(row) / 3.0)],
                attributes: vec![Some("ä,\"\n".to_owned()).filter(|_| is_even)],
                ..Row::default()
            });
        }
        table
    }

    fn read_back(bytes: &[u8], table: &Table) -> Result<Table, String> {
        let mut file = tempfile::tempfile().expect("a file");
        file.write_all(bytes).expect("written");
        file.seek(SeekFrom::Start(0)).expect("rewound");
        from_parquet(file, table.channels(), table.attribute_names())
    }

    #[test]
    fn a_table_reads_back_bit_for_bit() {
        for rows in [0, 1, 50] {
            let table = table(rows);
            let bytes = to_parquet(&table).expect("writes");
            let read = read_back(&bytes, &table).expect("reads");
            assert_eq!(read, table);
            assert_eq!(read.digest(), table.digest());
        }
    }

    #[test]
    fn the_same_table_gives_the_same_bytes() {
        assert_eq!(to_parquet(&table(9)), to_parquet(&table(9)));
    }

    #[test]
    fn damaged_files_reach_nobody_as_a_panic() {
        let table = table(50);
        let bytes = to_parquet(&table).expect("writes");
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << (at % 8);
            let _ = read_back(&damaged, &table);
            assert!(read_back(&bytes[..at], &table).is_err(), "cut at {at}");
        }
    }
}
