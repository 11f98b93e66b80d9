//! Tests of groups, attributes, damage and errors of zarr stores in folders.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues, Problem};

use crate::damage::{damaged, read_all};
use crate::digest::at;

fn opened(name: &str) -> ArrayFile {
    ArrayFile::open(&at(name), ArrayFormat::Zarr).expect("opens")
}

#[test]
fn groups_and_attributes_are_found_in_both_versions() {
    let two = opened("zarr/two.zarr");
    assert_eq!(
        two.groups("/*"),
        ["/blosc", "/packed", "/texts", "/unwritten"]
    );
    assert_eq!(two.attribute("/", "sensor").as_deref(), Some("drawn gel"));
    assert_eq!(two.attribute("/", "rate_hz").as_deref(), Some("0.1"));
    let three = opened("zarr/three.zarr");
    assert_eq!(
        three.attribute("/deeper", "object").as_deref(),
        Some("[\"cube\",3]")
    );
    assert_eq!(three.attribute("/deeper", "gel"), None);
    assert_eq!(opened("zarr/alone.zarr").names(), ["/"]);
}

#[test]
fn chunks_that_were_never_written_are_counted() {
    let two = opened("zarr/two.zarr");
    for (name, absent) in [
        // 4 × 2 chunks, two rows of them written.
        ("/unwritten/whole", 6),
        ("/unwritten/true", 8),
        ("/packed/zstd", 0),
    ] {
        assert_eq!(two.absent_chunks(name).expect(name), absent, "{name}");
    }
    let three = opened("zarr/three.zarr");
    for (name, absent) in [("/unwritten", 6), ("/turned", 0), ("/scalar", 0)] {
        assert_eq!(three.absent_chunks(name).expect(name), absent, "{name}");
    }
    assert_eq!(
        opened("zarr/alone.zarr").absent_chunks("/").expect("there"),
        0
    );
    assert!(two.absent_chunks("/nothing").is_err());
}

#[test]
fn a_slash_in_front_may_be_left_out() {
    let file = opened("zarr/two.zarr");
    let short = file.read("packed/zstd", 0..2).expect("there");
    assert_eq!(short, file.read("/packed/zstd", 0..2).expect("there"));
}

#[test]
fn what_is_not_read_says_so_and_leaves_the_others_alone() {
    let file = opened("refused/kinds.zarr");
    assert_eq!(
        file.read("/x", 1..3).expect("plain").values,
        ArrayValues::I64(vec![1, 2])
    );
    for (name, expected) in [
        ("/blosclz", "Blosc with blosclz"),
        ("/delta", "a filter `delta`"),
        ("/complex", "imaginary"),
    ] {
        let message = file.read(name, 0..1).expect_err(name).to_string();
        assert!(message.contains(expected), "{name}: {message}");
        // Blosc states its codec only in its chunks.
        if name != "/blosclz" {
            assert_eq!(file.find(name).expect_err(name).to_string(), message);
        }
    }
    let shards = opened("refused/shards.zarr");
    let message = shards
        .read("/shards", 0..1)
        .expect_err("shards")
        .to_string();
    assert!(message.contains("without `shards`"), "{message}");
    let folder = tempfile::tempdir().expect("a folder");
    let error = ArrayFile::open(folder.path(), ArrayFormat::Zarr).expect_err("empty");
    assert!(
        error.to_string().contains("expected a folder of zarr"),
        "{error}"
    );
}

/// Copies a store.
fn copied(from: &Path, into: &Path) {
    fs::create_dir_all(into).expect("writable");
    for entry in fs::read_dir(from).expect("a folder") {
        let path = entry.expect("an entry").path();
        let target = into.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copied(&path, &target);
        } else {
            fs::write(&target, fs::read(&path).expect("readable")).expect("written");
        }
    }
}

fn files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, into);
        } else {
            into.push(path);
        }
    }
}

#[test]
fn damaged_stores_are_refused_or_read_and_never_panic() {
    let mut bad = Vec::new();
    let (mut refused, mut looked) = (0, 0);
    for store in ["zarr/two.zarr", "zarr/three.zarr"] {
        let folder = tempfile::tempdir().expect("a folder");
        let copy = folder.path().join("run.zarr");
        copied(&at(store), &copy);
        let mut all = Vec::new();
        files(&copy, &mut all);
        all.sort_unstable();
        // Every third file, because neighbouring chunks are alike.
        for (seed, file) in all.iter().enumerate().step_by(3) {
            let whole = fs::read(file).expect("readable");
            // Only the array of the file is read.
            let array = file.ancestors().skip(1).find(|folder| {
                folder.join("zarr.json").exists() || folder.join(".zarray").exists()
            });
            let Some(array) = array else { continue };
            let array = array.to_owned();
            damaged(&whole, seed as u64, |what, bytes| {
                fs::write(file, bytes).expect("written");
                looked += 1;
                match catch_unwind(AssertUnwindSafe(|| read_all(&array, ArrayFormat::Zarr))) {
                    Ok(result) => refused += usize::from(result.is_err()),
                    Err(_) => bad.push(format!("{}: {what}: panicked", file.display())),
                }
            });
            fs::write(file, whole).expect("written");
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
    assert!(refused > looked / 4, "{refused} of {looked} were refused");
}

#[cfg(unix)]
#[test]
fn links_out_of_the_store_are_not_followed() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = folder.path().join("run.zarr");
    copied(&at("zarr/alone.zarr"), &store);
    let chunk = store.join("c/0/0");
    let outside = folder.path().join("outside");
    fs::rename(&chunk, &outside).expect("moved");
    std::os::unix::fs::symlink(&outside, &chunk).expect("linked");
    let file = ArrayFile::open(&store, ArrayFormat::Zarr).expect("its metadata is whole");
    let error = file.read("/", 0..1).expect_err("a link");
    assert!(
        matches!(error.problem, Problem::Unsupported { .. }),
        "{error}"
    );
}

#[test]
fn a_shape_that_would_fill_a_memory_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = folder.path().join("run.zarr");
    fs::create_dir(&store).expect("writable");
    let write = |shape: &str, chunks: &str| {
        let text = format!(
            "{{\"zarr_format\":2,\"shape\":{shape},\"chunks\":{chunks},\"dtype\":\"<f8\",\"order\":\"C\",\"compressor\":null,\"filters\":null,\"fill_value\":0}}"
        );
        fs::write(store.join(".zarray"), text).expect("written");
        let file = ArrayFile::open(&store, ArrayFormat::Zarr);
        file.and_then(|file| file.read("/", 0..1))
            .expect_err("refused")
            .to_string()
    };
    assert!(write("[4,4000000000]", "[1,1]").contains("above the limit"));
    assert!(write("[4,18446744073709551615,9]", "[1,1,1]").contains("above the limit"));
    assert!(write("[4,4]", "[4000000000,4000000000]").contains("bytes of one chunk"));
    assert!(write("[4,1000000]", "[1,1]").contains("chunks of these rows"));
    assert!(write("[4,4]", "[0,4]").contains("at least 1"));
    assert!(write("[4,4]", "[4]").contains("equal numbers of axes"));
    assert!(write("[4,-4]", "[4,4]").contains("list of lengths"));
}

