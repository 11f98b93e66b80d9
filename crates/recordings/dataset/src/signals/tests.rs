use std::fs::{self, File};
use std::path::{Path, PathBuf};

use taceva_core::{SignalInfo, Unit};

use super::*;
use crate::error::DatasetError;

fn spec() -> SignalsSpec {
    let info = SignalInfo::new(5, 1, 3, Unit::Microtesla).expect("fifteen numbers");
    SignalsSpec::new(info, ["x", "y", "z"]).expect("three names")
}

/// Distinct numbers for `row`, including a negative zero and the least positive number.
fn values(row: u16) -> Vec<f32> {
    let own = |place: u16| f32::from(row) * 1.25 - f32::from(place) / 3.0;
    let mut values: Vec<f32> = (0..15).map(own).collect();
    values[3] = -0.0;
    values[4] = f32::from_bits(1);
    values
}

fn written(folder: &Path, rows: u16) -> (PathBuf, SignalsInfo) {
    let path = folder.join("signals.parquet");
    let mut writer = SignalsWriter::create(&path, &spec()).expect("created");
    for row in 0..rows {
        writer.push(&values(row)).expect("written");
    }
    (path, writer.finish().expect("finished"))
}

fn opened(path: &Path, info: &SignalsInfo, rows: u64) -> Result<SignalsReader, DatasetError> {
    SignalsReader::open(path, File::open(path).expect("there"), info, rows)
}

#[test]
fn every_bit_comes_back_in_any_order() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, info) = written(folder.path(), 300);
    let reader = opened(&path, &info, 300).expect("opens");
    reader.verify().expect("whole");
    for row in [299, 0, 150, 7, 299] {
        let found = reader.row(usize::from(row)).expect("there");
        let bits = |values: &[f32]| {
            values
                .iter()
                .map(|value| value.to_bits())
                .collect::<Vec<_>>()
        };
        assert_eq!(bits(found.values()), bits(&values(row)));
    }
    assert!(reader.row(300).is_err());
}

#[test]
fn many_row_groups_are_read_as_one_and_few_are_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let info = SignalInfo::new(128, 128, 1, Unit::Count).expect("as many as there may be");
    let spec = SignalsSpec::new(info, ["pressure"]).expect("one name");
    let path = folder.path().join("signals.parquet");
    let mut writer = SignalsWriter::create(&path, &spec).expect("created");
    let rows = 64 * (2 + 16) + 5;
    for row in 0..rows {
        let value = u16::try_from(row).expect("few");
        writer
            .push(&vec![f32::from(value); 16_384])
            .expect("written");
    }
    let info = writer.finish().expect("finished");
    let reader = opened(&path, &info, rows as u64).expect("opens");
    reader.verify().expect("whole");
    for row in [0, 63, 64, rows - 1, 0] {
        let found = reader.row(row).expect("there");
        let expected = u16::try_from(row).map(f32::from).expect("few");
        assert!(
            found
                .values()
                .iter()
                .all(|value| value.to_bits() == expected.to_bits())
        );
    }
}

#[test]
fn the_same_rows_give_the_same_bytes() {
    let [left, right] = [(), ()].map(|()| tempfile::tempdir().expect("a folder"));
    let bytes = |folder: &tempfile::TempDir| fs::read(written(folder.path(), 40).0).expect("read");
    assert_eq!(bytes(&left), bytes(&right));
}

#[test]
fn what_is_no_row_of_them_is_refused_by_its_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("signals.parquet");
    let mut writer = SignalsWriter::create(&path, &spec()).expect("created");
    writer.push(&values(0)).expect("written");
    let message = writer.push(&[0.0; 14]).expect_err("one short").to_string();
    assert!(
        message.contains("row 1: 14 signals, expected 15"),
        "{message}"
    );
    let mut broken = values(1);
    broken[6] = f32::NAN;
    let message = writer.push(&broken).expect_err("no number").to_string();
    assert!(message.contains("row 1: signal 6 is NaN"), "{message}");
    let beyond = spec().with_rest([[0, 1]]);
    let writer = SignalsWriter::create(&path, &beyond).expect("created");
    let message = writer.finish().expect_err("no such rows").to_string();
    assert!(message.contains("rows 0 to 1"), "{message}");
}

#[test]
fn any_flipped_bit_and_any_cut_is_noticed_before_a_number_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, info) = written(folder.path(), 40);
    let bytes = fs::read(&path).expect("read");
    for at in 0..bytes.len() {
        let mut flipped = bytes.clone();
        flipped[at] ^= 1 << (at % 8);
        fs::write(&path, &flipped).expect("written");
        let error = opened(&path, &info, 40).expect_err("damaged");
        assert!(matches!(error, DatasetError::Digest { .. }), "{error}");
    }
    for at in (0..bytes.len()).step_by(97) {
        fs::write(&path, &bytes[..at]).expect("written");
        assert!(opened(&path, &info, 40).is_err(), "cut at {at}");
    }
}

#[test]
fn a_stranger_who_knows_the_digest_gets_an_error_and_no_panic() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, info) = written(folder.path(), 40);
    let bytes = fs::read(&path).expect("read");
    let mut noticed = 0;
    for at in 0..bytes.len() {
        let mut flipped = bytes.clone();
        flipped[at] ^= 1 << (at % 8);
        fs::write(&path, &flipped).expect("written");
        let lying = SignalsInfo {
            sha256: crate::digest::Digest::of(&flipped),
            ..info.clone()
        };
        let read = opened(&path, &lying, 40).and_then(|reader| reader.verify());
        noticed += usize::from(read.is_err());
    }
    // The remaining bits do not affect numbers: names of programs and unused page sizes.
    assert!(
        noticed * 4 > bytes.len() * 3,
        "{noticed} of {}",
        bytes.len()
    );
    let (_, info) = written(folder.path(), 40);
    for (rows, other) in [
        (39, info.clone()),
        (41, info.clone()),
        (40, other_grid(&info)),
    ] {
        assert!(opened(&path, &other, rows).is_err());
    }
}

/// Facts about the same file, but for a grid of 3 × 5 taxels with one value each.
fn other_grid(info: &SignalsInfo) -> SignalsInfo {
    let grid = SignalInfo::new(3, 5, 1, Unit::Microtesla).expect("fifteen numbers");
    SignalsInfo {
        spec: SignalsSpec::new(grid, ["x"]).expect("one name"),
        ..info.clone()
    }
}
