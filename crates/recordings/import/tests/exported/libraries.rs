//! Tests that read exports with external libraries: csv of Python and Pillow, `datasets` of Hugging Face, h5py, pyarrow, LeRobot.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;
use taceva_dataset::{Dataset, Digest};
use taceva_import::ExportForm;
use taceva_needs::{Need, skip};

use super::drawn::{exported, imported, recorded, skin};

/// Python interpreter with the libraries that `.ci/install` installs.
const INSTALLED: &str = "../../../target/libraries/bin/python";

/// Content that a library read.
#[derive(Deserialize)]
struct ReadBack {
    columns: BTreeMap<String, Vec<Option<String>>>,
    pictures: Vec<Option<String>>,
    signals: Vec<Vec<String>>,
}

/// Path of a Python interpreter that has `module`. Otherwise `None`, and the skip is reported.
fn python(variable: &str, (need, module): (Need, &str)) -> Option<PathBuf> {
    let named = std::env::var_os(variable).map(PathBuf::from);
    let installed = Path::new(env!("CARGO_MANIFEST_DIR")).join(INSTALLED);
    let found = named.unwrap_or(match installed.exists() {
        true => installed,
        false => PathBuf::from("python3"),
    });
    let imported = Command::new(&found)
        .args(["-c", &format!("import {module}")])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    if imported.is_ok_and(|status| status.success()) {
        return Some(found);
    }
    skip(
        need,
        format!("{} has no module `{module}`", found.display()),
    );
    None
}

fn libraries() -> Option<PathBuf> {
    python(
        "TACEVA_LIBRARIES",
        (Need::Libraries, "datasets, h5py, pandas, PIL, pyarrow"),
    )
}

/// Content of `folder` as read by the library of `form`.
fn read_back(python: &Path, form: &str, folder: &Path) -> ReadBack {
    let home = folder.with_extension("home");
    let output = Command::new(python)
        .args(["-c", include_str!("read_back.py"), form])
        .arg(folder)
        // No network requests, and no files in the home of the user.
        .envs([
            ("HF_HUB_OFFLINE", "1"),
            ("HF_DATASETS_OFFLINE", "1"),
            ("HF_HUB_DISABLE_TELEMETRY", "1"),
        ])
        .env("HF_HOME", home)
        .stdin(Stdio::null())
        .output()
        .expect("the interpreter that was just tried");
    let (said, errors) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    assert!(output.status.success(), "{form}: {said}\n{errors}");
    let line = said.lines().find_map(|line| line.strip_prefix("= "));
    serde_json::from_str(line.expect("a line")).expect("JSON")
}

/// True if `found` equals `expected`: the same text, or numbers with the same bits in double precision, or in single precision if `is_single`.
fn is_same(found: Option<&str>, expected: Option<&str>, is_single: bool) -> bool {
    let (Some(found), Some(expected)) = (found, expected) else {
        return found == expected;
    };
    let numbers = (found.parse::<f64>(), expected.parse::<f64>());
    match numbers {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "single precision is asked for"
        )]
        (Ok(found), Ok(expected)) if is_single => {
            (found as f32).to_bits() == (expected as f32).to_bits()
        }
        (Ok(found), Ok(expected)) => found.to_bits() == expected.to_bits(),
        _ => found == expected,
    }
}

