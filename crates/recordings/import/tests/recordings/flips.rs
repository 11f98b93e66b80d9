//! Tests that flip single bits in labels, pictures and indices of every form. A flip under a checksum must be rejected, and no data may be missing without a
//! message. `TACEVA_FLIPS=2000 cargo test --workspace --test import recordings::flips -- --nocapture` sets the total number and prints the counts by form.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, Digest};
use taceva_import::{Decoders, ImportError, ImportMap, ImportPlan, Preset};
use tempfile::TempDir;

use super::{copy, folder};
use crate::support::Random;

/// Default total number of flips.
const FLIPS: usize = 100;
/// Number of bytes at each end of a file that contain headers and indices.
const ENDS: usize = 512;
/// Forms in which checksums in the file cover all labels and pictures.
const COVERED: [&str; 4] = ["npz-", "mcap-", "bz2.bag", "packed-5.mat"];
/// Samples of the readers, below `crates/formats`, each with its column of forces. Samples without a column are ROS recordings.
const SAMPLES: [(&str, Option<&str>); 13] = [
    ("tables/tests/data/bags/bz2.bag", None),
    ("tables/tests/data/bags/lz4.bag", None),
    ("tables/tests/data/bags/none.bag", None),
    ("tables/tests/data/bags/humble.db3", None),
    ("tables/tests/data/bags/iron.db3", None),
    ("tables/tests/data/bags/messages.db3", None),
    ("tables/tests/data/bags/small_pages.db3", None),
    ("tables/tests/data/arrow/lz4.feather", Some("single")),
    ("tables/tests/data/arrow/stream.arrow", Some("single")),
    ("tables/tests/data/arrow/zstd.arrow", Some("single")),
    ("arrays/tests/data/matlab/packed-5.mat", Some("x_f8[0]")),
    ("arrays/tests/data/matlab/plain-5.mat", Some("x_f8[0]")),
    ("arrays/tests/data/matlab/seven-3.mat", Some("x_f8[0]")),
];

/// Copy of a recording, and its map.
struct Subject {
    name: String,
    lab: TempDir,
    map: ImportMap,
}

/// Every recording of `tests/recordings`, and the samples of the readers.
fn subjects() -> Vec<Subject> {
    let mut forms: Vec<PathBuf> = std::fs::read_dir(folder(""))
        .expect("recordings")
        .flatten()
        .map(|entry| entry.path())
        .collect();
    forms.sort();
    let mut subjects = Vec::new();
    for form in forms {
        let Ok(map) = ImportMap::read(&form.join("map.toml")) else {
            continue;
        };
        let lab = tempfile::tempdir().expect("a folder");
        copy(&form, lab.path());
        subjects.push(Subject {
            name: name_of(&form),
            lab,
            map,
        });
    }
    let formats = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../formats");
    for (sample, column) in SAMPLES {
        let lab = tempfile::tempdir().expect("a folder");
        let name = name_of(sample.as_ref());
        std::fs::copy(formats.join(sample), lab.path().join(&name)).expect("copied");
        let map = match column {
            Some(column) => ImportMap::parse("map.toml".as_ref(), &map_of(&name, column)),
            None => Preset::from_name("rosbag").expect("known").map(lab.path()),
        };
        let map = map.unwrap_or_else(|error| panic!("{name}: {error}"));
        subjects.push(Subject { name, lab, map });
    }
    subjects
}

fn name_of(path: &Path) -> String {
    let name = path.file_name().expect("a name");
    name.to_string_lossy().into_owned()
}

/// Text of the map of `table`, with forces in `column`.
fn map_of(table: &str, column: &str) -> String {
    format!(
        "map_version = 2\nsource = \"synthetic\"\ntable = \"{table}\"\n[columns]\nFz = {{ from = \"{column}\", unit = \"N\" }}\n\
         [time]\nclock = \"unknown\"\n\
         [sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n"
    )
}

/// Result of an import, reduced to what a flip may change.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    digest: Digest,
    rows: usize,
    /// Number of rows without a picture, or with a uniform picture.
    bare: usize,
    /// Summary of the import, with its warnings.
    words: String,
}

/// Imports the folder. The error is the rejection.
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

/// Files of a recording, except files that only the tests read.
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

/// Offset in a file of `length` bytes: near the beginning or the end for every second `number`, otherwise anywhere.
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
    let mut counts: BTreeMap<String, BTreeMap<&str, usize>> = BTreeMap::new();
    let mut wrong = Vec::new();
    let subjects = subjects();
    let each = wanted.div_ceil(subjects.len());
    for Subject { name, lab, map } in subjects {
        // Recordings that need a missing decoder are skipped.
        let Ok(whole) = seen(lab.path(), &map) else {
            continue;
        };
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
                .entry(name.clone())
                .or_default()
                .entry(outcome)
                .or_default() += 1;
        }
    }
    for (name, counts) in &counts {
        eprintln!("{name}: {counts:?}");
    }
    for (sample, _) in SAMPLES {
        let name = name_of(sample.as_ref());
        assert!(counts.contains_key(&name), "{name} was not imported");
    }
    assert!(wrong.is_empty(), "{} silent: {wrong:#?}", wrong.len());
}
