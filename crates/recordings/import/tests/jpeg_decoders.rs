//! Compares pixels of the JPEG decoder of TacEva with libjpeg, the most common decoder, on pictures of every kind.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan};
use taceva_needs::{Need, skip};

/// Maximum difference that `docs/your-recording.md` states, out of 255 levels.
const MOST: u8 = 3;

/// Pixels of the picture at `path` from the decoder of TacEva.
fn ours(path: &Path, order: &str) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    fs::copy(path, folder.path().join("1.jpg")).expect("copied");
    fs::write(folder.path().join("labels.csv"), "file,Fz\n1.jpg,1\n").expect("written");
    let text = format!(
        "map_version = 2\ntable = \"labels.csv\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"{order}\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\n[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n"
    );
    let map = ImportMap::parse("map.toml".as_ref(), &text).expect("a map");
    let target = folder.path().join("dataset");
    let plan = ImportPlan::new(folder.path(), &map).expect("planned");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let frame = dataset.frame(0).expect("decoded").expect("there");
    frame.bytes().to_vec()
}

/// Pixels of the picture at `path` from `djpeg` of libjpeg; `None` if `djpeg` is not installed.
fn libjpegs(path: &Path) -> Option<Vec<u8>> {
    let output = Command::new("djpeg")
        .args(["-dct", "int", "-pnm"])
        .arg(path)
        .output();
    let bytes = output.ok()?.stdout;
    // `P6`, width, height and 255, each at the end of a line; the pixels follow.
    let mut ends = bytes.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
    let (header, _) = ends.nth(2).expect("a header of three lines");
    Some(bytes[header + 1..].to_vec())
}

/// Maximum and mean absolute difference over all pixel values, levels.
fn difference(ours: &[u8], theirs: &[u8]) -> (u8, f64) {
    assert_eq!(ours.len(), theirs.len());
    let each = ours.iter().zip(theirs).map(|(a, b)| a.abs_diff(*b));
    let sum: u32 = each.clone().map(u32::from).sum();
    let count = u32::try_from(ours.len()).expect("small");
    (each.max().unwrap_or(0), f64::from(sum) / f64::from(count))
}

#[test]
#[expect(clippy::print_stdout, reason = "the differences are the result")]
fn pixels_of_jpeg_are_those_of_libjpeg_within_the_stated_levels() {
    let fixtures = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../dataset/tests/fixtures/jpeg"
    );
    let entries = fs::read_dir(fixtures).expect("a folder").flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "jpg"));
    paths.sort();
    assert!(paths.len() >= 12, "{paths:?}");
    for path in paths {
        let Some(theirs) = libjpegs(&path) else {
            return skip(Need::Libjpeg, "no `djpeg` is on the PATH");
        };
        let name = path
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let order = if name.contains("gray") { "gray" } else { "rgb" };
        let (most, mean) = difference(&ours(&path, order), &theirs);
        println!("{name}: at most {most}, {mean:.3} in the mean");
        assert!(most <= MOST, "{name}: {most} levels");
    }
}
