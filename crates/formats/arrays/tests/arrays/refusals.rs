//! Tests of errors and their messages.

use std::fs;
use std::path::Path;

use taceva_arrays::{ArrayError, ArrayFile, ArrayFormat, Problem};

use crate::digest::at;

fn opened(name: &str) -> ArrayFile {
    let path = at(name);
    ArrayFile::open(&path, ArrayFormat::of(&path).expect("known")).expect("opens")
}

fn refused(path: &Path) -> ArrayError {
    let format = ArrayFormat::of(path).expect("known");
    match ArrayFile::open(path, format) {
        Err(error) => error,
        Ok(file) => {
            let name = file.names().remove(0);
            let rows = file.info(&name).expect("listed").rows();
            file.read(&name, 0..rows).expect_err("refused")
        }
    }
}

#[test]
fn names_and_rows_that_are_not_there_are_refused_with_those_that_are() {
    let file = opened("npz-stored/run.npz");
    let message = file.read("image", 0..1).expect_err("absent").to_string();
    assert!(
        message.contains("`image`: no such array; the file has images, ft, t, obj"),
        "{message}"
    );
    let error = file.read("ft", 20..25).expect_err("too many rows");
    assert!(
        matches!(error.problem, Problem::Rows { rows: 24, .. }),
        "{error}"
    );
    #[expect(
        clippy::reversed_empty_ranges,
        reason = "refused, whatever way round it is"
    )]
    let backwards = file.read("ft", 3..2);
    assert!(backwards.is_err());
    assert_eq!(file.read("ft", 24..24).expect("none").shape, [0, 6]);
}

#[test]
fn nothing_is_read_of_nothing() {
    for (name, array) in [
        ("npy/scalar.npy", "value"),
        ("npy/record.npy", "value.t"),
        ("npy/S6.npy", "value"),
        ("zarr/two.zarr", "/scalar"),
        ("pickle-kinds/plain-4.pickle", "one"),
        ("matlab/packed-5.mat", "names"),
    ] {
        let read = opened(name).read(array, 0..0).expect("no rows");
        assert!(
            read.values.is_empty() && read.shape[0] == 0,
            "{name}: {read:?}"
        );
    }
}

#[test]
fn shapes_beyond_64_bits_are_refused_whatever_is_zero_in_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x.npy");
    for (descr, shape) in [
        ("<f4", "(4294967296, 4294967296, 4294967296)"),
        ("<f4", "(0, 4294967296, 4294967296)"),
        ("<U0", "(5, 4294967296, 4294967296)"),
        ("<U0", "(18446744073709551615,)"),
        ("<f4", "(4294967296, 0)"),
    ] {
        for order in ["True", "False"] {
            let header =
                format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n");
            let length = u16::try_from(header.len()).expect("short").to_le_bytes();
            fs::write(
                &path,
                [b"\x93NUMPY\x01\x00".as_slice(), &length, header.as_bytes()].concat(),
            )
            .expect("written");
            // Read or rejected, without a panic and without memory for missing data.
            if let Ok(file) = ArrayFile::open(&path, ArrayFormat::Npy) {
                let rows = file.info("value").expect("listed").rows();
                let read = file.read("value", 0..rows.min(5));
                assert!(
                    read.map_or(true, |read| read.values.len() < 10),
                    "{descr} {shape}"
                );
            }
        }
    }
}

