//! Tests of drafts of folders whose pictures are numbered, and of a file in place of its folder.

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_arrays::{Hdf5Writer, WrittenElement};
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::MapDraft;

use super::drafts::{filled, with_pictures};
use super::{codes, draft, line, planned, summary};

/// Pictures of the rows after an import by the draft of `folder`.
fn pictures(folder: &Path) -> Vec<String> {
    let map = filled(&draft(folder));
    let plan = planned(folder, &map).unwrap_or_else(|problem| panic!("{problem}\n{map}"));
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let names = dataset.table().source_frame().iter();
    names.map(|name| name.clone().unwrap_or_default()).collect()
}

const CAMERA: [&str; 3] = [
    "cam/gel_00001.png",
    "cam/gel_00002.png",
    "cam/gel_00003.png",
];

#[test]
fn pictures_numbered_like_a_column_are_drafted_as_a_pattern_with_zeros() {
    let table = "n,frame_no,Fz_N\n2,19,1.5\n1,19,2.5\n3,18,0.5\n";
    let folder = with_pictures(&[("log.csv", table)], &CAMERA);
    let text = draft(folder.path());
    assert_eq!(
        line(&text, "pattern = "),
        "pattern = \"cam/gel_{n:05}.png\"   # a guess: 3 pictures cam/gel_*.png numbered 1 to 3, and \"n\" holds these numbers"
    );
    let found = pictures(folder.path());
    assert_eq!(found, [CAMERA[1], CAMERA[0], CAMERA[2]]);
}

#[test]
fn as_many_pictures_as_rows_are_drafted_in_the_order_of_the_rows() {
    let folder = with_pictures(&[("log.csv", "Fz_N\n1.5\n0.5\n2.5\n")], &CAMERA);
    let text = draft(folder.path());
    let pattern = line(&text, "pattern = ");
    assert!(
        pattern.starts_with("pattern = \"cam/gel_{row+1:05}.png\"   # a guess: 3 pictures")
            && pattern.ends_with("3 rows: the first row is taken for the first picture"),
        "{text}"
    );
    assert_eq!(pictures(folder.path()), CAMERA);
    // With a gap, the numbers are not those of the rows.
    let apart = ["cam/1.png", "cam/2.png", "cam/4.png"];
    let folder = with_pictures(&[("log.csv", "Fz_N\n1.5\n0.5\n2.5\n")], &apart);
    assert!(!draft(folder.path()).contains("pattern = "));
    // Rows that were sorted by their forces are not in the order of the pictures.
    let table = "t_s,Fz_N\n20.5,0.5\n10.5,1.5\n30.5,2.5\n";
    let folder = with_pictures(&[("log.csv", table)], &CAMERA);
    assert!(!draft(folder.path()).contains("pattern = "));
}

#[test]
fn a_column_whose_last_number_is_of_no_picture_does_not_number_them() {
    // More rows than a draft reads: numbers from 1 beside pictures from 0.
    let rows = (1..=205).map(|row| format!("{row},{}.5\n", row % 7));
    let table = format!("n,Fz_N\n{}", rows.collect::<String>());
    for (digits, expected) in [
        (0, "pattern = \"cam/{row}.png\""),
        (5, "pattern = \"cam/{row:05}.png\""),
    ] {
        let names: Vec<String> = (0..205)
            .map(|number| format!("cam/{number:0digits$}.png"))
            .collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let folder = with_pictures(&[("log.csv", &table)], &names);
        let text = draft(folder.path());
        assert!(line(&text, "pattern = ").starts_with(expected), "{text}");
    }
}

#[test]
fn the_matrix_of_a_camera_in_a_text_is_no_table_of_forces() {
    let rows = [
        ["600.5", "0.0", "320.5"],
        ["0.0", "600.5", "240.5"],
        ["0.0", "0.0", "1.0"],
    ];
    let names = ["touch_1.png", "touch_2.png", "touch_3.png", "touch_4.png"];
    for between in [",", " "] {
        let rows = rows.iter().map(|row| row.join(between) + "\n");
        let matrix: String = rows.collect();
        let folder = with_pictures(&[("camera.txt", &matrix)], &names);
        let text = draft(folder.path());
        assert!(
            text.contains("table = { files = \"touch_*.png\" }"),
            "{text}"
        );
        assert!(!text.contains("Fx = "), "{text}");
        assert!(text.contains("camera.txt (3 rows) does not"), "{text}");
    }
}

#[test]
fn numbered_pictures_of_two_sides_are_drafted_as_views() {
    let names = ["left/1.png", "left/2.png", "right/1.png", "right/2.png"];
    let folder = with_pictures(&[("log.csv", "n,Fz_N\n1.0,1.5\n2.0,0.5\n")], &names);
    let text = draft(folder.path());
    // Numbers with a fraction are written without it.
    for part in [
        "name = \"left\"",
        "pattern = \"left/{n:01}.png\"",
        "pattern = \"right/{n:01}.png\"",
    ] {
        assert!(text.contains(part), "{text}");
    }
    planned(folder.path(), &filled(&text)).expect("an import");
}