/// ZIP archive of uncompressed members in the given order.
fn zip(members: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = Vec::new();
    let mut directory = Vec::new();
    let small = |number: usize| u16::try_from(number).expect("small").to_le_bytes();
    let size = |number: usize| u32::try_from(number).expect("small").to_le_bytes();
    for (name, bytes) in members {
        let at = archive.len();
        let mut hasher = crc32fast::Hasher::new();
        hasher.update(bytes);
        let crc = hasher.finalize().to_le_bytes();
        let sizes = [
            &crc[..],
            &size(bytes.len()),
            &size(bytes.len()),
            &small(name.len()),
            &[0, 0],
        ]
        .concat();
        archive.extend(
            [
                &b"PK\x03\x04\x14\0\0\0\0\0\0\0\0\0"[..],
                &sizes,
                name.as_bytes(),
                bytes,
            ]
            .concat(),
        );
        let entry = [
            &b"PK\x01\x02\x14\0\x14\0\0\0\0\0\0\0\0\0"[..],
            &sizes,
            &[0; 10],
            &size(at),
            name.as_bytes(),
        ];
        directory.extend(entry.concat());
    }
    let count = small(members.len());
    let end = [
        &b"PK\x05\x06\0\0\0\0"[..],
        &count,
        &count,
        &size(directory.len()),
        &size(archive.len()),
        &[0, 0],
    ]
    .concat();
    archive.extend(directory);
    archive.extend(end);
    archive
}

const ARRAY: &[u8] = br#"{"zarr_format": 2, "shape": [3, 2], "chunks": [2, 2], "dtype": "<i2", "compressor": null, "fill_value": 7, "order": "C", "filters": null}"#;

#[test]
fn a_store_in_an_archive_is_read_and_of_members_of_one_name_the_last() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("grip.hapt.zarr");
    for before in ["", "grip.zarr/"] {
        let name = |name: &str| format!("{before}{name}");
        let names = [
            ".zgroup",
            "raw/.zattrs",
            "raw/.zarray",
            "raw/0.0",
            "raw/.zattrs",
        ]
        .map(name);
        let members: Vec<(&str, &[u8])> = names
            .iter()
            .map(String::as_str)
            .zip([
                br#"{"zarr_format": 2}"#.as_slice(),
                b"{}",
                ARRAY,
                &[1, 0, 2, 0, 3, 0, 4, 0],
                br#"{"unit": "N"}"#,
            ])
            .collect();
        std::fs::write(&path, zip(&members)).expect("written");
        let file = ArrayFile::open(&path, ArrayFormat::Zarr).expect("opens");
        assert_eq!(file.names(), ["/raw"], "{before}");
        assert_eq!(file.attribute("/raw", "unit").as_deref(), Some("N"));
        let read = file.read("/raw", 0..3).expect("numbers");
        assert_eq!(
            read.values.to_f64().expect("numbers"),
            [1.0, 2.0, 3.0, 4.0, 7.0, 7.0]
        );
        assert_eq!(file.absent_chunks("/raw").expect("counted"), 1);
    }
}

#[test]
fn an_archive_without_a_store_or_with_a_changed_chunk_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("other.zarr");
    std::fs::write(&path, zip(&[("note.txt", b"nothing")])).expect("written");
    let error = ArrayFile::open(&path, ArrayFormat::Zarr).expect_err("no store");
    assert!(error.to_string().contains("zarr.json"), "{error}");
    std::fs::write(&path, b"no archive").expect("written");
    assert!(ArrayFile::open(&path, ArrayFormat::Zarr).is_err());
    let chunk = [1, 0, 2, 0, 3, 0, 4, 0];
    let mut bytes = zip(&[
        ("raw/.zarray", ARRAY),
        (".zgroup", br#"{"zarr_format": 2}"#),
        ("raw/0.0", &chunk),
    ]);
    let at = bytes
        .windows(8)
        .position(|window| window == chunk)
        .expect("stored");
    bytes[at] = 9;
    std::fs::write(&path, bytes).expect("written");
    let file = ArrayFile::open(&path, ArrayFormat::Zarr).expect("opens");
    let error = file.read("/raw", 0..1).expect_err("another checksum");
    assert!(error.to_string().contains("raw/0.0"), "{error}");
}