/// Archive with one deflated member of zeros. Its directory states `stated` inflated bytes.
fn archive_of_zeros(stated: u64, packed: &[u8]) -> Vec<u8> {
    let name = b"bomb.npy";
    let small = |size: u64| {
        u32::try_from(size.min(0xffff_ffff))
            .expect("fits")
            .to_le_bytes()
    };
    let extra = [
        &1_u16.to_le_bytes()[..],
        &8_u16.to_le_bytes(),
        &stated.to_le_bytes(),
    ]
    .concat();
    let extra = if stated >= 0xffff_ffff {
        extra
    } else {
        Vec::new()
    };
    let sizes = [
        &0_u32.to_le_bytes()[..],
        &small(packed.len() as u64),
        &small(stated),
    ]
    .concat();
    let short = |size: usize| u16::try_from(size).expect("short");
    let lengths = [short(name.len()), short(extra.len())]
        .map(u16::to_le_bytes)
        .concat();
    let local = [
        &b"PK\x03\x04\x14\0\0\0\x08\0\0\0\0\0"[..],
        &sizes,
        &short(name.len()).to_le_bytes(),
        &[0, 0],
        name,
        packed,
    ]
    .concat();
    let entry = [
        &b"PK\x01\x02\x14\0\x14\0\0\0\x08\0\0\0\0\0"[..],
        &sizes,
        &lengths,
        &[0; 14],
        name,
        &extra,
    ]
    .concat();
    let end = [
        &b"PK\x05\x06\0\0\0\0\x01\0\x01\0"[..],
        &small(entry.len() as u64),
        &small(local.len() as u64),
        &[0, 0],
    ]
    .concat();
    [local, entry, end].concat()
}

#[test]
fn a_zip_bomb_is_refused_before_it_is_inflated() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bomb.npz");
    // 8 MB that claim to inflate to 2 GB, and 1 kB that claims to inflate to 2 GB, which is impossible for deflate.
    fs::write(&path, archive_of_zeros(2_000_000_000, &vec![0; 8_000_000])).expect("written");
    let error = refused(&path);
    assert!(
        matches!(
            error.problem,
            Problem::TooLarge {
                size: 2_000_000_000,
                ..
            }
        ),
        "{error}"
    );
    fs::write(&path, archive_of_zeros(2_000_000_000, &[0; 1_000])).expect("written");
    let message = refused(&path).to_string();
    assert!(message.contains("at most 1032000"), "{message}");
    fs::write(&path, archive_of_zeros(1 << 50, &[0; 1_000])).expect("written");
    let message = refused(&path).to_string();
    assert!(
        message.contains("claims to inflate to 1125899906842624"),
        "{message}"
    );
}

#[test]
fn encrypted_and_otherwise_packed_members_are_refused_by_name() {
    let whole = fs::read(at("npz-stored/run.npz")).expect("readable");
    let entry = whole
        .windows(4)
        .rposition(|bytes| bytes == b"PK\x01\x02")
        .expect("an entry");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.npz");
    // Flags are 8 bytes after the start of an entry, the method is 10 bytes after it.
    for (at, value, expected) in [
        (8, 1, "`obj.npy` is encrypted"),
        (10, 12, "`obj.npy` is compressed by method 12"),
    ] {
        let mut changed = whole.clone();
        changed[entry + at] = value;
        fs::write(&path, changed).expect("written");
        let message = refused(&path).to_string();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_member_that_was_changed_is_found_by_its_checksum() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.npz");
    let mut bytes = fs::read(at("npz-stored/run.npz")).expect("readable");
    bytes[100_000] ^= 1;
    fs::write(&path, &bytes).expect("written");
    let file = ArrayFile::open(&path, ArrayFormat::Npz).expect("its headers are whole");
    let error = file
        .read("images", 0..1)
        .expect_err("a flipped bit in another row");
    assert!(matches!(error.problem, Problem::Checksum { .. }), "{error}");
    assert!(file.read("ft", 0..24).is_ok(), "others are whole");
}

#[test]
fn an_array_of_numpy_that_is_longer_or_shorter_than_its_header_says_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ft.npy");
    let bytes = fs::read(at("npy-fortran/ft.npy")).expect("readable");
    fs::write(&path, &bytes[..bytes.len() - 1]).expect("written");
    let message = refused(&path).to_string();
    assert!(
        message.contains("byte 1279: the end, expected the end at byte 1280"),
        "{message}"
    );
    fs::write(&path, [bytes.as_slice(), b"x"].concat()).expect("written");
    assert!(
        refused(&path)
            .to_string()
            .contains("expected the end at byte 1280")
    );
}