#[test]
fn two_series_that_are_no_views_leave_the_pattern_open() {
    let names = ["depth_1.png", "depth_2.png", "rgb_1.png", "rgb_2.png"];
    let folder = with_pictures(&[("log.csv", "Fz_N\n1.5\n0.5\n")], &names);
    let text = draft(folder.path());
    assert!(
        line(&text, "pattern = ").starts_with("pattern = \"?\""),
        "{text}"
    );
    for name in ["depth", "rgb"] {
        let other = format!("# or: pattern = \"{name}_{{row+1}}.png\"");
        assert!(text.contains(&other), "{text}");
    }
}

#[test]
fn numbers_in_another_order_than_the_rows_are_drafted_with_the_order_of_rows_beside_them() {
    let table = "n,Fz_N\n2,1.5\n3,2.5\n1,0.5\n";
    let folder = with_pictures(&[("log.csv", table)], &CAMERA);
    let text = draft(folder.path());
    assert!(
        line(&text, "pattern = ").starts_with("pattern = \"cam/gel_{n:05}.png\""),
        "{text}"
    );
    assert!(
        line(&text, "# or: pattern = ")
            .starts_with("# or: pattern = \"cam/gel_{row+1:05}.png\"   # a guess: "),
        "{text}"
    );
    let counted = "n,Fz_N\n1,1.5\n2,2.5\n3,0.5\n";
    let folder = with_pictures(&[("log.csv", counted)], &CAMERA);
    assert!(!draft(folder.path()).contains("# or: pattern"));
}

#[test]
fn shuffled_numbers_that_are_those_of_no_picture_forbid_the_order_of_rows() {
    let table = "n,Fz_N\n1,1.5\n2,2.5\n0,0.5\n";
    let folder = with_pictures(&[("log.csv", table)], &CAMERA);
    let text = draft(folder.path());
    assert!(!text.contains("pattern = "), "{text}");
    assert!(text.contains("Not joined: 3 pictures"), "{text}");
}

#[test]
fn numbered_folders_are_no_views() {
    let names = [
        "day1/g_1.png",
        "day1/g_2.png",
        "day2/g_1.png",
        "day2/g_2.png",
    ];
    let folder = with_pictures(&[("log.csv", "n,Fz_N\n1,1.5\n2,0.5\n")], &names);
    let text = draft(folder.path());
    assert!(
        line(&text, "pattern = ").starts_with("pattern = \"?\""),
        "{text}"
    );
    for day in ["day1", "day2"] {
        let other = format!("# or: pattern = \"{day}/g_{{n}}.png\"");
        assert!(text.contains(&other), "{text}");
    }
    assert!(!text.contains("name = \"day1\""), "{text}");
}

#[test]
fn pictures_that_no_line_joins_are_named_in_the_draft_and_in_a_warning_of_the_import() {
    let folder = with_pictures(&[("log.csv", "Fz_N\n1.5\n0.5\n")], &CAMERA);
    let text = draft(folder.path());
    let expected = "# No pictures match the rows of the table. Not joined: 3 pictures cam/gel_*.png; the table has 2 rows.";
    assert!(line(&text, "# No pictures").starts_with(expected), "{text}");
    let found = summary(folder.path(), &filled(&text));
    assert_eq!(codes(&found), ["no-pictures"]);
    let warning = found.warnings.first().expect("one").to_string();
    assert!(
        warning.contains("3 pictures, such as cam/gel_00001.png"),
        "{warning}"
    );
    // A table alone has nothing to join.
    let alone = with_pictures(&[("log.csv", "Fz_N\n1.5\n0.5\n")], &[]);
    let text = draft(alone.path());
    assert!(
        text.contains("\n# No pictures match the rows of the table.\n"),
        "{text}"
    );
    assert!(codes(&summary(alone.path(), &filled(&text))).is_empty());
}

#[test]
fn a_file_is_drafted_with_the_pictures_of_its_folder_and_without_other_tables() {
    let tables = [
        ("log.csv", "n,Fz_N\n1,1.5\n2,0.5\n3,2.5\n"),
        ("other.csv", "n,Fx_N\n1,1.5\n2,0.5\n3,2.5\n"),
    ];
    let folder = with_pictures(&tables, &CAMERA);
    let file = MapDraft::of(&folder.path().join("log.csv")).expect("a draft");
    let text = file.text();
    assert!(text.contains("table = \"log.csv\""), "{text}");
    assert!(text.contains("pattern = \"cam/gel_{n:05}.png\""), "{text}");
    assert!(!text.contains("other"), "{text}");
    planned(folder.path(), &filled(text)).expect("an import");
}

#[test]
fn an_attribute_with_the_unit_of_a_force_comes_before_counts_of_the_same_force() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut writer = Hdf5Writer::create(&folder.path().join("run.h5")).expect("made");
    for (name, attributes) in [
        ("load_cell", &[("unit", "N")][..]),
        ("load_cell_adc", &[][..]),
    ] {
        writer
            .begin(name, WrittenElement::F64, &[3], attributes)
            .expect("begun");
        for number in [2.5_f64, 0.5, 1.5] {
            writer.write(&number.to_le_bytes()).expect("written");
        }
    }
    writer.finish(&[]).expect("written");
    let text = draft(folder.path());
    assert!(
        text.contains("\nFz = { from = \"load_cell\", unit = \"N\" }"),
        "{text}"
    );
    assert!(
        text.contains("# or: Fz = { from = \"load_cell_adc\""),
        "{text}"
    );
}
