//! Tests of rows with several pictures: fingers of a gripper, eyes of a sensor.

mod added;
mod drafts;
mod exported;
mod refused;

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::{Frame, SilentProgress};
use taceva_dataset::Dataset;
use taceva_import::{ImportError, ImportMap, ImportPlan, MapDraft};
use tempfile::TempDir;

use crate::lab::{png, rgb_png};

pub(super) const ROWS: u32 = 6;

/// Map sections of time and sensor.
pub(super) const FACTS: &str = "[time]\nclock = \"unknown\"\n[sensor]\nmodel = \"gripper\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n";

/// Map with two views, left and right, whose pictures are named in two columns.
pub(super) const TWO: &str = "map_version = 2\ntable = \"labels.csv\"\n\
    [[frame]]\nname = \"left\"\ncolumn = \"left_path\"\nchannel_order = \"gray\"\nreference = \"left/rest.png\"\n\
    [[frame]]\nname = \"right\"\ncolumn = \"right_path\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n\
    [columns]\nFz = { from = \"Fz_N\", unit = \"N\" }\n";

pub(super) fn two() -> String {
    format!("{TWO}{FACTS}")
}

/// Folder of a gripper with two fingers: gray pictures of 48 × 36 on the left and of 60 × 36 on the right. All pictures differ.
pub(super) fn gripper() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fill(folder.path(), 0, ROWS);
    folder
}

/// Writes a table of `rows` rows and their pictures of both fingers into `folder`, beginning with row `first`.
pub(super) fn fill(folder: &Path, first: u32, rows: u32) {
    let mut table = "left_path,right_path,Fz_N,note\n".to_owned();
    for side in ["left", "right"] {
        std::fs::create_dir_all(folder.join(side)).expect("made");
    }
    for row in first..first + rows {
        write(folder, &format!("left/{row:03}.png"), &left(row));
        write(folder, &format!("right/{row:03}.png"), &right(row));
        let force = 0.25 * f64::from(row) + 0.125;
        writeln!(table, "left/{row:03}.png,right/{row:03}.png,{force},n{row}").expect("text");
    }
    write(folder, "left/rest.png", &png(48, 36, 99));
    write(folder, "labels.csv", table.as_bytes());
}

pub(super) fn left(row: u32) -> Vec<u8> {
    png(48, 36, row)
}

pub(super) fn right(row: u32) -> Vec<u8> {
    png(60, 36, 20 + row)
}

pub(super) fn write(folder: &Path, name: &str, bytes: &[u8]) {
    std::fs::write(folder.join(name), bytes).expect("written");
}

pub(super) fn planned(folder: &Path, map: &str) -> Result<ImportPlan, ImportError> {
    ImportPlan::new(folder, &ImportMap::parse("map.toml".as_ref(), map)?)
}

pub(super) fn import(folder: &Path, map: &str, target: &Path) -> Result<Dataset, ImportError> {
    let jobs = NonZeroUsize::new(2).expect("two");
    planned(folder, map)?.run(target, jobs, &SilentProgress)?;
    Ok(Dataset::open(target)?)
}

/// Reason why an import is rejected.
#[track_caller]
pub(super) fn refusal(folder: &Path, map: &str) -> String {
    let target = tempfile::tempdir().expect("a folder");
    match import(folder, map, &target.path().join("set")) {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    }
}

/// Text of the draft for `folder`, with its gaps filled in.
pub(super) fn drafted(folder: &Path) -> String {
    let draft = MapDraft::of(folder).expect("a draft");
    draft.text().replace("model = \"?\"", "model = \"gripper\"")
}

/// Pixels of an encoded picture.
pub(super) fn pixels(bytes: &[u8]) -> Vec<u8> {
    let picture = image::load_from_memory(bytes).expect("a picture");
    picture.into_luma8().into_raw()
}

/// Pixels of the picture of `row` in the view `view`.
pub(super) fn seen(dataset: &Dataset, view: &str, row: usize) -> Vec<u8> {
    let frame = dataset.seen(view).expect("a view").frame(row);
    frame.expect("read").expect("a frame").bytes().to_vec()
}

#[test]
fn two_columns_of_pictures_become_two_views_of_one_row() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let path = target.path().join("set");
    let dataset = import(lab.path(), &two(), &path).expect("imported");
    assert_eq!(
        (dataset.views(), dataset.view()),
        (vec!["left", "right"], None)
    );
    for row in 0..ROWS {
        let at = usize::try_from(row).expect("small");
        assert_eq!(seen(&dataset, "left", at), pixels(&left(row)));
        assert_eq!(seen(&dataset, "right", at), pixels(&right(row)));
    }
    let names = |view: &str| {
        dataset
            .table()
            .view(view)
            .expect("a view")
            .source_frame()
            .to_vec()
    };
    assert_eq!(names("right")[1].as_deref(), Some("right/001.png"));
    let header = std::fs::read_to_string(path.join("dataset.toml")).expect("a header");
    for expected in [
        "[[views]]\nname = \"left\"\ncount = 6\nwidth = 48\nheight = 36\nformat = \"gray8\"",
        "[[views]]\nname = \"right\"\ncount = 6\nwidth = 60\nheight = 36\nformat = \"gray8\"",
    ] {
        assert!(header.contains(expected), "{header}");
    }
    assert!(!header.contains("\n[frames]\n"), "{header}");
    let bytes = std::fs::read(path.join("frames/right/0000/000003.png")).expect("a file");
    assert_eq!(bytes, right(3));
    dataset.verify_frames().expect("whole");
    std::fs::write(path.join("frames/right/0000/000003.png"), left(3)).expect("written");
    assert!(dataset.verify_frames().is_err());
}

