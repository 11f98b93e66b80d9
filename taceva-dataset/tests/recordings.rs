//! The recordings of `tests/recordings`, written by the libraries of other people, imported by their maps: counts, labels, pixels and packets
//! are those that the library that wrote them reads back.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use serde_json::Value;
use sha2::{Digest, Sha256};
use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, Decoders, ImportMap, ImportPlan, MapDraft, Table};
use taceva_needs::{Need, skip};

/// What check names of labels stand under other names in a dataset, or are read from elsewhere.
const ELSEWHERE: [&str; 3] = ["frame", "t_s", "file"];
/// Of these the digests are by the row of the main table.
const BY_SOURCE_ROW: [&str; 3] = ["join-time", "join-key", "taxels-csv"];

fn folder(name: &str) -> PathBuf {
    let recordings = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/recordings");
    Path::new(recordings).join(name)
}

/// The map of the recording.
fn own_map(name: &str) -> String {
    std::fs::read_to_string(folder(name).join("map.toml")).expect("it is there")
}

/// Imports the recording into `target` by the map `text`.
fn import(name: &str, text: &str, target: &Path) -> Result<(), String> {
    let folder = folder(name);
    let map = ImportMap::parse("map.toml".as_ref(), text).map_err(|error| error.to_string())?;
    let decoders = Decoders {
        ffmpeg: Some("ffmpeg".into()),
        ..Decoders::default()
    };
    let plan = ImportPlan::with_decoders(&folder, &map, &decoders);
    let plan = plan.map_err(|error| error.to_string())?;
    let threads = NonZeroUsize::new(2).expect("two");
    let report = plan.run(target, threads, &SilentProgress);
    report.map(drop).map_err(|error| error.to_string())
}

