//! Tests that incomplete or contradictory tables, maps and folders are rejected with a message, and that nothing is written.

use std::fs;

use crate::lab::{Lab, MAP};
use taceva_dataset::{Dataset, DatasetError};
use taceva_import::ImportMap;

#[test]
fn a_missing_column_lists_those_there_are_and_suggests_one() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"force\"", "\"forse\"");
    lab.is_refused_with(&[
        "labels.csv: no column `forse`, did you mean `force`?",
        "the columns are file, name",
    ]);
}

#[test]
fn a_label_that_is_no_finite_number_names_its_place() {
    for (cell, word) in [
        ("abc", "`abc`: is not a finite number"),
        ("NaN", "`NaN`: is not a finite number"),
        ("inf", "`inf`: is not a finite number"),
        ("1e400", "`1e400`: is not a finite number"),
        ("\"1,234.5\"", "thousands separators"),
        ("1 234", "thousands separators"),
    ] {
        let lab = Lab::new();
        lab.replace("source/labels.csv", "1236.5", cell);
        lab.is_refused_with(&["labels.csv, line 4, column `depth`", word]);
    }
}

#[test]
fn an_empty_cell_is_an_absent_value() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "1236.5", "");
    lab.import().expect("imported");
    let dataset = Dataset::open(&lab.path("set")).expect("opens");
    let depth = dataset.table().channels().position("Pz").expect("there");
    assert_eq!(dataset.table().truth(depth).get(2), None);
    assert_eq!(dataset.table().truth(depth).get(3), Some(1.2375));
}

#[test]
fn a_name_given_twice_is_refused() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "press 3", "press 1");
    lab.is_refused_with(&[
        "line 5, column `name`",
        "`press 1` is the name of an earlier row",
    ]);
}

#[test]
fn ids_of_the_wrong_kind_are_refused() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "2.0,load", "2.5,load");
    lab.is_refused_with(&["line 4, column `repeat`", "expected a whole number"]);
    let lab = Lab::new();
    lab.replace("source/labels.csv", "2.0,load", "2,hold");
    lab.is_refused_with(&["line 4, column `phase`", "expected `load` or `unload`"]);
}

#[test]
fn a_row_of_another_length_is_refused() {
    let lab = Lab::new();
    lab.replace("source/labels.csv", "press 3,", "press 3,,");
    lab.is_refused_with(&["labels.csv, line 5: 12 cells, expected 11"]);
}

#[test]
fn tables_in_other_encodings_are_refused_in_words() {
    let lab = Lab::new();
    let text = fs::read_to_string(lab.path("source/labels.csv")).expect("read");
    let utf16: Vec<u8> = std::iter::once(0xfeff)
        .chain(text.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    lab.write("source/labels.csv", &utf16);
    lab.is_refused_with(&["labels.csv, line 1: UTF-16 or binary"]);
    lab.write("source/labels.csv", b"file,name\na,\xe9\n");
    lab.is_refused_with(&["labels.csv, line 2: not UTF-8"]);
    lab.write("source/labels.csv", b"file,name\na,b\0c\n");
    lab.is_refused_with(&["labels.csv, line 2: a byte of value 0", "as UTF-8"]);
    lab.write("source/labels.csv", b"");
    lab.is_refused_with(&["line 1: empty, expected a header"]);
    lab.write("source/labels.csv", b"a,\"b\nc,d\n");
    lab.is_refused_with(&["a quotation mark is never closed"]);
    lab.write("source/labels.csv", b"a,b,a\n1,2,3\n");
    lab.is_refused_with(&["line 1: the column `a` occurs twice"]);
}

#[test]
fn marks_line_ends_and_delimiters_make_no_difference() {
    let lab = Lab::new();
    let expected = lab.import_to("plain", 1).expect("imported").digest;
    let text = fs::read_to_string(lab.path("source/labels.csv"))
        .expect("read")
        .replace("bad;worse", "bad worse");
    let variants = [
        format!("\u{feff}{text}"),
        text.replace('\n', "\r\n"),
        text.replace("\"clip, ", "\"clip# ")
            .replace(',', ";")
            .replace("clip#", "clip,"),
        text.replace("\"clip, ", "\"clip# ")
            .replace(',', "\t")
            .replace("clip#", "clip,"),
        text.replace('\n', "\n\n"),
    ];
    for (number, variant) in variants.iter().enumerate() {
        lab.write("source/labels.csv", variant.as_bytes());
        let report = lab.import_to(&number.to_string(), 1).expect("imported");
        assert_eq!(report.digest, expected, "{variant}");
    }
}

#[test]
fn an_existing_target_is_never_written_over() {
    let lab = Lab::new();
    fs::create_dir(lab.path("set")).expect("created");
    lab.write("set/precious", b"x");
    lab.is_refused_with(&["exists already"]);
    assert!(lab.path("set/precious").exists());
}

#[test]
fn a_dataset_of_a_newer_major_is_refused_and_says_so() {
    let lab = Lab::new();
    lab.import().expect("imported");
    let imported = Dataset::open(&lab.path("set")).expect("opens");
    let written = format!("format = \"{}\"", imported.header().format);
    drop(imported);
    lab.replace("set/dataset.toml", &written, "format = \"2.3\"");
    let error = Dataset::open(&lab.path("set")).expect_err("newer");
    assert!(matches!(error, DatasetError::Version { .. }));
    assert!(
        error
            .to_string()
            .contains("format 2.3 needs a newer TacEva"),
        "{error}"
    );
}

#[test]
fn a_map_with_an_unknown_key_names_line_and_nearest_key() {
    let lab = Lab::new();
    lab.write(
        "map.toml",
        MAP.replace("channel_order", "chanel_order").as_bytes(),
    );
    lab.is_refused_with(&["map.toml, line 6", "did you mean `channel_order`?"]);
}

#[test]
fn numbers_off_by_a_thousand_are_imported_with_a_warning() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"mN\"", "\"N\"");
    let report = lab.import().expect("imported");
    let codes: Vec<&str> = report
        .summary
        .suspicions
        .iter()
        .map(|one| one.code)
        .collect();
    assert_eq!(codes, ["magnitude-large"]);
    assert!(
        report
            .to_string()
            .contains("warning  magnitude-large: `Fz`"),
        "{report}"
    );
}

#[test]
fn images_that_no_row_names_are_counted_and_listed() {
    let lab = Lab::new();
    for number in 0..25 {
        lab.write(&format!("source/images/extra {number:02}.jpg"), b"x");
    }
    let summary = lab.import().expect("imported").summary;
    assert_eq!(
        (summary.unnamed_images, summary.first_unnamed_images.len()),
        (25, 20)
    );
    assert!(summary.first_unnamed_images[0].ends_with("extra 00.jpg"));
    assert_eq!(summary.dropped.get("bad"), Some(&1));
    assert_eq!((summary.rows_read, summary.rows_kept), (6, 5));
}

#[test]
fn a_map_whose_table_is_missing_or_matches_nothing_is_refused() {
    let lab = Lab::new();
    lab.write(
        "map.toml",
        MAP.replace("labels.csv", "other.csv").as_bytes(),
    );
    lab.is_refused_with(&["`other.csv`: no such file"]);
    lab.write(
        "map.toml",
        MAP.replace("labels.csv", "run_*/labels.csv").as_bytes(),
    );
    lab.is_refused_with(&["`run_*/labels.csv`: matches no file in"]);
}

#[test]
fn maps_are_read_from_files_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let error = ImportMap::read(folder.path()).expect_err("a folder");
    assert!(error.to_string().contains("not a regular file"), "{error}");
}
