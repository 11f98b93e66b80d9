//! Export as an HDF5 file: one contiguous array for each column, and the pictures as one array of pixels.

use taceva_arrays::{Hdf5Writer, WrittenElement};
use taceva_core::PixelFormat;

use super::cells::of_arrays;
use super::content::Exported;
use super::map::{self, Written, WrittenFrames, quoted};
use super::picture::Pictures;
use crate::error::ImportError;
use taceva_dataset::DatasetError;
use taceva_dataset::internal::{Cells, staging::StagedFolder};

const FILE: &str = "recording.h5";
/// Maximum length of a text, bytes. Each text of an array takes the space of the longest text.
const TEXT_BYTES: usize = 4096;

pub(super) fn write(
    exported: &Exported<'_>,
    staged: &StagedFolder,
) -> Result<(Written, Vec<String>), ImportError> {
    let dataset = exported.dataset;
    let header = dataset.header();
    let rows = dataset.table().rows();
    let mut writer = Hdf5Writer::create(&staged.path().join(FILE)).map_err(of_arrays)?;
    for column in &exported.columns {
        write_column(exported, &mut writer, column.name, &column.cells)?;
    }
    let taxels = header
        .signals
        .as_ref()
        .map(|_| exported.free_name("signals"));
    if let (Some(name), Some(signals)) = (&taxels, &header.signals) {
        let info = signals.spec.info;
        let sides = [info.rows, info.columns, info.channels].map(u64::from);
        let shape = [rows as u64, sides[0], sides[1], sides[2]];
        let names = signals.spec.channels.join(" ");
        let attributes = [
            ("unit", info.unit.symbol()),
            ("channels", &names),
            ("axes", "sample row column channel"),
        ];
        writer
            .begin(name, WrittenElement::F32, &shape, &attributes)
            .map_err(of_arrays)?;
        for row in 0..rows {
            let numbers = exported.signals(row)?;
            let bytes: Vec<u8> = numbers
                .iter()
                .flat_map(|number| number.to_le_bytes())
                .collect();
            writer.write(&bytes).map_err(of_arrays)?;
        }
    }
    let mut frames = Vec::new();
    for pictures in &exported.pictures {
        let name = exported.free_name(&pictures.named("frames"));
        write_frames(exported, pictures, &mut writer, &name)?;
        frames.push(WrittenFrames {
            key: format!("array = {}", quoted(&name)),
            reference: exported.write_reference(staged, pictures)?,
        });
    }
    if exported.pictures.is_empty() {
        exported.advance(rows)?;
    }
    let source = format!("{:?}", header.source).to_lowercase();
    let (clock, digest) = (header.clock.to_string(), dataset.digest().to_string());
    let sensor = &header.sensor;
    let traced: Vec<String> = { header.traceability.iter() }
        .map(ToString::to_string)
        .collect();
    let traced = traced.join("; ");
    let mut attributes = vec![
        ("source", source.as_str()),
        ("clock", clock.as_str()),
        ("sensor", sensor.model.as_str()),
        ("serial", sensor.serial.as_str()),
        ("gel", sensor.gel.as_str()),
        ("dataset", digest.as_str()),
    ];
    if !traced.is_empty() {
        attributes.push(("traceability", traced.as_str()));
    }
    writer.finish(&attributes).map_err(of_arrays)?;
    let written = Written {
        table: quoted(FILE),
        frames,
        signals: taxels.map(|name| {
            format!(
                "{{ file = {}, path = {} }}",
                quoted(FILE),
                quoted(&format!("/{name}"))
            )
        }),
        names: map::bare,
        channels: map::bare_channels(exported),
    };
    Ok((written, Vec::new()))
}

