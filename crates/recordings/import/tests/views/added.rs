//! Tests of rows that are added to a recording with several pictures per row, and of recordings that are read as one.

use std::num::NonZeroUsize;
use std::path::Path;

use super::{ROWS, fill, gripper, import, left, pixels, planned, right, seen, two};
use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, DatasetError};
use taceva_import::{Addition, ImportError};

fn extend(folder: &Path, map: &str, target: &Path) -> Result<Dataset, ImportError> {
    let added = Addition::new("2026-11-28", "tuesday");
    planned(folder, map)?.extend(target, &added, NonZeroUsize::MIN, &SilentProgress)?;
    Ok(Dataset::open(target)?)
}

fn later() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fill(folder.path(), ROWS, 3);
    folder
}

#[test]
fn rows_that_are_added_have_their_pictures_in_every_view() {
    let (lab, more) = (gripper(), later());
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("set");
    let before = import(lab.path(), &two(), &path).expect("imported");
    let seen_before = before.seen("right").expect("a view").digest();
    drop(before);
    let after = extend(more.path(), &two(), &path).expect("added");
    assert_eq!(after.table().rows(), 9);
    for row in [0, 4, 6, 8] {
        let at = usize::try_from(row).expect("small");
        assert_eq!(seen(&after, "left", at), pixels(&left(row)));
        assert_eq!(seen(&after, "right", at), pixels(&right(row)));
    }
    let counts = after.header().views.iter().map(|view| view.frames.count);
    assert_eq!(counts.collect::<Vec<_>>(), [9, 9]);
    // A model of the earlier right finger is recognised by its digest.
    let seen = after.seen("right").expect("a view");
    assert!(
        seen.header()
            .stages()
            .any(|(digest, _)| digest == seen_before)
    );
    after.verify_frames().expect("whole");
}

#[test]
fn rows_with_other_views_or_those_that_are_there_are_not_added() {
    let (lab, more) = (gripper(), later());
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("set");
    import(lab.path(), &two(), &path).expect("imported");
    let (head, tail) = two()
        .split_once("[[frame]]")
        .map(|(head, tail)| (head.to_owned(), tail.to_owned()))
        .expect("two");
    let (_, columns) = tail.split_once("[columns]").expect("columns");
    let one = format!(
        "{head}[frame]\ncolumn = \"left_path\"\nchannel_order = \"gray\"\nreference = \"left/rest.png\"\n[columns]{columns}"
    );
    for (map, expected) in [
        (
            two().replace("name = \"right\"", "name = \"thumb\""),
            "`frame` is left and right in the dataset and left and thumb in the map",
        ),
        (
            one,
            "`frame` is left and right in the dataset and one picture in the map",
        ),
        (
            two().replace("reference = \"left/rest.png\"", "reference = \"unknown\""),
            "`views.left.reference` is sha256:",
        ),
        (
            two().replace(
                "name = \"left\"\ncolumn = \"left_path\"",
                "name = \"left\"\ncolumn = \"right_path\"",
            ),
            "`frames` is left 48",
        ),
    ] {
        let problem = extend(more.path(), &map, &path)
            .expect_err(expected)
            .to_string();
        assert!(problem.contains(expected), "{problem}");
    }
    let problem = extend(lab.path(), &two(), &path)
        .expect_err("twice")
        .to_string();
    assert!(problem.contains("no row is added twice"), "{problem}");
    // The pictures of one finger under other labels.
    let twice = tempfile::tempdir().expect("a folder");
    fill(twice.path(), ROWS, 4);
    for row in 0..4 {
        super::write(
            twice.path(),
            &format!("right/{:03}.png", ROWS + row),
            &right(row),
        );
    }
    let problem = extend(twice.path(), &two(), &path)
        .expect_err("twice")
        .to_string();
    assert!(problem.contains("with other labels"), "{problem}");
    assert_eq!(Dataset::open(&path).expect("as it was").table().rows(), 6);
}

#[test]
fn recordings_of_the_same_views_are_read_as_one_by_each_view() {
    let (lab, more) = (gripper(), later());
    let target = tempfile::tempdir().expect("a folder");
    let monday = import(lab.path(), &two(), &target.path().join("monday")).expect("imported");
    let tuesday = import(more.path(), &two(), &target.path().join("tuesday")).expect("imported");
    let both = Dataset::joined(vec![monday, tuesday]).expect("joined");
    assert!(matches!(both.frame(0), Err(DatasetError::View { .. })));
    let right_hand = both.seen("right").expect("a view");
    assert_eq!(
        right_hand.frame(7).expect("read").expect("a frame").bytes(),
        pixels(&right(7))
    );
    let side = both.seen("left+right").expect("side by side").frame(7);
    assert_eq!(side.expect("read").expect("a frame").info().width, 108);
    let other = import(
        more.path(),
        &two().replace("\"right\"", "\"thumb\""),
        &target.path().join("other"),
    );
    let monday = Dataset::open(&target.path().join("monday")).expect("a dataset");
    let problem = Dataset::joined(vec![monday, other.expect("imported")]).expect_err("unlike");
    assert!(
        problem.to_string().contains("`frames` is left 48"),
        "{problem}"
    );
}
