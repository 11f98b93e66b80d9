//! Export as a text table, with one file for each picture.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufWriter;
use std::num::NonZeroUsize;

use super::content::Exported;
use super::map::{self, Written, WrittenFrames, quoted};
use super::picture::{Encoded, Pictures};
use crate::error::ImportError;
use taceva_dataset::internal::{layout, ordered_map, staging::StagedFolder, write_durable};

/// File name of the table; rows are in the order of the dataset.
const TABLE: &str = "labels.csv";
/// Number of pictures per job that are written concurrently, because most of the time is spent waiting for the disk.
const PICTURES_A_JOB: NonZeroUsize = NonZeroUsize::new(4).expect("four");

pub(super) fn write(
    exported: &Exported<'_>,
    staged: &StagedFolder,
) -> Result<(Written, Vec<String>), ImportError> {
    let rows = exported.dataset.table().rows();
    let mut folders = Vec::new();
    let mut columns = Vec::new();
    let mut frames = Vec::new();
    for pictures in &exported.pictures {
        let view = pictures.view();
        let in_view = |path: &str| layout::in_view(view.as_deref(), path);
        let own = layout::frame_folders(0..rows).map(|folder| in_view(&folder));
        let above = [layout::FRAMES.to_owned(), in_view(layout::FRAMES)];
        for folder in above.into_iter().chain(own) {
            staged.ensure_folder(&folder)?;
            if !folders.contains(&folder) {
                folders.push(folder);
            }
        }
        let name = match view {
            None => "frame".to_owned(),
            Some(_) => exported.free_name(&pictures.named("frame")),
        };
        let reference = match pictures.reference()? {
            Some(picture) => Some(put(
                staged,
                in_view(&layout::reference_path(picture.extension)),
                &picture,
            )?),
            None => None,
        };
        frames.push(WrittenFrames {
            key: format!("column = {}", quoted(&name)),
            reference,
        });
        columns.push(PathColumn {
            name,
            paths: write_pictures(exported, pictures, staged)?,
        });
    }
    write_table(exported, staged, &columns)?;
    let signals = exported.dataset.header().signals.as_ref();
    let written = Written {
        table: quoted(TABLE),
        frames,
        signals: signals.map(|signals| {
            let names: Vec<String> = signals
                .spec
                .column_names()
                .map(|name| quoted(&name))
                .collect();
            format!("[{}]", names.join(", "))
        }),
        names: map::bare,
        channels: map::bare_channels(exported),
    };
    Ok((written, folders))
}

/// Column that names the pictures of a view.
struct PathColumn {
    name: String,
    /// Path of the picture of each row; empty for a row without a picture.
    paths: Vec<String>,
}

/// Writes one file for each picture. Returns the file names, which are empty for rows without a picture.
fn write_pictures(
    exported: &Exported<'_>,
    pictures: &Pictures<'_>,
    staged: &StagedFolder,
) -> Result<Vec<String>, ImportError> {
    let mut names = Vec::new();
    let view = pictures.view();
    let jobs = exported.jobs.saturating_mul(PICTURES_A_JOB);
    let work = |row: usize| match pictures.encoded(row)? {
        Some(picture) => {
            let path = layout::frame_path(row, picture.extension);
            put(staged, layout::in_view(view.as_deref(), &path), &picture)
        }
        None => Ok(String::new()),
    };
    ordered_map(
        exported.dataset.table().rows(),
        jobs,
        work,
        |_, name: Result<String, ImportError>| {
            names.push(name?);
            exported.advance(1)
        },
    )?;
    Ok(names)
}

fn put(staged: &StagedFolder, name: String, picture: &Encoded) -> Result<String, ImportError> {
    write_durable(&staged.path().join(&name), &picture.bytes)?;
    Ok(name)
}

fn write_table(
    exported: &Exported<'_>,
    staged: &StagedFolder,
    frames: &[PathColumn],
) -> Result<(), ImportError> {
    let path = staged.path().join(TABLE);
    let failed = |error: csv::Error| ImportError::io("write", &path)(error.into());
    let file = File::create_new(&path).map_err(ImportError::io("create", &path))?;
    let mut writer = csv::Writer::from_writer(BufWriter::new(file));
    let mut names: Vec<String> = exported
        .columns
        .iter()
        .map(|column| column.name.to_owned())
        .collect();
    names.extend(frames.iter().map(|column| column.name.clone()));
    let signals = exported.dataset.header().signals.iter();
    names.extend(signals.flat_map(|signals| signals.spec.column_names()));
    let mut known = BTreeSet::new();
    if let Some(name) = names.iter().find(|name| !known.insert(name.as_str())) {
        return Err(ImportError::request(
            exported.dataset.path(),
            format!(
                "a channel or attribute has the name `{name}` of a taxel column, and a table needs unique names: use --format huggingface"
            ),
        ));
    }
    writer.write_record(&names).map_err(failed)?;
    for row in 0..exported.dataset.table().rows() {
        let mut cells: Vec<String> = exported
            .columns
            .iter()
            .map(|column| column.cells.text(row).unwrap_or_default())
            .collect();
        cells.extend(frames.iter().map(|column| column.paths[row].clone()));
        cells.extend(exported.signals(row)?.into_iter().map(single));
        writer.write_record(&cells).map_err(failed)?;
        if frames.is_empty() {
            exported.advance(1)?;
        }
    }
    let file = writer.into_inner().map_err(|error| error.into_error());
    let file = file.map_err(ImportError::io("write", &path))?;
    let file = file.into_inner().map_err(|error| error.into_error());
    file.and_then(|file| file.sync_all())
        .map_err(ImportError::io("make durable", &path))
}

/// Shortest text that gives the same `f32` when parsed as `f64` and rounded.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the comparison tests this rounding"
)]
fn single(value: f32) -> String {
    let text = format!("{value:?}");
    let back = text.parse::<f64>().map(|wide| (wide as f32).to_bits());
    match back == Ok(value.to_bits()) {
        true => text,
        false => format!("{:?}", f64::from(value)),
    }
}
