//! Compares `expected.json` of a recording with its imported dataset.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;
use sha2::{Digest, Sha256};
use taceva_dataset::{Dataset, Table};

use super::{folder, import};

/// Labels in `expected.json` that have other names in a dataset, or are read from another place.
const ELSEWHERE: [&str; 3] = ["frame", "t_s", "file"];
/// Recordings whose keys in `expected.json` are rows of the main table.
const BY_SOURCE_ROW: [&str; 3] = ["join-time", "join-key", "taxels-csv"];

/// Differences between the recording `name`, imported by `map`, and its `expected.json`.
pub(crate) fn differences(name: &str, map: &str) -> Vec<String> {
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    if let Err(problem) = import(name, map, &target) {
        return vec![problem];
    }
    let dataset = Dataset::open(&target).expect("a dataset");
    let text = std::fs::read_to_string(folder(name).join("expected.json")).expect("it is there");
    let expected: Value = serde_json::from_str(&text).expect("JSON");
    let expected = Expected {
        expected: &expected,
        read: &dataset,
        table: dataset.table(),
        dataset: &target,
        is_luma: map.contains("channel_order = \"gray\""),
        rows: rows(name, dataset.table()),
    };
    [
        expected.count(),
        expected.labels(),
        expected.pixels(),
        expected.packets(),
        expected.signals(),
    ]
    .concat()
}

/// Row of the dataset for each key of `expected.json`.
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
    read: &'a Dataset,
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
            let Some(row) = self.rows.get(key).copied() else {
                wrong.push(format!("no row {key}"));
                continue;
            };
            for (name, value) in labels.as_object().into_iter().flatten() {
                if ELSEWHERE.contains(&name.as_str()) {
                    continue;
                }
                let column = if name == "unit" { "unit_id" } else { name };
                let Some(cells) = self.table.as_text(column) else {
                    wrong.push(format!("no column {column}"));
                    continue;
                };
                let cell = cells[row].clone().unwrap_or_default();
                let is_right = match value.as_f64() {
                    // Torques are stored in N·mm.
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
            let Some(file) = self.file(key) else {
                wrong.push(format!("no picture {key}"));
                continue;
            };
            let picture = image::open(file).expect("a picture");
            if Some(hex(picture.as_bytes()).as_str()) != digest.as_str() {
                wrong.push(format!("pixels of {key}"));
            }
        }
        wrong
    }

    /// Encoded pictures. They must be equal byte for byte.
    fn packets(&self) -> Vec<String> {
        let packets = self.expected["packets_sha256"].as_object();
        let wrong = packets.into_iter().flatten().filter(|(key, digest)| {
            let bytes = self
                .file(key)
                .map(|file| std::fs::read(file).expect("a file"));
            bytes.map(|bytes| hex(&bytes)).as_deref() != digest.as_str()
        });
        wrong
            .map(|(key, _)| format!("the packet of {key} was changed"))
            .collect()
    }

    /// Taxel values. They must be equal in all 32 bits.
    fn signals(&self) -> Vec<String> {
        let mut wrong = Vec::new();
        for (key, numbers) in self.expected["signals"].as_object().into_iter().flatten() {
            let numbers = numbers.as_array().expect("numbers").iter();
            #[expect(clippy::cast_possible_truncation, reason = "as they are kept")]
            let numbers = numbers.map(|number| number.as_f64().expect("a number") as f32);
            let row = self.rows.get(key).copied();
            let found = row.and_then(|row| self.read.signals(row).ok().flatten());
            if found.is_none_or(|found| found.values() != numbers.collect::<Vec<f32>>()) {
                wrong.push(format!("signals of {key}"));
            }
        }
        wrong
    }

    fn file(&self, key: &str) -> Option<PathBuf> {
        let frame = self.table.frames()[*self.rows.get(key)?].as_ref()?;
        Some(self.dataset.join(&frame.path))
    }
}

fn hex(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
