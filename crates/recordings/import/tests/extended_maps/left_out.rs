//! Tests that everything an import leaves out is counted in its summary and in the dataset.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, LeftOut};
use taceva_import::ImportSummary;

use super::arrays::{bytes_of, npy};
use super::{NO_TIME, lab, planned};

/// Summary of an import, and the omissions recorded in the dataset.
pub(super) fn left_out(folder: &Path, map: &str) -> (ImportSummary, LeftOut) {
    let plan = planned(folder, map).expect("planned");
    let summary = plan.summary().clone();
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("dataset");
    plan.run(&path, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&path).expect("a dataset");
    (summary, dataset.header().left_out.clone())
}

#[test]
fn an_import_that_takes_everything_says_nothing_and_its_format_is_as_before() {
    let folder = lab(&[("labels.csv", "Fz\n1\n2\n")]);
    let map = format!(
        "table = \"labels.csv\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let (summary, remembered) = left_out(folder.path(), &map);
    assert!(remembered.is_empty(), "{remembered:?}");
    let words = summary.to_string();
    assert!(
        !words.contains("no row") && !words.contains("never written"),
        "{words}"
    );
}

#[test]
fn rows_of_both_sides_of_a_join_are_counted_over_all_main_tables() {
    // The row at 9 s has no match. Both main tables share the transducer's table, of which two rows are used and one is skipped.
    let folder = lab(&[
        ("a/run.csv", "t\n0.0\n9.0\n"),
        ("b/run.csv", "t\n1.0\n"),
        ("ft.csv", "t,Fz\n0.001,1\n1.001,2\n2,-1\n3,4\n4,5\n"),
    ]);
    let map = "table = \"*/run.csv\"\n[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = { column = \"t\", unit = \"s\" }\ntolerance_ms = 5\nlag_ms = 0\nunmatched = \"drop\"\nskip = { Fz = -1 }\n[columns]\nFz = { from = \"ft.Fz\", unit = \"N\" }\n[time]\nclock = \"unix\"\ncolumn = \"t\"\nunit = \"s\"\n";
    let (summary, remembered) = left_out(folder.path(), map);
    let join = &summary.joins[0];
    assert_eq!((join.matched, join.unmatched), (2, 1));
    assert_eq!((join.unused, join.skipped), (2, 1));
    assert_eq!(remembered.rows["join ft"], 1);
    assert_eq!(remembered.joined_rows["ft"], 2);
    assert_eq!(remembered.skipped_rows["ft"], 1);
    let words = summary.to_string();
    assert!(
        words.contains("1 unmatched; 2 of its rows unused, 1 skipped"),
        "{words}"
    );
}

#[test]
fn frames_of_an_array_that_no_row_uses_are_counted() {
    let folder = lab(&[("labels.csv", "k,Fz\n4,1\n2,2\n4,3\n")]);
    let frames = npy("|u1", "(6, 8, 8)", &[7; 6 * 64]);
    fs::write(folder.path().join("frames.npy"), frames).expect("written");
    let map = format!(
        "table = \"labels.csv\"\n[frame]\narray = {{ file = \"frames.npy\" }}\nindex = \"k\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let (summary, remembered) = left_out(folder.path(), &map);
    assert_eq!(remembered.frames["frames.npy"], 4);
    let words = summary.to_string();
    assert!(
        words.contains("frames that no row uses: 4 of frames.npy"),
        "{words}"
    );
}

#[test]
fn chunks_of_zarr_that_were_never_written_are_counted_for_labels_frames_and_signals() {
    let folder = tempfile::tempdir().expect("a folder");
    let array = |name: &str, shape: &str, chunks: &str, kind: &str| {
        let at = folder.path().join("run.zarr").join(name);
        fs::create_dir_all(&at).expect("made");
        let described = format!(
            "{{\"zarr_format\": 2, \"shape\": {shape}, \"chunks\": {chunks}, \"dtype\": \"{kind}\", \"compressor\": null, \"filters\": null, \"order\": \"C\", \"fill_value\": 0}}"
        );
        fs::write(at.join(".zarray"), described).expect("written");
        at
    };
    fs::create_dir_all(folder.path().join("run.zarr")).expect("made");
    fs::write(
        folder.path().join("run.zarr/.zgroup"),
        "{\"zarr_format\": 2}",
    )
    .expect("written");
    let force = array("force", "[4]", "[2]", "<f4");
    fs::write(force.join("0"), bytes_of(&[1.0, 2.0])).expect("written");
    let frames = array("frames", "[4, 8, 8]", "[1, 8, 8]", "|u1");
    for chunk in ["0.0.0", "1.0.0", "3.0.0"] {
        fs::write(frames.join(chunk), [9_u8; 64]).expect("written");
    }
    let map = format!(
        "table = \"run.zarr\"\n[frame]\narray = \"frames\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"force\", unit = \"N\" }}\n{NO_TIME}"
    );
    let (summary, remembered) = left_out(folder.path(), &map);
    assert_eq!(remembered.absent_chunks["run.zarr/force"], 1);
    assert_eq!(remembered.absent_chunks["run.zarr/frames"], 1);
    assert_eq!(remembered.absent_chunks.len(), 2);
    let words = summary.to_string();
    assert!(
        words.contains("chunks that were never written: 1 of run.zarr/force"),
        "{words}"
    );
}

#[test]
fn rows_left_out_by_rules_and_images_that_no_row_names_are_remembered() {
    let folder = lab(&[("labels.csv", "file,Fz\na.png,1\n,2\na.png,-1\n")]);
    for name in ["a.png", "b.png", "c.png"] {
        image::GrayImage::from_pixel(8, 8, image::Luma([90]))
            .save(folder.path().join(name))
            .expect("saved");
    }
    let map = format!(
        "table = \"labels.csv\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[drop]\nframes_named = [\"\"]\nplaceholders = {{ Fz = -1 }}\n{NO_TIME}"
    );
    let (_, remembered) = left_out(folder.path(), &map);
    assert_eq!(remembered.images, 2);
    assert_eq!(remembered.rows["placeholders"], 1);
    assert_eq!(remembered.rows["frame ``"], 1);
}

#[test]
fn frames_that_no_row_uses_are_counted_in_the_file_that_they_are_in() {
    let folder = lab(&[("labels.csv", "k,Fz\n0,1\n4,2\n5,3\n")]);
    for session in ["s0", "s1", "s2"] {
        let at = folder.path().join(session);
        fs::create_dir(&at).expect("made");
        let frames = npy("|u1", "(3, 8, 8)", &[7; 3 * 64]);
        fs::write(at.join("frames.npy"), frames).expect("written");
    }
    let map = format!(
        "table = \"labels.csv\"\n[frame]\narray = {{ file = \"s*/frames.npy\" }}\nindex = \"k\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let (_, remembered) = left_out(folder.path(), &map);
    let found =
        ["s0", "s1", "s2"].map(|session| remembered.frames[&format!("{session}/frames.npy")]);
    assert_eq!(found, [2, 1, 3]);
    assert_eq!(remembered.frames.len(), 3);
}
