//! A dataset as Hugging Face writes one: Parquet whose column `image` holds the pictures.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use serde_json::{Map, Value, json};
use taceva_core::Progress;

use crate::dataset::Dataset;
use crate::decode::ChannelOrder;
use crate::encode::encode_png;
use crate::error::DatasetError;
use crate::samples::{field, properties, units, write_column, write_values};
use crate::staged::{Place, StagedFolder};
use crate::table::{Cells, NamedColumn};

/// Rows of a row group: the pictures of so many are in memory.
const GROUP_ROWS: usize = 100;
/// A picture that is there is below two optional levels.
const PICTURE_LEVEL: i16 = 2;
/// Where the file lies in the folder.
const FILE: &str = "data/train-00000-of-00001.parquet";

/// Writes `dataset` to the new folder `target`: `data/train-00000-of-00001.parquet`, a row a sample, bare channel names in the units of the
/// metadata (`unit.Fz`), pictures as the bytes of PNG or JPEG files in `image`; and a `README.md` that says what it is.
///
/// Colours are red, green, blue whatever order the dataset keeps: pictures kept in blue, green, red are written anew as PNG, and so are those
/// that a recording keeps as differences. All others keep their bytes.
///
/// # Errors
/// [`DatasetError::TargetExists`]; [`DatasetError::Image`] and [`DatasetError::Digest`] of a picture that is damaged;
/// [`DatasetError::Cancelled`]; [`DatasetError::Io`]. After any of them `target` is absent.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
/// # use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source, export_hugging_face};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// # let sample = Sample::new("0").with_truth(Readings::from_values([0.5]));
/// # recorder.append(&sample.with_frame(Frame::new(info, vec![7, 90])?))?;
/// # recorder.close()?;
/// let exported = folder.path().join("exported");
/// export_hugging_face(&Dataset::open(&path)?, &exported, &taceva_core::SilentProgress)?;
/// assert!(exported.join("data/train-00000-of-00001.parquet").is_file());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn export_hugging_face(
    dataset: &Dataset,
    target: &Path,
    progress: &dyn Progress,
) -> Result<(), DatasetError> {
    let staged = StagedFolder::create(target, Place::Free)?;
    staged.create_folder("data")?;
    let path = staged.path().join(FILE);
    let rows = dataset.table().rows();
    progress.begin("export samples", Some(rows as u64));
    let written = write(dataset, &path, progress);
    progress.end();
    written?;
    let card = staged.path().join("README.md");
    crate::file::write_durable(&card, card_of(dataset).as_bytes())?;
    staged.put_in_place(&["data".to_owned()])
}

fn write(dataset: &Dataset, path: &Path, progress: &dyn Progress) -> Result<(), DatasetError> {
    let broken = |error: ParquetError| DatasetError::Damaged {
        path: path.to_owned(),
        problem: error.to_string(),
    };
    let table = dataset.table();
    let has_pictures = table.frames().iter().any(Option::is_some);
    let mut columns = table.columns();
    columns.retain(|column| !matches!(column.cells, Cells::FramePath(_) | Cells::FrameDigest(_)));
    let mut metadata = units(table);
    metadata.push(KeyValue::new(
        "huggingface".to_owned(),
        features(&columns, has_pictures).to_string(),
    ));
    let source = format!("{:?}", dataset.header().source).to_lowercase();
    metadata.push(KeyValue::new("taceva.source".to_owned(), source));
    let schema = schema(&columns, has_pictures).map_err(broken)?;
    let file = File::create_new(path).map_err(DatasetError::io("create", path))?;
    let mut writer =
        SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties(metadata)))
            .map_err(broken)?;
    for first in (0..table.rows()).step_by(GROUP_ROWS) {
        let rows = first..table.rows().min(first + GROUP_ROWS);
        let mut group = writer.next_row_group().map_err(broken)?;
        for column in &columns {
            write_column(&mut group, &column.cells, rows.clone()).map_err(broken)?;
        }
        if has_pictures {
            let pictures: Result<Vec<Option<Vec<u8>>>, DatasetError> =
                rows.clone().map(|row| picture(dataset, row)).collect();
            let bytes = pictures?
                .into_iter()
                .map(|bytes| bytes.map(ByteArray::from));
            write_values::<ByteArrayType, File>(&mut group, bytes, PICTURE_LEVEL)
                .map_err(broken)?;
            let name = |row: usize| {
                Some(format!(
                    "{}.{}",
                    table.samples()[row],
                    ending(dataset, row)?
                ))
            };
            let names = rows
                .clone()
                .map(|row| name(row).map(|name| ByteArray::from(name.into_bytes())));
            write_values::<ByteArrayType, File>(&mut group, names, PICTURE_LEVEL)
                .map_err(broken)?;
        }
        group.close().map_err(broken)?;
        progress.advance(rows.len() as u64);
        if progress.is_cancelled() {
            return Err(DatasetError::Cancelled);
        }
    }
    let file = writer.into_inner().map_err(broken)?;
    file.sync_all()
        .map_err(DatasetError::io("make durable", path))
}

