//! Tests of damaged and oversized files of arrays: checksums of members, keys of chunks, unpacked sizes.

use std::fs;
use std::path::{Path, PathBuf};

use taceva_arrays::{ArrayData, ArrayError, ArrayFile, ArrayFormat};

use crate::digest::at;

/// Writes `bytes` into a folder that exists as long as the returned value.
fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("written");
    (folder, path)
}

/// Offset of the bytes of the member `name` of an archive.
fn begin_of(archive: &[u8], name: &str) -> usize {
    let heads = archive.windows(4).enumerate();
    let mut heads = heads.filter(|(_, bytes)| *bytes == b"PK\x03\x04");
    let is_named = |at: usize| archive[at + 30..].starts_with(name.as_bytes());
    let (at, _) = heads.find(|(at, _)| is_named(*at)).expect(name);
    let extra = usize::from(u16::from_le_bytes([archive[at + 28], archive[at + 29]]));
    at + 30 + name.len() + extra
}

/// Reads every readable array of a file. Also returns the number of chunks that were never written.
fn read(path: &Path, format: ArrayFormat) -> Result<(Vec<ArrayData>, u64), ArrayError> {
    let file = ArrayFile::open(path, format)?;
    let mut all = Vec::new();
    let mut absent = 0;
    for name in file.names() {
        let rows = file.find(&name)?.rows();
        all.push(file.read(&name, 0..rows)?);
        absent += file.absent_chunks(&name)?;
    }
    Ok((all, absent))
}

#[test]
fn a_flip_in_any_member_that_is_read_is_refused_by_its_sum() {
    for (name, members) in [
        ("npz-stored/run.npz", "stored"),
        ("npz-deflated/run.npz", "deflated"),
    ] {
        let whole = fs::read(at(name)).expect("readable");
        let (_folder, path) = file("run.npz", &whole);
        let file = ArrayFile::open(&path, ArrayFormat::Npz).expect("opens");
        let names = file.names();
        let mut refused = 0;
        let mut flips = 0;
        // Members follow one another. Every 997th byte before the directory is changed, in small files every 41st.
        let directory = whole.windows(4).position(|bytes| bytes == b"PK\x01\x02");
        let directory = directory.expect("a directory");
        for position in (0..directory)
            .step_by(997)
            .chain((directory.saturating_sub(4_000)..directory).step_by(41))
        {
            let mut bytes = whole.clone();
            bytes[position] ^= 1 << (position % 8);
            fs::write(&path, &bytes).expect("written");
            flips += 1;
            let outcome = read(&path, ArrayFormat::Npz);
            match outcome {
                Err(_) => refused += 1,
                // A header states names and times, which no checksum covers.
                Ok((all, _)) => {
                    fs::write(&path, &whole).expect("written");
                    let before = read(&path, ArrayFormat::Npz).expect("reads");
                    assert!(all == before.0, "{members}: byte {position}");
                }
            }
        }
        assert!(refused * 10 >= flips * 9, "{members}: {refused} of {flips}");
        assert!(names.len() > 2);
    }
}

/// Flips one bit after the NumPy header, and reads only the first row.
#[test]
fn the_first_rows_of_a_damaged_member_are_refused_too() {
    let whole = fs::read(at("npz-stored/run.npz")).expect("readable");
    let (_folder, path) = file("run.npz", &whole);
    let names = ArrayFile::open(&path, ArrayFormat::Npz)
        .expect("opens")
        .names();
    for name in names {
        let mut bytes = whole.clone();
        // After the NumPy header, which has 128 bytes.
        bytes[begin_of(&whole, &format!("{name}.npy")) + 128 + 3] ^= 1;
        fs::write(&path, &bytes).expect("written");
        let file = ArrayFile::open(&path, ArrayFormat::Npz).expect("headers are whole");
        let problem = file.read(&name, 0..1).expect_err(&name).to_string();
        assert!(problem.contains("checksum"), "{name}: {problem}");
    }
}

