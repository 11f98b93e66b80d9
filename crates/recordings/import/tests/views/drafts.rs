//! Tests that folders with several pictures in one row are drafted with views, and other folders without views.

use std::path::Path;

use super::{ROWS, drafted, gripper, import, left, pixels, right, seen, write};
use crate::lab::png;

const CLIPS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../tests/recordings");

#[track_caller]
fn holds(draft: &str, parts: &[&str]) {
    for part in parts {
        assert!(draft.contains(part), "no {part:?} in\n{draft}");
    }
}

#[test]
fn two_columns_of_pictures_are_drafted_as_views_and_imported_so() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let draft = drafted(lab.path());
    holds(
        &draft,
        &[
            "[[frame]]\nname = \"left\"   # a guess",
            "column = \"left_path\"\nchannel_order = \"gray\"",
            "[[frame]]\nname = \"right\"   # a guess",
            "column = \"right_path\"\nchannel_order = \"gray\"",
        ],
    );
    let dataset = import(lab.path(), &draft, &target.path().join("set")).expect("imported");
    assert_eq!(seen(&dataset, "right", 4), pixels(&right(4)));
}

#[test]
fn a_column_of_names_beside_two_folders_of_cameras_is_drafted_as_views() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let rows = (0..ROWS).map(|row| format!("{row:03}.png,{}\n", f64::from(row) / 8.0));
    let table = format!("file,Fz_N\n{}", rows.collect::<String>());
    write(lab.path(), "labels.csv", table.as_bytes());
    let draft = drafted(lab.path());
    holds(
        &draft,
        &[
            "name = \"left\"",
            "column = \"file\"\nfolder = \"left\"",
            "name = \"right\"",
            "column = \"file\"\nfolder = \"right\"",
        ],
    );
    let dataset = import(lab.path(), &draft, &target.path().join("set")).expect("imported");
    assert_eq!(seen(&dataset, "left", 5), pixels(&left(5)));
    assert_eq!(seen(&dataset, "right", 5), pixels(&right(5)));
}

#[test]
fn two_clips_beside_a_log_are_drafted_as_views() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["eye_left.mp4", "eye_right.mp4"] {
        let clip = Path::new(CLIPS).join("mp4-h264-baseline/clip.mp4");
        std::fs::copy(clip, folder.path().join(name)).expect("copied");
    }
    let video = taceva_video::Video::open(
        &folder.path().join("eye_left.mp4"),
        &taceva_video::Decoders::default(),
    );
    let frames = video.expect("a clip").info().frames;
    let rows = (0..frames)
        .map(|row| format!("{row},0.5\n"))
        .collect::<String>();
    write(
        folder.path(),
        "log.csv",
        format!("frame,Fz_N\n{rows}").as_bytes(),
    );
    let draft = drafted(folder.path());
    holds(
        &draft,
        &[
            "name = \"left\"",
            "video = \"eye_left.mp4\"\nindex = ",
            "name = \"right\"",
            "video = \"eye_right.mp4\"\nindex = ",
        ],
    );
    let target = tempfile::tempdir().expect("a folder");
    let dataset = import(folder.path(), &draft, &target.path().join("set"));
    let dataset = dataset.unwrap_or_else(|problem| panic!("{problem}\n{draft}"));
    assert_eq!(seen(&dataset, "left", 3), seen(&dataset, "right", 3));
    assert!(
        dataset
            .header()
            .views
            .iter()
            .all(|view| view.frames.codec.is_some())
    );
    // A clip of another length is left open.
    let rows = (0..frames + 4)
        .map(|row| format!("{row},0.5\n"))
        .collect::<String>();
    write(
        folder.path(),
        "log.csv",
        format!("step,Fz_N\n{rows}").as_bytes(),
    );
    assert_eq!(drafted(folder.path()).matches("index = \"?\"").count(), 2);
}

#[test]
fn two_arrays_beside_a_table_are_drafted_as_views() {
    let folder = tempfile::tempdir().expect("a folder");
    let array = |shift: u8| {
        let header = "{'descr': '|u1', 'fortran_order': False, 'shape': (4, 48, 40), }\n";
        let length = u16::try_from(header.len()).expect("short");
        let pixels = (0..4 * 48 * 40_u32).map(move |pixel| (pixel * 7).to_le_bytes()[0] ^ shift);
        [
            b"\x93NUMPY\x01\x00",
            &length.to_le_bytes()[..],
            header.as_bytes(),
            &pixels.collect::<Vec<u8>>(),
        ]
        .concat()
    };
    write(folder.path(), "thumb.npy", &array(0));
    write(folder.path(), "index.npy", &array(85));
    write(
        folder.path(),
        "labels.csv",
        b"Fz_N,note\n0.5,a\n1.5,b\n2.5,c\n3.5,d\n",
    );
    let draft = drafted(folder.path());
    holds(
        &draft,
        &[
            "name = \"thumb\"",
            "array = { file = \"thumb.npy\" }",
            "name = \"index\"",
            "array = { file = \"index.npy\" }",
        ],
    );
    let target = tempfile::tempdir().expect("a folder");
    let dataset = import(folder.path(), &draft, &target.path().join("set"));
    let dataset = dataset.unwrap_or_else(|problem| panic!("{problem}\n{draft}"));
    let [thumb, index] = ["thumb", "index"].map(|view| seen(&dataset, view, 2));
    assert!(
        thumb
            .iter()
            .zip(&index)
            .all(|(thumb, index)| thumb ^ index == 85)
    );
}

#[test]
fn a_picture_and_its_mask_are_no_views() {
    let lab = gripper();
    let mut table = "image,mask,Fz_N\n".to_owned();
    for row in 0..ROWS {
        table += &format!("left/{row:03}.png,right/{row:03}.png,{row}.5\n");
    }
    write(lab.path(), "labels.csv", table.as_bytes());
    write(lab.path(), "left/rest.png", &png(48, 36, 1));
    let draft = drafted(lab.path());
    holds(&draft, &["[frame]\ncolumn = \"image\""]);
    assert!(!draft.contains("[[frame]]"), "{draft}");
}