/// Writes a column as an array. Missing numbers become NaN, and missing texts become empty.
fn write_column(
    exported: &Exported<'_>,
    writer: &mut Hdf5Writer,
    name: &str,
    cells: &Cells<'_>,
) -> Result<(), ImportError> {
    let rows = exported.dataset.table().rows();
    let shape = [rows as u64];
    let unit = exported.dataset.table().channels().by_name(name);
    let unit = unit.map(|channel| channel.unit().symbol()).or(match cells {
        Cells::Spacing(_) => Some("mm"),
        Cells::Measured(_) if name == "t_s" => Some("s"),
        Cells::Measured(_) if name == "zero_u_mm" => Some("mm"),
        _ => None,
    });
    let attributes: Vec<(&str, &str)> = unit.map(|unit| ("unit", unit)).into_iter().collect();
    match cells {
        Cells::Count(counts) if counts.iter().all(Option::is_some) => {
            writer
                .begin(name, WrittenElement::I64, &shape, &attributes)
                .map_err(of_arrays)?;
            for count in counts.iter().flatten() {
                writer
                    .write(&i64::from(*count).to_le_bytes())
                    .map_err(of_arrays)?;
            }
        }
        Cells::Count(_) | Cells::Number(_) | Cells::Measured(_) | Cells::Spacing(_) => {
            writer
                .begin(name, WrittenElement::F64, &shape, &attributes)
                .map_err(of_arrays)?;
            for row in 0..rows {
                let number = match cells {
                    Cells::Count(counts) => counts[row].map(f64::from),
                    cells => cells.number(row),
                };
                writer
                    .write(&number.unwrap_or(f64::NAN).to_le_bytes())
                    .map_err(of_arrays)?;
            }
        }
        _ => {
            let texts = (0..rows).map(|row| cells.text(row).unwrap_or_default());
            let longest = texts
                .clone()
                .map(|text| text.len())
                .max()
                .unwrap_or(0)
                .max(1);
            let bytes = u32::try_from(longest).unwrap_or(u32::MAX);
            for (row, text) in texts.clone().enumerate() {
                check_text(exported, row, name, &text)?;
            }
            writer
                .begin(name, WrittenElement::Text { bytes }, &shape, &attributes)
                .map_err(of_arrays)?;
            for text in texts {
                let mut padded = text.into_bytes();
                padded.resize(longest, 0);
                writer.write(&padded).map_err(of_arrays)?;
            }
        }
    }
    Ok(())
}

fn check_text(
    exported: &Exported<'_>,
    row: usize,
    name: &str,
    text: &str,
) -> Result<(), ImportError> {
    let problem = if text.len() > TEXT_BYTES {
        format!(
            "`{name}` has {} bytes, expected at most {TEXT_BYTES}, since all strings of an HDF5 array are as long as the longest: use --format huggingface or csv",
            text.len()
        )
    } else if text.contains('\0') {
        format!("`{name}` contains a NUL character, which ends a string in HDF5: remove it")
    } else {
        return Ok(());
    };
    Err(DatasetError::sample(&exported.dataset.table().samples()[row], problem).into())
}

/// Writes the pixels of every picture, row by row.
fn write_frames(
    exported: &Exported<'_>,
    pictures: &Pictures<'_>,
    writer: &mut Hdf5Writer,
    name: &str,
) -> Result<(), ImportError> {
    let rows = exported.dataset.table().rows();
    let Some(info) = pictures.info() else {
        return Ok(());
    };
    let element = match info.format {
        PixelFormat::Gray16 | PixelFormat::Rgb16 => WrittenElement::U16,
        _ => WrittenElement::U8,
    };
    let mut shape = vec![rows as u64, info.height.into(), info.width.into()];
    let is_gray = info.format.samples() == 1;
    let order = match is_gray {
        true => "gray",
        false => {
            shape.push(info.format.samples() as u64);
            "rgb"
        }
    };
    let axes = if is_gray {
        "sample row column"
    } else {
        "sample row column colour"
    };
    writer
        .begin(name, element, &shape, &[("colours", order), ("axes", axes)])
        .map_err(of_arrays)?;
    for row in 0..rows {
        writer
            .write(pictures.frame(row)?.bytes())
            .map_err(of_arrays)?;
        exported.advance(1)?;
    }
    Ok(())
}