/// The bytes of the picture of a row, red, green and blue in this order.
fn picture(dataset: &Dataset, row: usize) -> Result<Option<Vec<u8>>, DatasetError> {
    let Some(entry) = &dataset.table().frames()[row] else {
        return Ok(None);
    };
    if !is_written_anew(dataset, row) {
        return dataset.frame_bytes(entry).map(Some);
    }
    let Some(frame) = dataset.frame(row)? else {
        return Ok(None);
    };
    let bytes = encode_png(&frame).map_err(|problem| DatasetError::Image {
        place: None,
        path: dataset.path().join(&entry.path),
        problem,
    })?;
    Ok(Some(bytes))
}

fn is_written_anew(dataset: &Dataset, row: usize) -> bool {
    let order = dataset
        .header()
        .frames
        .as_ref()
        .map(|frames| frames.channel_order);
    let entry = dataset.table().frames()[row].as_ref();
    order == Some(ChannelOrder::Bgr) || entry.is_some_and(|entry| entry.is_difference())
}

/// What the name of a picture ends with.
fn ending(dataset: &Dataset, row: usize) -> Option<&'static str> {
    let entry = dataset.table().frames()[row].as_ref()?;
    let is_jpeg = [".jpg", ".jpeg"]
        .iter()
        .any(|ending| entry.path.to_ascii_lowercase().ends_with(ending));
    Some(if is_jpeg && !is_written_anew(dataset, row) {
        "jpg"
    } else {
        "png"
    })
}

fn schema(columns: &[NamedColumn<'_>], has_pictures: bool) -> Result<Type, ParquetError> {
    let fields: Result<Vec<_>, ParquetError> = columns
        .iter()
        .map(|column| field(column).map(Arc::new))
        .collect();
    let mut fields = fields?;
    if has_pictures {
        let leaf = |name: &str, logical: Option<LogicalType>| {
            let leaf = Type::primitive_type_builder(name, PhysicalType::BYTE_ARRAY);
            leaf.with_repetition(Repetition::OPTIONAL)
                .with_logical_type(logical)
                .build()
                .map(Arc::new)
        };
        let image = Type::group_type_builder("image")
            .with_repetition(Repetition::OPTIONAL)
            .with_fields(vec![
                leaf("bytes", None)?,
                leaf("path", Some(LogicalType::String))?,
            ])
            .build()?;
        fields.push(Arc::new(image));
    }
    Type::group_type_builder("schema")
        .with_fields(fields)
        .build()
}

/// What the columns are, as the library `datasets` reads it.
fn features(columns: &[NamedColumn<'_>], has_pictures: bool) -> Value {
    let mut features = Map::new();
    for column in columns {
        let dtype = match column.cells {
            Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => "float64",
            Cells::Count(_) => "int64",
            _ => "string",
        };
        features.insert(
            column.name.to_owned(),
            json!({ "dtype": dtype, "_type": "Value" }),
        );
    }
    if has_pictures {
        features.insert("image".to_owned(), json!({ "_type": "Image" }));
    }
    json!({ "info": { "features": features } })
}

/// What stands beside the data: the sensor, the units, and whether anything was measured.
fn card_of(dataset: &Dataset) -> String {
    let header = dataset.header();
    let mut card = format!(
        "# {}\n\nSamples: {}. Source: {:?}. Exported from the dataset {}.\n\n| column | unit |\n|---|---|\n",
        header.sensor.model,
        dataset.table().rows(),
        header.source,
        dataset.digest()
    );
    for channel in dataset.table().channels() {
        card += &format!("| {} | {} |\n", channel.name(), channel.unit().symbol());
    }
    card
}
