//! Tests of rows that a map leaves out by their number, or by a picture in a clip or an array.

use std::fs;

use super::arrays::npy;
use super::left_out::left_out;
use super::{NO_TIME, imported, lab, planned, refused};

/// Map of the tables that match `table`, with `rows` in its section `[drop]`.
fn map(table: &str, rows: &str) -> String {
    format!(
        "table = \"{table}\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[drop]\nrows = {rows}\n{NO_TIME}"
    )
}

#[test]
fn rows_named_by_number_are_left_out_from_one_below_the_header_and_their_reason_is_kept() {
    let table = ("labels.csv", "Fz\n10\n20\n30\n40\n");
    let map = map(
        "labels.csv",
        "[1, { row = 3, reason = \"the transducer was overloaded\" }]",
    );
    let (_, found) = imported(&[table], &map, &["Fz", "sample"]);
    assert_eq!(found[0], ["20.0", "40.0"]);
    // Other samples keep their names.
    assert_eq!(found[1], ["1", "3"]);
    let (summary, remembered) = left_out(lab(&[table]).path(), &map);
    assert_eq!(remembered.rows["rows by number"], 1);
    let reason = "rows by number (the transducer was overloaded)";
    assert_eq!(remembered.rows[reason], 1);
    let words = summary.to_string();
    assert!(words.contains(reason), "{words}");
}

#[test]
fn a_row_of_several_tables_is_named_with_its_table_and_a_row_that_is_not_there_is_refused() {
    let tables = [("a.csv", "Fz\n1\n2\n"), ("b.csv", "Fz\n3\n4\n")];
    let of_b = map("*.csv", "[{ row = 2, table = \"b.csv\" }]");
    let (_, found) = imported(&tables, &of_b, &["Fz"]);
    assert_eq!(found[0], ["1.0", "2.0", "3.0"]);
    for (table, rows, words) in [
        ("*.csv", "[2]", "`{ table = \"a.csv\", row = 2 }`"),
        (
            "*.csv",
            "[{ row = 2, table = \"c.csv\" }]",
            "`c.csv`, which is not a table of the map",
        ),
        ("a.csv", "[3]", "row 3 in `rows` of [drop] does not exist"),
        ("a.csv", "[0]", "counted from 1"),
        ("a.csv", "[\"2\"]", "the number of a row, from 1"),
    ] {
        let problem = refused(&tables, &map(table, rows));
        assert!(problem.contains(words), "{rows}: {problem}");
    }
}

#[test]
fn a_picture_in_an_array_is_left_out_by_its_position_and_a_name_of_no_picture_is_warned_of() {
    let folder = lab(&[("labels.csv", "Fz\n1\n2\n3\n")]);
    let frames = npy("|u1", "(3, 8, 8)", &[7; 3 * 64]);
    fs::write(folder.path().join("frames.npy"), frames).expect("written");
    let map = |names: &str| {
        format!(
            "table = \"labels.csv\"\n[frame]\narray = {{ file = \"frames.npy\" }}\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[drop]\nframes_named = {names}\n{NO_TIME}"
        )
    };
    let (summary, remembered) = left_out(folder.path(), &map("[\"frames.npy#1\"]"));
    assert_eq!((summary.rows_kept, summary.warnings.len()), (2, 0));
    assert_eq!(remembered.rows["frame `frames.npy#1`"], 1);
    let plan = planned(folder.path(), &map("[\"frames.npy#9\", \"---\", \"\"]"));
    let summary = plan.expect("planned").summary().clone();
    assert_eq!(summary.rows_kept, 3);
    let warnings: Vec<String> = summary.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(
        warnings[0].starts_with("drop-unmatched: `frames.npy#9` in `frames_named`"),
        "{warnings:?}"
    );
}

#[test]
fn files_that_are_rows_are_left_out_by_their_names() {
    let files = [("p_1.5.png", ""), ("p_2.5.png", "")];
    let map = format!(
        "table = {{ files = \"*.png\" }}\n[path]\npattern = \"p_{{fz:number}}.png\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"path.fz\", unit = \"N\" }}\n[drop]\nrows = [2]\n{NO_TIME}"
    );
    let problem = refused(&files, &map);
    assert!(
        problem.contains("`frames_named = [\"p_1.5.png\"]`"),
        "{problem}"
    );
}