#[test]
fn a_row_with_one_picture_is_kept_as_it_was() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let map = two();
    let (_, rest) = map.split_once("[[frame]]\nname = \"right\"").expect("two");
    let (_, rest) = rest.split_once("[columns]").expect("columns");
    let one = format!(
        "map_version = 2\ntable = \"labels.csv\"\n[frame]\ncolumn = \"left_path\"\nchannel_order = \"gray\"\nreference = \"left/rest.png\"\n[columns]{rest}"
    );
    let dataset = import(lab.path(), &one, &target.path().join("one")).expect("imported");
    let header = std::fs::read_to_string(target.path().join("one/dataset.toml"));
    assert!(!header.expect("a header").contains("view"));
    assert!(dataset.views().is_empty() && dataset.require_view().is_ok());
    let names = dataset.table().columns().into_iter();
    let names: Vec<&str> = names.map(|column| column.name).collect();
    assert!(names.contains(&"frame") && names.iter().all(|name| !name.contains(':')));
    assert!(target.path().join("one/frames/0000/000000.png").is_file());
}

#[test]
fn views_stand_side_by_side_row_of_pixels_by_row() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let dataset = import(lab.path(), &two(), &target.path().join("set")).expect("imported");
    for (view, parts) in [
        ("left+right", [(48, left(2)), (60, right(2))]),
        ("right+left", [(60, right(2)), (48, left(2))]),
    ] {
        let both = dataset.seen(view).expect("side by side");
        assert_eq!(both.view().as_deref(), Some(view));
        let frame: Frame = both.frame(2).expect("read").expect("a frame");
        assert_eq!((frame.info().width, frame.info().height), (108, 36));
        let parts = parts.map(|(width, bytes)| (width, pixels(&bytes)));
        let mut expected = Vec::new();
        for row in 0..36 {
            for (width, pixels) in &parts {
                expected.extend_from_slice(&pixels[row * width..(row + 1) * width]);
            }
        }
        assert_eq!(frame.bytes(), expected, "{view}");
        let light = both.table().intensity()[2].expect("measured");
        assert!((light - frame.mean_luma()).abs() < 1e-9, "{light}");
        // One finger has no picture without contact.
        assert!(both.reference().expect("read").is_none());
    }
    let one = dataset.seen("left").expect("a view").reference();
    assert_eq!(
        one.expect("read").expect("known").bytes(),
        pixels(&png(48, 36, 99))
    );
}

#[test]
fn each_view_is_another_recording_to_whoever_reads_its_pictures() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let dataset = import(lab.path(), &two(), &target.path().join("set")).expect("imported");
    let digests = ["left", "right", "left+right", "right+left"].map(|view| {
        let seen = dataset.seen(view).expect("a view");
        let frames = seen.table().frames().iter().flatten();
        let frames: Vec<_> = frames.map(|entry| entry.digest).collect();
        assert_eq!(frames.len(), dataset.table().rows());
        (seen.digest(), frames)
    });
    for (at, one) in digests.iter().enumerate() {
        assert_ne!(one.0, dataset.digest());
        let others = &digests[at + 1..];
        assert!(
            others
                .iter()
                .all(|other| other.0 != one.0 && other.1 != one.1)
        );
    }
}

#[test]
fn an_attribute_of_two_fingers_holds_the_pictures_without_contact_that_rows_name() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let mut table = "left_path,right_path,Fz_N,rest\n".to_owned();
    for row in 0..ROWS {
        let rest = row % 2;
        writeln!(
            table,
            "left/{row:03}.png,right/{row:03}.png,{row},right/00{rest}.png"
        )
        .expect("text");
    }
    write(lab.path(), "labels.csv", table.as_bytes());
    let map = two().replace(
        "reference = \"unknown\"",
        "reference = { column = \"rest\" }",
    );
    let dataset = import(lab.path(), &map, &target.path().join("set")).expect("imported");
    let texts = dataset
        .table()
        .attribute("reference_right")
        .expect("an attribute");
    assert_eq!(texts[1].as_deref(), Some("right/001.png"));
}

#[test]
fn views_may_have_other_colours_and_sizes() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    for row in 0..ROWS {
        write(
            lab.path(),
            &format!("right/{row:03}.png"),
            &rgb_png(12, 7, row),
        );
    }
    let map = two();
    let (head, tail) = map.split_once("name = \"right\"").expect("two");
    let map = format!(
        "{head}name = \"right\"{}",
        tail.replacen("\"gray\"", "\"rgb\"", 1)
    );
    let dataset = import(lab.path(), &map, &target.path().join("set")).expect("imported");
    let right = dataset.seen("right").expect("a view").frame(1);
    assert_eq!(
        right
            .expect("read")
            .expect("a frame")
            .info()
            .format
            .samples(),
        3
    );
    let problem = dataset.seen("left+right").expect_err("unlike").to_string();
    assert!(
        problem.contains("`left` is 48")
            && problem.contains("`right` is 12")
            && problem.contains("one height"),
        "{problem}"
    );
}
