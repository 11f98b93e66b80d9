//! Tests of times declared in a Parquet file. They are read in seconds from any unit, and the map never scales them.

use std::fs;

use super::{imported_from, lab, planned};

/// Folder with a file written by pyarrow, and with `files`.
fn times(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = lab(files);
    let written = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../formats/tables/tests/data/times/times.parquet"
    );
    fs::copy(written, folder.path().join("times.parquet")).expect("copied");
    folder
}

fn map(column: &str, unit: &str) -> String {
    format!(
        "table = \"times.parquet\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[time]\nclock = \"unix\"\ncolumn = \"{column}\"\nunit = \"{unit}\"\n"
    )
}

#[test]
fn time_stamps_durations_and_times_of_day_are_seconds_by_their_type() {
    let folder = times(&[]);
    for (column, expected) in [
        (
            "stamp_s",
            ["-1.0", "0.0", "1.0", "86399.0", "", "1700000000.0"],
        ),
        (
            "stamp_ms",
            ["-0.501", "0.0", "1.0", "86399.199", "", "1700000000.0"],
        ),
        (
            "zoned_us",
            [
                "-0.500001",
                "0.0",
                "1.0",
                "86399.043199",
                "",
                "1700000000.0",
            ],
        ),
        (
            "stamp_ns",
            [
                "-0.500000001",
                "0.0",
                "1.0",
                "86399.000043199",
                "",
                "1700000000.35",
            ],
        ),
        (
            "duration_s",
            ["-1.0", "0.0", "1.0", "86399.0", "", "1700000000.0"],
        ),
        (
            "duration_us",
            [
                "-0.500001",
                "0.0",
                "1.0",
                "86399.043199",
                "",
                "1700000000.0",
            ],
        ),
        ("time_s", ["0.0", "1.0", "2.0", "0.0", "", "80001.0"]),
        (
            "date32",
            ["-86400.0", "0.0", "86400.0", "172800.0", "", "1699920000.0"],
        ),
    ] {
        let (_, found) = imported_from(folder.path(), &map(column, "s"), &["t_s"]);
        assert_eq!(found[0], expected, "{column}");
    }
}

#[test]
fn a_map_that_states_another_unit_of_typed_times_is_refused_naming_both() {
    let folder = times(&[("ft.csv", "t,v\n0,1\n")]);
    let problem = planned(folder.path(), &map("stamp_us", "us")).expect_err("refused");
    for words in [
        "times.parquet, column `stamp_us`",
        "times in us",
        "`unit = \"us\"`",
        "write `unit = \"s\"`",
    ] {
        assert!(problem.contains(words), "no `{words}` in {problem}");
    }
    // Undeclared integers are in the unit of the map.
    let (_, found) = imported_from(folder.path(), &map("count", "ms"), &["t_s"]);
    assert_eq!(found[0][5], "1700000.0");
    // A channel, and the time of a joined table.
    let channel = "table = \"times.parquet\"\n[columns]\nhold = { from = \"duration_ms\", unit = \"ms\" }\n[time]\nclock = \"unknown\"\n";
    let problem = planned(folder.path(), channel).expect_err("refused");
    assert!(problem.contains("column `duration_ms`"), "{problem}");
    let joined = "table = \"ft.csv\"\n[[join]]\nname = \"p\"\ntable = \"times.parquet\"\ntime = { column = \"time_us\", unit = \"us\" }\ntolerance_ms = 1\nlag_ms = 0\n[columns]\nFz = { from = \"p.Fz\", unit = \"N\" }\n[time]\nclock = \"unix\"\ncolumn = \"t\"\nunit = \"s\"\n";
    let problem = planned(folder.path(), joined).expect_err("refused");
    assert!(problem.contains("column `time_us`"), "{problem}");
}

#[test]
fn tables_of_typed_and_of_written_times_are_joined_in_seconds() {
    let folder = times(&[("ft.csv", "t,v\n-0.5,4\n1.0001,5\n1700000000.35,6\n")]);
    let map = "table = \"ft.csv\"\n[[join]]\nname = \"p\"\ntable = \"times.parquet\"\ntime = { column = \"count\", unit = \"s\" }\ntolerance_ms = 1\nlag_ms = 0\nunmatched = \"drop\"\n[columns]\nFz = { from = \"v\", unit = \"N\" }\nhold = { from = \"p.duration_ns\", unit = \"s\" }\n[time]\nclock = \"unix\"\ncolumn = \"t\"\nunit = \"s\"\n";
    let (summary, found) = imported_from(folder.path(), map, &["Fz", "hold"]);
    assert_eq!(found, [["5.0"], ["1.0"]]);
    assert_eq!((summary.rows_kept, summary.joins[0].unmatched), (1, 2));
}
