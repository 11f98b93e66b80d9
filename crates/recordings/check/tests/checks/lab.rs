//! Generated folder of a lab, imported and checked.

use std::num::NonZeroUsize;

use taceva_check::{CheckReport, CheckRequest, check};
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan};

/// Sensor section of all maps in these tests, with unknown facts.
pub(super) const SENSOR: &str =
    "[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n";

/// Frame section for the pictures of these tests, which are in an array.
pub(super) const PICTURES: &str =
    "[frame]\narray = { file = \"f.npy\" }\nchannel_order = \"gray\"\nreference = \"unknown\"\n";

/// Width of a picture, pixels. `HEIGHT` is its height.
const WIDTH: u32 = 24;
const HEIGHT: u32 = 16;

/// Gray pictures as a NumPy file, one for each of `presses`. A press darkens the middle, and the noise differs between pictures.
pub(super) fn pictures(presses: &[f64]) -> Vec<u8> {
    let shape = format!("({}, {HEIGHT}, {WIDTH})", presses.len());
    let header = format!("{{'descr': '|u1', 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = u16::try_from(header.len()).expect("short");
    let mut bytes = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
    bytes.extend(header.into_bytes());
    for (number, press) in (0_u32..).zip(presses) {
        for pixel in 0..WIDTH * HEIGHT {
            let (x, y) = (pixel % WIDTH, pixel / WIDTH);
            let away = f64::from(x.abs_diff(WIDTH / 2)).hypot(f64::from(y.abs_diff(HEIGHT / 2)));
            let noise = (pixel + 977 * number)
                .wrapping_mul(2_654_435_761)
                .rotate_left(13)
                % 9;
            let light = 120.0 + f64::from(noise) - 30.0 * press * (-away * away / 20.0).exp();
            let byte = (0..=255_u8).find(|byte| f64::from(*byte) >= light);
            bytes.push(byte.unwrap_or(255));
        }
    }
    bytes
}

/// Imports a folder with `files` by `map`, and runs the checks with the codes `only`.
pub(super) fn imported(files: &[(&str, Vec<u8>)], map: &str, only: &[&str]) -> CheckReport {
    imported_and_split(files, map, only, None)
}

/// Imports and checks like [`imported`], with the split `split`.
pub(super) fn imported_and_split(
    files: &[(&str, Vec<u8>)],
    map: &str,
    only: &[&str],
    split: Option<&str>,
) -> CheckReport {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).expect("written");
    }
    let map = ImportMap::parse("map.toml".as_ref(), map).expect("a map");
    let plan = ImportPlan::new(folder.path(), &map).expect("planned");
    let target = folder.path().join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let request = CheckRequest {
        only: only.iter().map(|code| (*code).to_owned()).collect(),
        split: split.map(str::to_owned),
        seed: 0,
        jobs: NonZeroUsize::MIN,
    };
    check(&dataset, &request, &SilentProgress).expect("checked")
}

/// Numbers in the column `name` of a comma-separated table.
pub(super) fn column(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let at = header.iter().position(|column| *column == name);
    let at = at.expect("the column");
    lines
        .map(|line| {
            let cell = line.split(',').nth(at).expect("a cell");
            cell.parse().expect("a number")
        })
        .collect()
}
