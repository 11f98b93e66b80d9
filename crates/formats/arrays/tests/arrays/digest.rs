//! Digest of an array as in `tests/data/make.py`: shape, type and SHA-256 of the elements.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use taceva_arrays::{ArrayFile, ArrayValues};

/// Folders of the shared recordings whose files these tests read.
pub(crate) const SHARED: [&str; 15] = [
    "hdf5-fletcher-earliest",
    "hdf5-fletcher-latest",
    "hdf5-groups",
    "hdf5-gzip-shuffle-earliest",
    "hdf5-gzip-shuffle-latest",
    "hdf5-lzf-earliest",
    "hdf5-lzf-latest",
    "hdf5-vlen-compound",
    "npy-fortran",
    "npz-deflated",
    "npz-stored",
    "pickle",
    "taxels-npy",
    "zarr-v2",
    "zarr-v3",
];

/// Folder of the test files of this crate.
pub(crate) fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")
}

/// Test file or folder `name` of this crate or, if it does not exist, of the shared recordings.
pub(crate) fn at(name: impl AsRef<Path>) -> PathBuf {
    let own = data().join(&name);
    match own.exists() {
        true => own,
        false => data().join("../../../../../tests/recordings").join(name),
    }
}

/// Adds the elements to the digest: numbers little-endian, texts and bytes after a letter and their length.
fn add(sum: &mut Sha256, values: &ArrayValues) {
    macro_rules! numbers {
        ($values:expr) => {
            $values
                .iter()
                .for_each(|value| sum.update(value.to_le_bytes()))
        };
    }
    match values {
        ArrayValues::Bool(all) => all.iter().for_each(|value| sum.update([u8::from(*value)])),
        ArrayValues::U8(all) => sum.update(all),
        ArrayValues::U16(all) => numbers!(all),
        ArrayValues::U32(all) => numbers!(all),
        ArrayValues::U64(all) => numbers!(all),
        ArrayValues::I8(all) => numbers!(all),
        ArrayValues::I16(all) => numbers!(all),
        ArrayValues::I32(all) => numbers!(all),
        ArrayValues::I64(all) => numbers!(all),
        ArrayValues::F32(all) => numbers!(all),
        ArrayValues::F64(all) => numbers!(all),
        ArrayValues::Text(all) => all.iter().for_each(|text| long(sum, b"t", text.as_bytes())),
        ArrayValues::Bytes(all) => all.iter().for_each(|bytes| long(sum, b"b", bytes)),
        other => panic!("{other:?} has no digest"),
    }
}

fn long(sum: &mut Sha256, letter: &[u8], bytes: &[u8]) {
    sum.update(letter);
    sum.update((bytes.len() as u64).to_le_bytes());
    sum.update(bytes);
}

pub(crate) fn hex(sum: Sha256) -> String {
    sum.finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

pub(crate) fn digest(values: &ArrayValues) -> String {
    let mut sum = Sha256::new();
    add(&mut sum, values);
    hex(sum)
}

/// Digest of an array that is read `step` rows at a time.
pub(crate) fn by_rows(file: &ArrayFile, name: &str, step: u64) -> String {
    let rows = file.info(name).expect("listed").rows();
    let mut sum = Sha256::new();
    let mut start = 0;
    while start < rows {
        let end = (start + step).min(rows);
        let read = file
            .read(name, start..end)
            .unwrap_or_else(|error| panic!("{error}"));
        add(&mut sum, &read.values);
        start = end;
    }
    hex(sum)
}
