//! Tests of file names with numbers that a pattern pads with zeros, or counts from another number.

use super::{NO_TIME, imported, imported_from, lab, planned};

const COLUMNS: &str = "[columns]\nFz = { from = \"Fz\", unit = \"N\" }\n";

/// Three presses in a different order than their pictures, which are numbered from 1.
fn presses() -> tempfile::TempDir {
    let folder = lab(&[("log.csv", "n,Fz\n2,2.5\n1,1.5\n3,3.5\n")]);
    std::fs::create_dir(folder.path().join("cam")).expect("made");
    for number in 1..=3_u8 {
        let path = folder.path().join(format!("cam/gel_{number:05}.png"));
        image::GrayImage::from_pixel(2, 2, image::Luma([number]))
            .save(path)
            .expect("saved");
    }
    folder
}

/// Map with the frame lines `frames`, and the lines `more` at its end.
fn map(frames: &str, more: &str) -> String {
    format!(
        "table = \"log.csv\"\n[frame]\n{frames}\nchannel_order = \"gray\"\nreference = \"unknown\"\n{COLUMNS}{NO_TIME}{more}"
    )
}

/// Names of the pictures of the rows, in order, for a map with the frame lines `frames`.
fn pictures(frames: &str) -> Vec<String> {
    let (_, cells) = imported_from(presses().path(), &map(frames, ""), &["source_frame"]);
    cells.into_iter().flatten().collect()
}

#[test]
fn a_pattern_pads_the_numbers_of_a_column_with_zeros() {
    assert_eq!(
        pictures("pattern = \"cam/gel_{n:05}.png\""),
        [
            "cam/gel_00002.png",
            "cam/gel_00001.png",
            "cam/gel_00003.png"
        ]
    );
    let plain = map("pattern = \"cam/gel_{n}.png\"", "");
    let problem = planned(presses().path(), &plain).expect_err("refused");
    assert!(problem.contains("`cam/gel_2.png`"), "{problem}");
}

#[test]
fn a_pattern_counts_rows_from_another_number_than_0() {
    assert_eq!(
        pictures("pattern = \"cam/gel_{row+1:05}.png\""),
        [
            "cam/gel_00001.png",
            "cam/gel_00002.png",
            "cam/gel_00003.png"
        ]
    );
}

#[test]
fn rows_are_left_out_by_the_picture_that_a_pattern_or_a_folder_gives() {
    let folder = presses();
    let rule = "[drop]\nframes_named = [\"cam/gel_00001.png\"]\n";
    for frames in [
        "pattern = \"cam/gel_{n:05}.png\"",
        "pattern = \"gel_{n:05}.png\"\nfolder = \"cam\"",
    ] {
        let plan = planned(folder.path(), &map(frames, rule)).expect("an import");
        let summary = plan.summary();
        assert_eq!((summary.rows_read, summary.rows_kept), (3, 2), "{frames}");
    }
}

#[test]
fn a_column_that_is_called_like_a_form_of_numbers_is_taken_by_its_exact_name() {
    let folder = presses();
    let table = "n,n:05,Fz\n1,gel_00002,2.5\n2,gel_00001,1.5\n";
    std::fs::write(folder.path().join("log.csv"), table).expect("written");
    let map = map("pattern = \"cam/{n:05}.png\"", "");
    let (_, cells) = imported_from(folder.path(), &map, &["source_frame"]);
    assert_eq!(cells.concat(), ["cam/gel_00002.png", "cam/gel_00001.png"]);
}

#[test]
fn the_name_of_a_joined_table_pads_a_part_of_the_path_with_zeros() {
    let tables = [
        ("run7.csv", "k\n1\n2\n"),
        ("ft_00007.csv", "Fz\n1.5\n2.5\n"),
    ];
    let map = format!(
        "table = \"run*.csv\"\n[path]\npattern = \"run{{n:digits}}.csv\"\n[[join]]\nname = \"ft\"\ntable = \"ft_{{path.n:05}}.csv\"\non = \"row\"\n[columns]\nFz = {{ from = \"ft.Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let (_, found) = imported(&tables, &map, &["Fz"]);
    assert_eq!(found[0], ["1.5", "2.5"]);
}