/// Compares every label, taxel value and pixel with the export as `reader` reads it.
#[track_caller]
fn is_read(python: &Path, dataset: &Dataset, (form, reader): (ExportForm, &str)) -> ReadBack {
    let folder = dataset.path().with_extension(form.name());
    let folder = match folder.exists() {
        true => folder,
        false => exported(dataset, form).0,
    };
    let read = read_back(python, reader, &folder);
    let table = dataset.table();
    let mut names: Vec<&str> = [
        "sample",
        "point_id",
        "scene",
        "depth_step",
        "repeat",
        "phase",
        "limited_by",
        "zero_u_mm",
        "part",
        "kind",
        "spacing_mm",
        "t_s",
        "source_table",
        "source_row",
        "source_frame",
    ]
    .to_vec();
    names.extend(table.channels().iter().map(|channel| channel.name()));
    names.extend(table.attribute_names().iter().map(String::as_str));
    let is_single = reader == "lerobot";
    let mut compared = 0;
    for name in names {
        let Some(expected) = table.as_text(name) else {
            continue;
        };
        let is_attribute = table.attribute(name).is_some() && form == ExportForm::LeRobot;
        let there = if is_attribute {
            format!("attribute.{name}")
        } else {
            name.to_owned()
        };
        let found = read
            .columns
            .get(&there)
            .unwrap_or_else(|| panic!("{reader}: no `{there}`"));
        assert_eq!(found.len(), expected.len(), "{reader}: {name}");
        for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let same = is_same(found.as_deref(), expected.as_deref(), is_single);
            assert!(
                same,
                "{reader}: {name}, row {row}: {found:?}, expected {expected:?}"
            );
            compared += 1;
        }
    }
    assert!(compared > table.rows());
    let pictures = table.frames().iter().flatten().count();
    assert_eq!(read.pictures.len(), pictures, "{reader}");
    for (row, found) in read.pictures.iter().enumerate() {
        let frame = dataset.frame(row).expect("read").expect("a picture");
        let of = Digest::of(frame.bytes()).to_string();
        let expected = of.rsplit(':').next().map(str::to_owned);
        // JPEG decoders differ by a few levels, and BGR pictures keep their bytes beside a table.
        if form != ExportForm::Csv || dataset.header().attributes.is_empty() {
            assert_eq!(*found, expected, "{reader}: picture {row}");
        }
    }
    if dataset.header().signals.is_some() {
        assert_eq!(read.signals.len(), table.rows(), "{reader}");
        for (row, found) in read.signals.iter().enumerate() {
            let signals = dataset.signals(row).expect("read").expect("signals");
            #[expect(
                clippy::cast_possible_truncation,
                reason = "they are of single precision"
            )]
            let found: Vec<f32> = found
                .iter()
                .map(|text| text.parse::<f64>().expect("a number") as f32)
                .collect();
            assert_eq!(found, signals.values(), "{reader}: row {row}");
        }
    }
    read
}

#[test]
fn each_form_is_read_by_the_libraries_that_it_is_for() {
    let Some(python) = libraries() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    for dataset in [
        recorded(folder.path()),
        skin(folder.path()),
        imported(folder.path()),
    ] {
        is_read(&python, &dataset, (ExportForm::Csv, "csv"));
        is_read(&python, &dataset, (ExportForm::HuggingFace, "huggingface"));
        let arrays = is_read(&python, &dataset, (ExportForm::Hdf5, "hdf5"));
        assert_eq!(arrays.columns["Fz@unit"], [Some("N".to_owned())]);
        for (column, unit) in [("t_s", "s"), ("zero_u_mm", "mm"), ("intensity", "")] {
            let units = arrays.columns.get(&format!("{column}@unit"));
            let found = units.and_then(|units| units[0].as_deref());
            assert!(
                found.is_none_or(|found| found == unit),
                "{column}: {found:?}"
            );
        }
        is_read(&python, &dataset, (ExportForm::LeRobot, "layout"));
    }
}

#[test]
fn lerobot_itself_reads_its_form_with_a_press_as_an_episode() {
    let Some(python) = python(
        "TACEVA_LEROBOT",
        (Need::Lerobot, "lerobot.datasets.lerobot_dataset"),
    ) else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = recorded(folder.path());
    let read = is_read(&python, &dataset, (ExportForm::LeRobot, "lerobot"));
    // Two repeats of ten rows at 51.5 points, and the scene changes within one of them.
    assert_eq!(read.columns["@episodes"], [Some("103".to_owned())]);
    is_read(
        &python,
        &skin(folder.path()),
        (ExportForm::LeRobot, "lerobot"),
    );
    is_read(
        &python,
        &imported(folder.path()),
        (ExportForm::LeRobot, "lerobot"),
    );
}
