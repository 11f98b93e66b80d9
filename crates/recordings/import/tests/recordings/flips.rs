//! Single bits are flipped in labels, pictures and indices of every form: what a checksum covers is refused, and nothing vanishes without a word.
//! `TACEVA_FLIPS=2000 cargo test --workspace --test import recordings::flips -- --nocapture` tries as many in all and prints the counts by form.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, Digest};
use taceva_import::{Decoders, ImportError, ImportMap, ImportPlan};

use super::{copy, folder};
use crate::support::Random;

/// In all, where nobody asks for more.
const FLIPS: usize = 100;
/// Bytes at both ends of a file, where headers and indices lie.
const ENDS: usize = 512;
/// Forms whose every byte of labels and pictures is covered by a checksum of the file.
const COVERED: [&str; 2] = ["npz-", "mcap-"];

/// An import, as far as a flip may change it.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    digest: Digest,
    rows: usize,
    /// Rows without a picture, or whose picture is of one colour.
    bare: usize,
    /// The summary of the import, its warnings too.
    words: String,
}

/// The import of the folder, or why it is refused.
fn seen(folder: &Path, map: &ImportMap) -> Result<Seen, ImportError> {
    let targets = tempfile::tempdir().expect("a folder");
    let target = targets.path().join("dataset");
    let plan = ImportPlan::with_decoders(folder, map, &Decoders::default())?;
    let words = plan.summary().to_string();
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)?;
    let dataset = Dataset::open(&target)?;
    let mut bare = 0;
    for row in dataset.all_rows() {
        let frame = dataset.frame(row)?;
        let bytes = frame.as_ref().map_or(&[][..], |frame| frame.bytes());
        bare += usize::from(bytes.windows(2).all(|pair| pair[0] == pair[1]));
    }
    Ok(Seen {
        digest: dataset.digest(),
        rows: dataset.table().rows(),
        bare,
        words,
    })
}

/// The files of a recording, but for what belongs to the tests.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        if path.is_dir() {
            found.extend(files(&path));
        } else if name != "map.toml" && name != "expected.json" {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// A place in a file of so many bytes: anywhere, or every other time near one of its ends.
fn place(random: &mut Random, length: usize, number: usize) -> usize {
    let near = length.min(ENDS);
    match number % 4 {
        1 => random.below(near),
        3 => length - 1 - random.below(near),
        _ => random.below(length),
    }
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn no_flipped_bit_makes_a_row_or_a_picture_vanish_without_a_word() {
    let wanted = std::env::var("TACEVA_FLIPS").ok();
    let wanted = wanted.and_then(|text| text.parse().ok()).unwrap_or(FLIPS);
    let mut random = Random::new(0x2026_1128);
    let mut forms: Vec<PathBuf> = std::fs::read_dir(folder(""))
        .expect("recordings")
        .flatten()
        .map(|entry| entry.path())
        .collect();
    forms.sort();
    let mut counts: BTreeMap<String, BTreeMap<&str, usize>> = BTreeMap::new();
    let mut wrong = Vec::new();
    let each = wanted.div_ceil(forms.len());
    for form in forms {
        let Ok(map) = ImportMap::read(&form.join("map.toml")) else {
            continue;
        };
        let lab = tempfile::tempdir().expect("a folder");
        copy(&form, lab.path());
        // What needs a decoder that is not here is refused whole.
        let Ok(whole) = seen(lab.path(), &map) else {
            continue;
        };
        let name = form.file_name().expect("a name").to_string_lossy();
        let is_covered = COVERED.iter().any(|covered| name.starts_with(covered));
        let mut all = files(lab.path());
        all.retain(|path| path.metadata().is_ok_and(|facts| facts.len() > 0));
        for number in 0..each {
            let path = &all[random.below(all.len())];
            let bytes = std::fs::read(path).expect("there");
            let (at, bit) = (place(&mut random, bytes.len(), number), random.below(8));
            let mut flipped = bytes.clone();
            flipped[at] ^= 1 << bit;
            std::fs::write(path, &flipped).expect("written");
            let found = seen(lab.path(), &map);
            std::fs::write(path, &bytes).expect("written");
            let outcome = match &found {
                Err(_) => "refused",
                Ok(found) if found.digest == whole.digest => "equal",
                Ok(found) if found.words != whole.words => "other, with a word",
                Ok(found) if found.rows < whole.rows || found.bare > whole.bare => "VANISHED",
                Ok(_) => "other",
            };
            let is_wrong = outcome == "VANISHED" || (is_covered && outcome.starts_with("other"));
            if is_wrong {
                let file = path.strip_prefix(lab.path()).unwrap_or(path).display();
                wrong.push(format!("{name}: byte {at} bit {bit} of {file}: {outcome}"));
            }
            *counts
                .entry(name.to_string())
                .or_default()
                .entry(outcome)
                .or_default() += 1;
        }
    }
    for (name, counts) in &counts {
        eprintln!("{name}: {counts:?}");
    }
    assert!(wrong.is_empty(), "{} silent: {wrong:#?}", wrong.len());
}
