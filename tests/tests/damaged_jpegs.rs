//! Tests of damaged JPEGs: truncated, closed after a truncation, with bytes removed or changed. Pictures about which libjpeg warns are rejected. No
//! intact picture is rejected.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_core::SilentProgress;
use taceva_import::{ImportError, ImportMap, ImportPlan};
use taceva_needs::{Need, skip};
use taceva_tests::{Form, Lab, Random, recording, root, scratch};

const SEED: u64 = 20_261_123;
/// Number of pictures for each kind of damage.
const DAMAGED: usize = 100;
/// Number of real pictures to damage, in addition to the drawn ones.
const REAL: usize = 20;
const END: [u8; 2] = [0xFF, 0xD9];

/// Damage of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Damage {
    Cut,
    CutAndClosed,
    BytesMissing,
    BytesChanged,
}

const DAMAGES: [Damage; 4] = [
    Damage::Cut,
    Damage::CutAndClosed,
    Damage::BytesMissing,
    Damage::BytesChanged,
];

impl Damage {
    fn of(self, whole: &[u8], random: &mut Random) -> Vec<u8> {
        let (begin, end) = entropy_coded(whole);
        let at = begin + random.below(end - begin);
        match self {
            Damage::Cut => whole[..at].to_vec(),
            Damage::CutAndClosed => [&whole[..at], &END].concat(),
            Damage::BytesMissing => {
                let count = [1, 2, 8, 50, 500][random.below(5)];
                [&whole[..at], &whole[(at + count).min(end)..]].concat()
            }
            Damage::BytesChanged => {
                let mut bytes = whole.to_vec();
                for _ in 0..=3 * random.below(2) {
                    let at = begin + random.below(end - begin);
                    bytes[at] ^= u8::try_from(1 + random.below(255)).expect("a byte");
                }
                bytes
            }
        }
    }
}

/// Offsets of the first compressed byte and of the end marker in a JPEG.
fn entropy_coded(whole: &[u8]) -> (usize, usize) {
    let scan = whole.windows(2).position(|pair| pair == [0xFF, 0xDA]);
    let scan = scan.expect("a scan");
    let length = usize::from(whole[scan + 2]) << 8 | usize::from(whole[scan + 3]);
    let end = whole.windows(2).rposition(|pair| pair == END);
    (scan + 2 + length, end.expect("an end"))
}

/// Drawn pictures as encoders write them, and some real ones if available.
fn whole_pictures() -> Vec<(PathBuf, Vec<u8>)> {
    let mut paths = jpegs_below(&root().join("crates/recordings/dataset/tests/fixtures/jpeg"));
    assert!(paths.len() >= 12, "{paths:?}");
    if let Some(folder) = recording("gelsight-wedge-grasp") {
        let real = jpegs_below(&folder);
        paths.extend(real.iter().step_by(real.len() / REAL).take(REAL).cloned());
    }
    let read = |path: PathBuf| {
        let bytes = std::fs::read(&path).expect("a picture");
        (path, bytes)
    };
    paths.into_iter().map(read).collect()
}

fn jpegs_below(folder: &Path) -> Vec<PathBuf> {
    let entries = folder.read_dir().expect("a folder").flatten();
    let mut found: Vec<PathBuf> = entries
        .flat_map(|entry| match entry.path() {
            path if path.is_dir() => jpegs_below(&path),
            path => vec![path],
        })
        .filter(|path| path.extension().is_some_and(|extension| extension == "jpg"))
        .collect();
    found.sort();
    found
}

/// Imports a folder whose only picture has the content `bytes`.
fn import(bytes: &[u8]) -> Result<(), ImportError> {
    let is_gray = |bytes: &[u8]| {
        let frame = bytes
            .windows(2)
            .position(|pair| matches!(pair, [0xFF, 0xC0 | 0xC2]));
        frame.and_then(|frame| bytes.get(frame + 9)) == Some(&1)
    };
    let order = if is_gray(bytes) { "gray" } else { "rgb" };
    let lab = Lab::new(Form::Jpeg, order, &[bytes.to_vec()]);
    let map = ImportMap::read(&lab.map())?;
    let folder = scratch();
    ImportPlan::new(lab.path(), &map)?
        .run(
            &folder.path().join("set"),
            NonZeroUsize::MIN,
            &SilentProgress,
        )
        .map(drop)
}

/// True if the program `djpeg` of libjpeg warns about a picture; `None` if it is not installed.
fn libjpeg_warns(bytes: &[u8], folder: &Path) -> Option<bool> {
    let path = folder.join("picture.jpg");
    std::fs::write(&path, bytes).expect("room for a picture");
    let mut djpeg = Command::new("djpeg");
    djpeg.args(["-outfile", "/dev/null"]).arg(&path);
    let output = djpeg.output().ok()?;
    Some(!output.status.success() || !output.stderr.is_empty())
}

#[test]
fn whole_jpegs_of_every_kind_are_imported() {
    for (path, bytes) in whole_pictures() {
        let imported = import(&bytes);
        assert!(imported.is_ok(), "{}: {imported:?}", path.display());
    }
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn every_jpeg_that_libjpeg_warns_of_is_refused() {
    let pictures = whole_pictures();
    let mut random = Random::new(SEED);
    let folder = scratch();
    let is_there = libjpeg_warns(&pictures[0].1, folder.path()).is_some();
    if !is_there {
        skip(
            Need::Libjpeg,
            "`djpeg` is not on the path, so cuts alone are judged",
        );
    }
    for damage in DAMAGES {
        let (mut refused, mut warned, mut neither) = (0, 0, 0);
        for number in 0..DAMAGED {
            let (path, whole) = &pictures[random.below(pictures.len())];
            let bytes = damage.of(whole, &mut random);
            let imported = import(&bytes);
            let warns = libjpeg_warns(&bytes, folder.path()).unwrap_or(false);
            let context = format!("seed {SEED}, {damage:?} {number}, {}", path.display());
            // A cut between two scans leaves whole scans, which decode to a picture with missing detail.
            if matches!(damage, Damage::Cut | Damage::CutAndClosed) || warns {
                assert!(imported.is_err(), "accepted: {context}");
            }
            refused += usize::from(imported.is_err());
            warned += usize::from(warns);
            neither += usize::from(imported.is_ok() && !warns);
        }
        eprintln!(
            "{damage:?}: {refused} of {DAMAGED} refused, libjpeg warns of {warned}, neither of {neither}"
        );
    }
}
