//! Tests of the recordings in `tests/recordings`, written by external libraries and imported by their maps. Counts, labels, pixels and packets must equal what
//! the library reads back.

mod clip_times;
mod damaged;
mod depth_maps;
mod drafts;
mod expected;
mod flips;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use expected::differences;
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{Decoders, ImportMap, ImportPlan};
use taceva_needs::{Need, skip};

fn folder(name: &str) -> PathBuf {
    let recordings = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../tests/recordings");
    Path::new(recordings).join(name)
}

/// Copies a folder recursively.
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

/// Text of the map of the recording `name`.
fn own_map(name: &str) -> String {
    std::fs::read_to_string(folder(name).join("map.toml")).expect("it is there")
}

/// Imports the recording `name` into `target` by the map `text`.
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

/// Checks that each recording equals the content that its library reads.
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
    all_as_expected(&["npy-fortran", "npy-gray1", "npy-int16", "npy-nchw"]);
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
        "hf-saved",
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

/// Output of `ffmpeg -version`; an error if it is not installed.
fn ffmpeg() -> std::io::Result<Output> {
    Command::new("ffmpeg").arg("-version").output()
}

#[test]
fn clips_that_ffmpeg_decodes() {
    match ffmpeg() {
        Ok(_) => all_as_expected(&["lerobot-v3-depth", "mkv-ffv1", "mp4-h264-444", "mp4-mpeg4"]),
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
fn hdf5_of_every_layout() {
    all_as_expected(&[
        "hdf5-contiguous-earliest",
        "hdf5-contiguous-latest",
        "hdf5-fletcher-earliest",
        "hdf5-fletcher-latest",
        "hdf5-groups",
        "hdf5-gzip-shuffle-earliest",
        "hdf5-gzip-shuffle-latest",
        "hdf5-lzf-earliest",
        "hdf5-lzf-latest",
        "hdf5-vlen-compound",
    ]);
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
