//! Tests of every file in `tests/recordings`, truncated or with flipped bits. An import must succeed, or be rejected and leave no files. A caught panic of a
//! third-party decoder counts as a rejection.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::SilentProgress;
use taceva_import::{Decoders, ImportMap, ImportPlan, MapDraft};

use super::{copy, folder};

/// Number of truncated copies of each file. `FLIPS` is the number of copies with a flipped bit.
const CUTS: u64 = 2;
const FLIPS: u64 = 6;

/// Files below `folder`, except pictures, which have separate tests, and files that only the tests read.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        if path.is_dir() {
            files(&path, found);
        } else if name != "map.toml" && name != "expected.json" && !name.ends_with(".png") {
            found.push(path);
        }
    }
}

/// Pseudorandom numbers from a seed.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % end.max(1) as u64).expect("below the end")
    }
}

fn damaged(bytes: &[u8], number: u64, numbers: &mut Numbers) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    match number < CUTS {
        true => damaged.truncate(numbers.below(bytes.len())),
        false => {
            // Headers are changed as often as the rest.
            let within = if number.is_multiple_of(2) {
                bytes.len()
            } else {
                bytes.len().min(512)
            };
            damaged[numbers.below(within)] ^= 1 << numbers.below(8);
        }
    }
    damaged
}

/// Imports the folder and drafts a map for it. Returns true if the import is rejected.
fn is_refused(folder: &Path, map: &ImportMap) -> bool {
    let targets = tempfile::tempdir().expect("a folder");
    let target = targets.path().join("dataset");
    let plan = ImportPlan::with_decoders(folder, map, &Decoders::default());
    let outcome = plan.and_then(|plan| plan.run(&target, NonZeroUsize::MIN, &SilentProgress));
    if let Err(error) = &outcome {
        let message = error.to_string();
        assert!(!message.contains("panicked at taceva"), "{message}");
        assert_eq!(
            std::fs::read_dir(targets.path()).expect("there").count(),
            0,
            "{message}"
        );
    }
    drop(MapDraft::of(folder));
    outcome.is_err()
}

#[test]
fn a_damaged_file_of_any_form_is_refused_in_words_or_read_and_leaves_nothing_behind() {
    let mut numbers = Numbers(0x2026_1123);
    let mut counts = (0, 0);
    for entry in std::fs::read_dir(folder("")).expect("recordings").flatten() {
        let own = entry.path();
        let Ok(map) = ImportMap::read(&own.join("map.toml")) else {
            continue;
        };
        let lab = tempfile::tempdir().expect("a folder");
        copy(&own, lab.path());
        let mut all = Vec::new();
        files(lab.path(), &mut all);
        all.sort();
        // Chunked stores have many similar files.
        for file in all.iter().step_by(all.len() / 8 + 1) {
            let bytes = std::fs::read(file).expect("there");
            if bytes.is_empty() {
                continue;
            }
            for number in 0..CUTS + FLIPS {
                std::fs::write(file, damaged(&bytes, number, &mut numbers)).expect("written");
                counts.0 += 1;
                counts.1 += u32::from(is_refused(lab.path(), &map));
            }
            std::fs::write(file, &bytes).expect("written");
        }
    }
    let (made, refused) = counts;
    assert!(
        made > 400 && refused > made / 4,
        "{refused} of {made} were refused"
    );
}