#[cfg(feature = "hdf5")]
#[test]
fn no_flip_in_an_index_of_chunks_makes_a_chunk_vanish() {
    for name in [
        "hdf5-gzip-shuffle-earliest/run.h5",
        "hdf5-lzf-earliest/run.h5",
    ] {
        let whole = fs::read(at(name)).expect("readable");
        let (_folder, path) = file("run.h5", &whole);
        let before = read(&path, ArrayFormat::Hdf5).expect("reads");
        assert_eq!(before.1, 0);
        // Nodes of trees of type 1, which index chunks.
        let nodes = whole.windows(5).enumerate();
        let nodes: Vec<usize> = nodes
            .filter(|(_, bytes)| *bytes == b"TREE\x01")
            .map(|(at, _)| at)
            .collect();
        assert!(!nodes.is_empty());
        let (mut refused, mut told, mut same) = (0, 0, 0);
        for node in nodes.into_iter().take(2) {
            for bit in (24 * 8..24 * 8 + 1_600).step_by(7) {
                let mut bytes = whole.clone();
                bytes[node + bit / 8] ^= 1 << (bit % 8);
                fs::write(&path, &bytes).expect("written");
                match read(&path, ArrayFormat::Hdf5) {
                    Err(_) => refused += 1,
                    Ok((_, absent)) if absent > 0 => told += 1,
                    Ok((all, _)) => {
                        assert!(all == before.0, "{name}: bit {bit} of the node at {node}");
                        same += 1;
                    }
                }
            }
        }
        assert!(
            refused > 50,
            "{name}: {refused} refused, {told} told, {same} the same"
        );
    }
}

/// h5py rejects the same file.
#[cfg(feature = "hdf5")]
#[test]
fn a_chunk_whose_key_lies_off_the_grid_is_named() {
    let whole = fs::read(at("hdf5-gzip-shuffle-earliest/run.h5")).expect("readable");
    let node = whole.windows(5).position(|bytes| bytes == b"TREE\x01");
    let node = node.expect("an index");
    let (_folder, path) = file("run.h5", &whole);
    // A key is the size of its chunk, a mask of filters, and the offsets. The first offset is the offset of the rows.
    for (offset, word) in [(1_u64, "not on the grid"), (1 << 40, "outside the extent")] {
        let mut bytes = whole.clone();
        let key = node + 24 + 8;
        let own = u64::from_le_bytes(bytes[key..key + 8].try_into().expect("eight"));
        bytes[key..key + 8].copy_from_slice(&(own + offset).to_le_bytes());
        fs::write(&path, &bytes).expect("written");
        let problem = read(&path, ArrayFormat::Hdf5).expect_err(word).to_string();
        assert!(
            problem.contains("key") && problem.contains("extent"),
            "{problem}"
        );
    }
}

#[cfg(feature = "hdf5")]
#[test]
fn a_small_file_of_hdf5_that_becomes_large_is_refused_before_anything_is_unpacked() {
    for name in ["planes", "extent"] {
        let packed = fs::read(at(format!("refused/{name}.h5.gz"))).expect("readable");
        let inflated = miniz_oxide::inflate::decompress_to_vec(&packed[10..packed.len() - 8]);
        let (_folder, path) = file("run.h5", &inflated.expect("deflated"));
        let file = ArrayFile::open(&path, ArrayFormat::Hdf5).expect("opens");
        let problem = file.read("/frames", 0..1).expect_err(name).to_string();
        assert!(problem.contains("times the size of the file"), "{problem}");
        assert!(file.read("/Fz", 0..10).is_ok(), "{name}");
    }
}

#[test]
fn a_small_store_of_zarr_that_becomes_large_is_refused() {
    let describe = |chunk: &str| {
        format!(
            "{{\"zarr_format\": 2, \"shape\": [100000, 480, 640], \"chunks\": {chunk}, \"dtype\": \"|u1\", \"compressor\": null, \"fill_value\": 0, \
             \"order\": \"C\", \"filters\": null}}"
        )
    };
    for chunk in ["[1, 480, 640]", "[100, 8, 640]"] {
        let folder = tempfile::tempdir().expect("a folder");
        let array = folder.path().join("run.zarr/frames");
        fs::create_dir_all(&array).expect("made");
        fs::write(
            folder.path().join("run.zarr/.zgroup"),
            "{\"zarr_format\": 2}",
        )
        .expect("written");
        fs::write(array.join(".zarray"), describe(chunk)).expect("written");
        let file = ArrayFile::open(&folder.path().join("run.zarr"), ArrayFormat::Zarr);
        let file = file.expect("opens");
        let problem = file.read("/frames", 0..1).expect_err(chunk).to_string();
        assert!(problem.contains("decompressed"), "{problem}");
    }
}
