//! Tests with truncated files and flipped bits. Each file gives a typed error or a result, never a panic, a hang or a large allocation.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use taceva_arrays::{ArrayFile, ArrayFormat};

use crate::digest::{SHARED, at, data};

/// Number of rows read from one array at a time.
const ROWS: u64 = 8;

/// Opens a file and reads all of it, up to the first error.
pub(crate) fn read_all(path: &Path, format: ArrayFormat) -> Result<(), String> {
    let file = ArrayFile::open(path, format).map_err(|error| error.to_string())?;
    let mut result = Ok(());
    for name in file.names() {
        let rows = file.info(&name).expect("listed").rows();
        // A damaged shape may have billions of empty rows.
        for start in (0..rows.min(200)).step_by(8) {
            if let Err(error) = file.read(&name, start..(start + ROWS).min(rows)) {
                result = Err(error.to_string());
            }
        }
    }
    for group in file.groups("/*") {
        let _ = file.attribute(&group, "object");
    }
    result
}

/// Reproducible generator of numbers (splitmix64).
struct Seeded(u64);

impl Seeded {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) % limit
    }
}

fn files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let is_store = path.extension().is_some_and(|ending| ending == "zarr");
        if path.is_dir() && !is_store {
            files(&path, into);
        } else if ArrayFormat::of(&path).is_some() {
            into.push(path);
        }
    }
}

/// Damages `bytes` in several ways. Calls `look` with a description and the bytes of each result.
pub(crate) fn damaged(bytes: &[u8], seed: u64, mut look: impl FnMut(&str, &[u8])) {
    for sixth in 0..6 {
        look(
            &format!("cut at {sixth} sixths"),
            &bytes[..bytes.len() * sixth / 6],
        );
    }
    let mut seeded = Seeded(seed);
    let length = bytes.len() as u64;
    for flip in 0..40 {
        // Half of them near the beginning or the end, the places of headers and directories.
        let at = match flip % 4 {
            0 => seeded.below(length.min(512)),
            1 => length - 1 - seeded.below(length.min(512)),
            _ => seeded.below(length),
        };
        let bit = seeded.below(8);
        let mut flipped = bytes.to_vec();
        flipped[usize::try_from(at).expect("small")] ^= 1 << bit;
        look(&format!("bit {bit} of byte {at} flipped"), &flipped);
    }
}

#[test]
fn damaged_files_are_refused_or_read_and_never_panic() {
    let mut all = Vec::new();
    files(&data(), &mut all);
    for name in SHARED {
        files(&at(name), &mut all);
    }
    all.sort_unstable();
    let folder = tempfile::tempdir().expect("a folder");
    let mut bad = Vec::new();
    let (mut refused, mut looked) = (0, 0);
    for (seed, path) in all.iter().enumerate() {
        let format = ArrayFormat::of(path).expect("known");
        if path.is_dir() {
            continue;
        }
        let copy = folder.path().join(path.file_name().expect("a name"));
        damaged(
            &fs::read(path).expect("readable"),
            seed as u64,
            |what, bytes| {
                fs::write(&copy, bytes).expect("writable");
                looked += 1;
                let begun = Instant::now();
                match catch_unwind(AssertUnwindSafe(|| read_all(&copy, format))) {
                    Ok(Ok(())) => {}
                    Ok(Err(message)) => {
                        refused += 1;
                        assert!(message.len() < 4_000, "{message}");
                    }
                    Err(_) => bad.push(format!("{}: {what}: panicked", path.display())),
                }
                if begun.elapsed() > Duration::from_secs(60) {
                    bad.push(format!("{}: {what}: {:?}", path.display(), begun.elapsed()));
                }
            },
        );
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
    assert!(refused > looked / 8, "{refused} of {looked} were refused");
}
