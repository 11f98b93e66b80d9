//! Tests of labels and pictures of generated recordings against their `expected.json`.

use std::fs;

use serde_json::Value;
use sha2::{Digest, Sha256};
use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues};

use crate::digest::{at, hex};

/// Recordings: folder, file and array of the pictures, file and array of the wrench (forces and torques).
const RECORDINGS: &[(&str, &str, &str, &str, &str)] = &[
    ("npy-fortran", "frames.npy", "value", "ft.npy", "value"),
    ("npz-stored", "run.npz", "images", "run.npz", "ft"),
    ("npz-deflated", "run.npz", "images", "run.npz", "ft"),
    ("zarr-v2", "run.zarr", "camera_0", "run.zarr", "force"),
    ("zarr-v2", "run.zarr", "camera_zstd", "run.zarr", "force"),
    ("zarr-v2", "run.zarr", "camera_blosc", "run.zarr", "force"),
    ("zarr-v3", "run.zarr", "camera_0", "run.zarr", "force"),
    ("zarr-v3", "run.zarr", "camera_zstd", "run.zarr", "force"),
    ("zarr-v3", "run.zarr", "camera_blosc", "run.zarr", "force"),
    ("pickle", "p4.pkl", "images", "p4.pkl", "ft"),
];

/// Folders of HDF5 recordings. Their pictures are `/tactile/left/rgb`, their forces and torques `/force/wrench`.
#[cfg(feature = "hdf5")]
const HDF5: &[&str] = &[
    "hdf5-gzip-shuffle-earliest",
    "hdf5-gzip-shuffle-latest",
    "hdf5-lzf-earliest",
    "hdf5-lzf-latest",
    "hdf5-fletcher-earliest",
    "hdf5-fletcher-latest",
];
#[cfg(not(feature = "hdf5"))]
const HDF5: &[&str] = &[];

#[test]
fn labels_and_pictures_are_those_that_the_recording_states() {
    let of_hdf5 = |folder: &&'static str| {
        (
            *folder,
            "run.h5",
            "/tactile/left/rgb",
            "run.h5",
            "/force/wrench",
        )
    };
    for (folder, frames_file, frames, wrench_file, wrench) in
        RECORDINGS.iter().copied().chain(HDF5.iter().map(of_hdf5))
    {
        let folder = at(folder);
        let text = fs::read_to_string(folder.join("expected.json")).expect("copied with it");
        let expected: Value = serde_json::from_str(&text).expect("JSON");
        let open = |name: &str| {
            let path = folder.join(name);
            ArrayFile::open(&path, ArrayFormat::of(&path).expect("known")).expect("opens")
        };
        let pictures = open(frames_file);
        let labels = open(wrench_file);
        let info = pictures.info(frames).expect("listed");
        assert_eq!(Some(info.rows()), expected["count"].as_u64(), "{folder:?}");
        assert_eq!(
            serde_json::json!(info.shape[1..]),
            expected["shape"],
            "{folder:?}"
        );
        for (row, stated) in expected["frames_sha256"].as_object().expect("three") {
            let row: u64 = row.parse().expect("a row");
            let ArrayValues::U8(pixels) =
                pictures.read(frames, row..row + 1).expect("reads").values
            else {
                panic!("{folder:?}: pixels of 8 bits");
            };
            let mut sum = Sha256::new();
            sum.update(&pixels);
            assert_eq!(
                hex(sum),
                stated.as_str().expect("text"),
                "{folder:?} row {row}"
            );
        }
        for (row, stated) in expected["labels"].as_object().expect("three") {
            let row: u64 = row.parse().expect("a row");
            let numbers = labels
                .read(wrench, row..row + 1)
                .expect("reads")
                .values
                .to_f64()
                .expect("numbers");
            for (number, channel) in numbers.iter().zip(["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"]) {
                let stated = stated[channel].as_f64().expect("a number");
                assert_eq!(
                    number.to_bits(),
                    stated.to_bits(),
                    "{folder:?} row {row} {channel}"
                );
            }
        }
    }
}
