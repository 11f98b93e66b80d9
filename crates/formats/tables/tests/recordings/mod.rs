//! Recordings under `tests/data` and `../../../tests/recordings`, with the values that the libraries which wrote them read back.

#![allow(dead_code, reason = "each test program uses a part")]

pub(crate) mod damage;
pub(crate) mod parquet_file;

use std::path::PathBuf;

use sha2::{Digest, Sha256};

/// Folder of the recording `name`: in this crate, or else among the shared recordings.
pub(crate) fn recording(name: &str) -> PathBuf {
    let crate_folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let own = crate_folder.join("tests/data").join(name);
    match own.exists() {
        true => own,
        false => crate_folder.join("../../../tests/recordings").join(name),
    }
}

/// `expected.json` of a recording.
pub(crate) fn expected(name: &str) -> serde_json::Value {
    let text =
        std::fs::read_to_string(recording(name).join("expected.json")).expect("expected.json");
    serde_json::from_str(&text).expect("JSON")
}

/// Number in a value of `expected.json`.
pub(crate) fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

/// SHA-256 of `bytes` in hexadecimal digits.
pub(crate) fn digest(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// SHA-256 of the samples of a PNG file.
pub(crate) fn picture_digest(png: &[u8]) -> String {
    let picture = image::load_from_memory(png).expect("a picture");
    digest(&picture.into_rgb8())
}

/// Row number as an index of a list.
pub(crate) fn at(row: u64) -> usize {
    usize::try_from(row).expect("a row of a small file")
}
