//! The recordings of `tests/recordings`, written by the libraries of other people, imported by their maps: counts, labels, pixels and packets
//! are those that the library that wrote them reads back.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use serde_json::Value;
use sha2::{Digest, Sha256};
use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, ImportMap, ImportPlan, Table};

/// What check names of labels stand under other names in a dataset, or are read from elsewhere.
const ELSEWHERE: [&str; 3] = ["frame", "t_s", "file"];
/// Of these the digests are by the row of the main table.
const BY_SOURCE_ROW: [&str; 3] = ["join-time", "join-key", "taxels-csv"];

fn folder(name: &str) -> PathBuf {
    let recordings = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/recordings");
    Path::new(recordings).join(name)
}

/// Imports the recording into `target`.
fn import(name: &str, target: &Path) -> Result<(), String> {
    let folder = folder(name);
    let map = ImportMap::read(&folder.join("map.toml")).map_err(|error| error.to_string())?;
    let plan = ImportPlan::new(&folder, &map).map_err(|error| error.to_string())?;
    let threads = NonZeroUsize::new(2).expect("two");
    let report = plan.run(target, threads, &SilentProgress);
    report.map(drop).map_err(|error| error.to_string())
}

/// What of the recording is not as its `expected.json` says.
fn differences(name: &str) -> Vec<String> {
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    if let Err(problem) = import(name, &target) {
        return vec![problem];
    }
    let dataset = Dataset::open(&target).expect("a dataset");
    let text = std::fs::read_to_string(folder(name).join("expected.json")).expect("it is there");
    let expected: Value = serde_json::from_str(&text).expect("JSON");
    let expected = Expected {
        expected: &expected,
        table: dataset.table(),
        dataset: &target,
        is_luma: std::fs::read_to_string(folder(name).join("map.toml"))
            .expect("it is there")
            .contains("channel_order = \"gray\""),
        rows: rows(name, dataset.table()),
    };
    [
        expected.count(),
        expected.labels(),
        expected.pixels(),
        expected.packets(),
    ]
    .concat()
}

/// The row of the dataset that each key of `expected.json` means.
fn rows(name: &str, table: &Table) -> BTreeMap<String, usize> {
    let key = |row: usize| match BY_SOURCE_ROW.contains(&name) {
        true => table.source_row()[row]
            .expect("kept by maps of version 2")
            .to_string(),
        false => row.to_string(),
    };
    (0..table.rows()).map(|row| (key(row), row)).collect()
}

struct Expected<'a> {
    expected: &'a Value,
    table: &'a Table,
    dataset: &'a Path,
    is_luma: bool,
    rows: BTreeMap<String, usize>,
}

impl Expected<'_> {
    fn count(&self) -> Vec<String> {
        let expected = self.expected["count"].as_u64();
        match Some(self.table.rows() as u64) == expected {
            true => Vec::new(),
            false => vec![format!("{} samples for {expected:?}", self.table.rows())],
        }
    }

    fn labels(&self) -> Vec<String> {
        let mut wrong = Vec::new();
        for (key, labels) in self.expected["labels"].as_object().into_iter().flatten() {
            let row = self.rows[key];
            for (name, value) in labels.as_object().into_iter().flatten() {
                if ELSEWHERE.contains(&name.as_str()) {
                    continue;
                }
                let column = if name == "unit" { "unit_id" } else { name };
                let cells = self.table.as_text(column).expect(column);
                let cell = cells[row].clone().unwrap_or_default();
                let is_right = match value.as_f64() {
                    // Torques are kept in N·mm.
                    Some(number) if value.is_f64() => {
                        let number = if name.starts_with('T') {
                            number * 1e3
                        } else {
                            number
                        };
                        let found: f64 = cell.parse().unwrap_or(f64::NAN);
                        (found - number).abs() <= 1e-9 * number.abs().max(1.0)
                    }
                    Some(number) => cell.parse() == Ok(number),
                    None => Some(cell.as_str()) == value.as_str(),
                };
                if !is_right {
                    wrong.push(format!("{key}.{name}: {cell} for {value}"));
                }
            }
        }
        wrong
    }

    fn pixels(&self) -> Vec<String> {
        let mut wrong = Vec::new();
        let is_exact = self.expected["pixels_exact"].as_bool() == Some(true);
        for (key, digest) in self.expected["frames_sha256"]
            .as_object()
            .into_iter()
            .flatten()
        {
            let luma = &self.expected["luma_sha256"];
            let digest = match self.is_luma && luma.is_object() {
                false if !is_exact => continue,
                false => digest,
                true => {
                    let frame = &self.expected["labels"][key]["frame"];
                    &luma[frame
                        .as_u64()
                        .map_or(key.clone(), |frame| frame.to_string())]
                }
            };
            let picture = image::open(self.file(key)).expect("a picture");
            if Some(hex(picture.as_bytes()).as_str()) != digest.as_str() {
                wrong.push(format!("pixels of {key}"));
            }
        }
        wrong
    }

    /// Encoded pictures are kept byte for byte.
    fn packets(&self) -> Vec<String> {
        let packets = self.expected["packets_sha256"].as_object();
        let wrong = packets.into_iter().flatten().filter(|(key, digest)| {
            let bytes = std::fs::read(self.file(key)).expect("a file");
            Some(hex(&bytes).as_str()) != digest.as_str()
        });
        wrong
            .map(|(key, _)| format!("the packet of {key} was changed"))
            .collect()
    }

    fn file(&self, key: &str) -> PathBuf {
        let frames = self.table.frames();
        let frame = frames[self.rows[key]].as_ref().expect("a frame");
        self.dataset.join(&frame.path)
    }
}

fn hex(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Each of the recordings is as its library reads it.
#[track_caller]
fn all_as_expected(names: &[&str]) {
    let wrong: Vec<String> = names
        .iter()
        .flat_map(|name| {
            differences(name)
                .into_iter()
                .map(move |what| format!("{name}: {what}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn texts_with_labels_in_names_cells_and_joins() {
    all_as_expected(&[
        "classes",
        "csv-headerless",
        "csv-packed",
        "join-key",
        "join-time",
        "json-per-folder",
        "jsonl",
        "matrix",
        "names",
    ]);
}

#[test]
fn arrays_of_numpy() {
    all_as_expected(&[
        "npy-float32",
        "npy-fortran",
        "npy-gray1",
        "npy-int16",
        "npy-nchw",
    ]);
}