/// What of the recording, imported by the map `text`, is not as its `expected.json` says.
fn differences(name: &str, map: &str) -> Vec<String> {
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

    /// Encoded pictures are kept byte for byte.
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

    /// Numbers of taxels, to the last bit of the 32 that they are kept in.
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

/// Each of the recordings is as its library reads it.
#[track_caller]
fn all_as_expected(names: &[&str]) {
    let wrong: Vec<String> = names
        .iter()
        .flat_map(|name| {
            differences(name, &own_map(name))
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

#[test]
fn archives_of_numpy() {
    all_as_expected(&["npz-deflated", "npz-stored"]);
}

#[test]
fn parquet_with_lists_structures_and_pictures() {
    all_as_expected(&[
        "hf-parquet-jpeg",
        "hf-parquet-png",
        "parquet-brotli",
        "parquet-gzip",
        "parquet-lz4",
        "parquet-none",
        "parquet-zstd",
    ]);
}

#[test]
fn clips_of_motion_jpeg_and_h264() {
    all_as_expected(&["avi-mjpeg", "mp4-h264-baseline", "mp4-h264-high-b"]);
}

#[test]
fn arrays_in_pickles() {
    all_as_expected(&["pickle"]);
}

#[test]
fn numbers_of_taxels() {
    all_as_expected(&["taxels-csv", "taxels-npy"]);
}

#[test]
fn arrays_of_zarr() {
    all_as_expected(&["zarr-v2", "zarr-v3"]);
}

#[test]
fn clips_that_ffmpeg_decodes() {
    match std::process::Command::new("ffmpeg")
        .arg("-version")
        .output()
    {
        Ok(_) => all_as_expected(&["mkv-ffv1", "mp4-h264-444", "mp4-mpeg4"]),
        Err(error) => skip(Need::Ffmpeg, error),
    }
}

#[test]
fn folders_of_lerobot() {
    all_as_expected(&["lerobot-v3-h264"]);
}

#[test]
fn messages_of_ros_in_mcap() {
    all_as_expected(&["mcap-lz4", "mcap-none", "mcap-zstd"]);
}

#[test]
fn hdf5_of_every_layout_that_is_read() {
    all_as_expected(&[
        "hdf5-contiguous-earliest",
        "hdf5-contiguous-latest",
        "hdf5-fletcher-earliest",
        "hdf5-groups",
        "hdf5-gzip-shuffle-earliest",
        "hdf5-lzf-earliest",
        "hdf5-vlen-compound",
    ]);
}

#[test]
fn hdf5_of_a_layout_that_is_not_read_names_the_setting_that_writes_another() {
    for name in [
        "hdf5-fletcher-latest",
        "hdf5-gzip-shuffle-latest",
        "hdf5-lzf-latest",
    ] {
        let found = differences(name, &own_map(name)).join(" ");
        assert!(found.contains("libver='v114'"), "{name}: {found}");
    }
}

/// The recording as its lab has it: without the map and what is expected of it.
fn bare(name: &str) -> tempfile::TempDir {
    fn copy(from: &Path, to: &Path) {
        std::fs::create_dir_all(to).expect("made");
        for entry in std::fs::read_dir(from).expect("a folder").flatten() {
            let target = to.join(entry.file_name());
            match entry.file_type().expect("known").is_dir() {
                true => copy(&entry.path(), &target),
                false => drop(std::fs::copy(entry.path(), target).expect("copied")),
            }
        }
    }
    let target = tempfile::tempdir().expect("a folder");
    copy(&folder(name), target.path());
    for own in ["map.toml", "expected.json"] {
        std::fs::remove_file(target.path().join(own)).expect("it was there");
    }
    target
}

/// The draft of a map for the recording, its units, signs, offsets and scales filled in from the map of its lab.
fn finished_draft(name: &str) -> Result<String, String> {
    let draft = MapDraft::of(bare(name).path()).map_err(|error| error.to_string())?;
    let own: toml::Table = own_map(name).parse().expect("TOML");
    let mut finished = String::new();
    for line in draft.text().lines() {
        let channel = line.split(" = ").next().unwrap_or_default();
        let facts = own.get("columns").and_then(|columns| columns.get(channel));
        let fact = |key: &str| {
            facts
                .and_then(|facts| facts.get(key))
                .map(|fact| format!(", {key} = {fact}"))
        };
        if line == "unit = \"?\"" {
            let unit = own.get("signals").and_then(|signals| signals.get("unit"));
            finished += &format!("unit = {}\n", unit.expect("a unit"));
            continue;
        }
        let unit = fact("unit").unwrap_or_else(|| match channel.as_bytes().first() {
            Some(b'F') => ", unit = \"N\"".to_owned(),
            Some(b'T') => ", unit = \"Nm\"".to_owned(),
            _ => ", unit = \"mm\"".to_owned(),
        });
        let others = ["sign", "offset", "scale"].map(|key| fact(key).unwrap_or_default());
        finished += &line.replace(", unit = \"?\"", &format!("{unit}{}", others.concat()));
        finished.push('\n');
    }
    Ok(finished)
}

/// Folders whose drafts leave more open than units and signs.
const MORE_OPEN: [&str; 11] = [
    // Not read at all: data layout version 5.
    "hdf5-fletcher-latest",
    "hdf5-gzip-shuffle-latest",
    "hdf5-lzf-latest",
    // How much later one clock shows the same instant stands nowhere.
    "join-time",
    // That the columns are volts, of which a matrix beside them makes forces.
    "matrix",
    "mcap-lz4",
    "mcap-none",
    "mcap-zstd",
    // Which numbers are black and full, where they are neither pixels nor shares.
    "npy-int16",
    // Three recordings lie beside each other, of which the map wants one.
    "pickle",
    // That -1 g means nothing was weighed, and that the other table is the taxels.
    "taxels-csv",
];

#[test]
fn a_draft_needs_nothing_but_units_of_most_recordings() {
    let mut names: Vec<String> = std::fs::read_dir(folder(""))
        .expect("recordings")
        .flatten()
        .filter(|entry| entry.path().join("map.toml").is_file())
        .map(|entry| entry.file_name().into_string().expect("a name"))
        .collect();
    names.sort();
    let mut open = Vec::new();
    for name in &names {
        let problems = match finished_draft(name) {
            Ok(map) => differences(name, &map),
            Err(problem) => vec![problem],
        };
        if !problems.is_empty() {
            open.push(name.as_str());
        }
    }
    assert_eq!(
        open,
        MORE_OPEN,
        "{} of {}",
        names.len() - open.len(),
        names.len()
    );
}

#[test]
fn a_frame_of_a_clip_says_where_it_came_from_and_how_it_was_coded() {
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    import("mp4-h264-high-b", &own_map("mp4-h264-high-b"), &target).expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let origin = dataset.table().source_frame()[0].as_deref();
    assert_eq!(origin, Some("clip.mp4#22"));
    let frames = dataset.header().frames.clone().expect("frames");
    let codec = frames.codec.expect("of a clip");
    assert_eq!(
        (codec.name.as_str(), codec.pixel_format.as_str()),
        ("H.264 High", "yuv420p")
    );
    assert_eq!(codec.lossy, Some(true));
    assert!(
        codec
            .decoder
            .is_some_and(|decoder| decoder.contains("rusty_h264"))
    );
}
