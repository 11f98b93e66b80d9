//! Tests of folders that could give wrong numbers, or a wrong rejection. Each must be imported correctly, rejected with the remedy, or give a warning.

mod angles;
#[cfg(target_os = "linux")]
mod bounded;
mod clips;
mod contact_points;
mod converters;
mod coordinate_frames;
mod distant_times;
mod draft_joins;
mod drafts;
mod held;
mod lags;
mod mean_pictures;
mod numbers;
mod packages;
mod picture_numbers;
mod stamps;
mod takes;
mod taxels;
mod text_forms;
mod times;
mod units;
mod zeros;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan, ImportSummary, ImportWarning, MapDraft};
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

use crate::extended_maps::lab;

const FACTS: &str = "[sensor]\nmodel = \"drawn gel\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n";
const NO_TIME: &str = "[time]\nclock = \"unknown\"\n";

/// Generated folder of `tests/cases`.
fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/cases")
        .join(name)
}

/// Text of the map of the generated folder `name`.
fn map_of(name: &str) -> String {
    std::fs::read_to_string(case(name).join("map.toml")).expect("it is there")
}

/// Folder with a Parquet file `name` of `columns`, whose cells are texts or numbers.
fn parquet_lab(name: &str, columns: &[&str], rows: &[Vec<Cell>]) -> tempfile::TempDir {
    let folder = lab(&[]);
    let kinds = rows[0].iter().map(|cell| match cell {
        Cell::Text(_) => WrittenKind::Text,
        _ => WrittenKind::Number,
    });
    let columns = columns.iter().zip(kinds);
    let columns: Vec<WrittenColumn> = columns
        .map(|(name, kind)| WrittenColumn::new(*name, kind))
        .collect();
    let path = folder.path().join(name);
    let mut writer = ParquetWriter::create(&path, &columns, &[]).expect("made");
    for row in rows {
        writer.push(row.clone()).expect("written");
    }
    writer.finish().expect("written");
    folder
}

/// Plan of an import by a complete map.
fn planned(folder: &Path, map: &str) -> Result<ImportPlan, String> {
    let map = ImportMap::parse("map.toml".as_ref(), map).map_err(|error| error.to_string())?;
    ImportPlan::new(folder, &map).map_err(|error| error.to_string())
}

/// Plan of an import by `map`, to which the version and the section of the sensor are added.
fn planned_with(folder: &Path, map: &str) -> Result<ImportPlan, String> {
    planned(folder, &format!("map_version = 2\n{map}{FACTS}"))
}

fn summary(folder: &Path, map: &str) -> ImportSummary {
    let plan = planned(folder, map).unwrap_or_else(|problem| panic!("{problem}\n{map}"));
    plan.summary().clone()
}

/// Codes of the warnings in `summary`.
fn codes(summary: &ImportSummary) -> Vec<&'static str> {
    summary.warnings.iter().map(ImportWarning::code).collect()
}

/// Numbers of a column after an import.
fn imported(folder: &Path, map: &str, column: &str) -> Vec<f64> {
    let plan = planned(folder, map).unwrap_or_else(|problem| panic!("{problem}\n{map}"));
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let cells = dataset.table().as_text(column).expect("a column");
    let numbers = cells.into_iter().flatten();
    numbers
        .map(|cell| cell.parse().expect("a number"))
        .collect()
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-4, "{found} for {expected}");
}

fn draft(folder: &Path) -> String {
    let draft = MapDraft::of(folder).expect("a draft");
    draft.text().to_owned()
}

/// First line of a draft that begins with `start`.
fn line<'d>(draft: &'d str, start: &str) -> &'d str {
    let mut lines = draft.lines();
    lines
        .find(|line| line.starts_with(start))
        .unwrap_or_default()
}
