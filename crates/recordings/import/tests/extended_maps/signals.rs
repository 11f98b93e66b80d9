//! Tests of `[signals]` of a map: columns, cells and arrays of numbers, their order and unit, rows without contact, and rejections.

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::{SilentProgress, Unit};
use taceva_dataset::Dataset;

use super::arrays::{bytes_of, npy};
use super::{NO_TIME, lab, planned, refused};

/// Table of two taxels with two numbers each, in four columns, with a row that is dropped.
const SKIN: &str = "Fz,a,b,c,d\n0,1,2,3,4\n-1,9,9,9,9\n0,5,6,7,8\n2,10,20,30,40\n";
const MAP: &str = r#"
table = "skin.csv"
[columns]
Fz = { from = "Fz", unit = "N" }
[drop]
placeholders = { Fz = -1 }
"#;

fn map(signals: &str) -> String {
    format!("{MAP}{NO_TIME}[signals]\n{signals}\n")
}

fn opened(folder: &Path, map: &str) -> Result<(tempfile::TempDir, Dataset), String> {
    let plan = planned(folder, map)?;
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("dataset");
    plan.run(&path, NonZeroUsize::MIN, &SilentProgress)
        .map_err(|error| error.to_string())?;
    Ok((target, Dataset::open(&path).expect("a dataset")))
}

/// Signals of each row of the dataset.
fn numbers(files: &[(&str, &str)], map: &str) -> Vec<Vec<f32>> {
    let (_target, dataset) = opened(lab(files).path(), map).expect("imported");
    let rows = dataset.all_rows().into_iter();
    let signals = |row| dataset.signals(row).expect("read").expect("there");
    rows.map(|row| signals(row).into_values()).collect()
}

#[test]
fn columns_are_taken_place_first_or_channel_first() {
    let files = [("skin.csv", SKIN)];
    let place = map(r#"from = ["a", "b", "c", "d"]
        unit = "count"
        places = [2, 1]
        channels = ["x", "y"]
        order = "place-first""#);
    let expected = [
        [1.0, 2.0, 3.0, 4.0],
        [5.0, 6.0, 7.0, 8.0],
        [10.0, 20.0, 30.0, 40.0],
    ];
    assert_eq!(numbers(&files, &place), expected);
    let channel = place.replace("place-first", "channel-first");
    let expected = [
        [1.0, 3.0, 2.0, 4.0],
        [5.0, 7.0, 6.0, 8.0],
        [10.0, 30.0, 20.0, 40.0],
    ];
    assert_eq!(numbers(&files, &channel), expected);
}

#[test]
fn one_cell_may_pack_all_numbers_and_units_are_converted_once() {
    let files = [(
        "skin.csv",
        "Fz,taxels\n1,\"[[0.1, 0.2], [0.3, 1e-2]]\"\n2,1;2;3;4\n",
    )];
    let packed = map(r#"from = "taxels"
        unit = "mT"
        places = [2, 2]
        channels = ["z"]"#);
    let expected = [
        [100.0, 200.0, 300.0, 10.0],
        [1_000.0, 2_000.0, 3_000.0, 4_000.0],
    ];
    assert_eq!(numbers(&files, &packed), expected);
    let (_target, dataset) = opened(lab(&files).path(), &packed).expect("imported");
    let signals = dataset.header().signals.as_ref().expect("signals");
    assert_eq!(signals.spec.info.unit, Unit::Microtesla);
}

#[test]
fn rows_without_contact_are_those_of_the_table_and_become_those_of_the_dataset() {
    let signals = map(r#"from = ["a", "b", "c", "d"]
        unit = "V"
        places = [2, 2]
        channels = ["pressure"]
        rest = ["0..2"]"#);
    let (_target, dataset) = opened(lab(&[("skin.csv", SKIN)]).path(), &signals).expect("imported");
    // The second row of the table is dropped.
    assert_eq!(dataset.rest_rows().collect::<Vec<_>>(), [0, 1]);
    let rest = dataset.rest().expect("read").expect("known");
    assert_eq!(rest.values(), [3.0, 4.0, 5.0, 6.0]);
    assert_eq!(dataset.header().unmentioned_columns, [""; 0]);
}

#[test]
fn signals_of_another_table_are_joined() {
    let files = [
        ("skin.csv", "Fz,t\n1,0.0\n2,0.1\n"),
        ("taxels.csv", "0.001,7,8\n0.101,9,10\n"),
    ];
    let joined = format!(
        r#"{}{NO_TIME}
        [[join]]
        name = "skin"
        table = {{ file = "taxels.csv", header = false }}
        time = {{ column = 0, unit = "s" }}
        tolerance_ms = 5
        lag_ms = 0
        [signals]
        from = "skin.1..2"
        unit = "pF"
        places = [1, 2]
        channels = ["c"]"#,
        MAP.replace("[drop]\nplaceholders = { Fz = -1 }\n", "")
    )
    .replace(
        "clock = \"unknown\"",
        "clock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"",
    );
    assert_eq!(numbers(&files, &joined), [[7.0, 8.0], [9.0, 10.0]]);
}

#[test]
fn a_cell_without_a_number_is_named_by_file_row_and_column_unless_its_row_is_dropped() {
    let signals = map(r#"from = ["a", "b", "c", "d"]
        unit = "count"
        places = [1, 4]
        channels = ["p"]"#);
    let dropped = SKIN.replace("-1,9,9", "-1,,nan");
    assert_eq!(numbers(&[("skin.csv", &dropped)], &signals).len(), 3);
    for cell in ["", "nan", "inf", "1e39", "x"] {
        let broken = SKIN.replace("30,40", &format!("{cell},40"));
        let message = refused(&[("skin.csv", &broken)], &signals);
        assert!(
            message.contains("skin.csv")
                && message.contains("`c`")
                && message.contains("finite number of count"),
            "{cell}: {message}"
        );
    }
}

#[test]
fn what_a_map_may_not_say_of_signals_is_refused_with_its_line() {
    let good = r#"from = ["a", "b", "c", "d"]
unit = "count"
places = [2, 1]
channels = ["x", "y"]
order = "place-first""#;
    for (from, to, said) in [
        ("order = \"place-first\"", "", "needs `order`"),
        ("[2, 1]", "[3, 1]", "4 columns for 3×1 places of 2"),
        ("[2, 1]", "[0, 1]", "at most 16384"),
        (
            "\"x\", \"y\"",
            "\"x\", \"x\"",
            "two numbers of a place are called `x`",
        ),
        (
            "\"x\", \"y\"",
            "\"x\", \"y z\"",
            "is not a valid column name",
        ),
        ("\"count\"", "\"?\"", "a draft leaves open"),
        ("\"count\"", "\"counts\"", "unknown unit `counts`"),
        ("[\"a\", \"b\", \"c\", \"d\"]", "[]", "no column"),
        (
            "[\"a\", \"b\", \"c\", \"d\"]",
            "\"4..1\"",
            "expected columns by number",
        ),
        (
            "[\"a\", \"b\", \"c\", \"d\"]",
            "{ file = \"../x.npy\" }",
            "contains `..`, expected a path inside the folder",
        ),
        (
            "place-first\"",
            "place-first\"\nrest = \"9..1\"",
            "expected rows such as",
        ),
        ("place-first\"", "place-first\"\nunits = 3", "units"),
    ] {
        let written = good.replace(from, to);
        assert_ne!(written, good, "{from}");
        let message = refused(&[("skin.csv", SKIN)], &map(&written));
        assert!(
            message.contains("map.toml") && message.contains(said),
            "{to}: {message}"
        );
    }
    let message = refused(&[("skin.csv", SKIN)], &map(&good.replace("\"d\"", "\"e\"")));
    assert!(message.contains("no column `e`"), "{message}");
}

#[test]
fn an_array_of_other_rows_or_numbers_than_the_table_is_refused() {
    let folder = lab(&[("skin.csv", "Fz\n1\n2\n3\n")]);
    let write = |shape: &str, values: &[f32]| {
        let file = npy("<f4", shape, &bytes_of(values));
        std::fs::write(folder.path().join("taxels.npy"), file).expect("written");
    };
    let signals = map(r#"from = { file = "taxels.npy" }
        unit = "count"
        places = [1, 2]
        channels = ["p"]"#);
    let said = || {
        opened(folder.path(), &signals)
            .map(drop)
            .expect_err("refused")
    };
    let good = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    write("(3, 1, 2)", &good);
    let (_target, dataset) = opened(folder.path(), &signals).expect("imported");
    assert_eq!(
        dataset.signals(2).expect("read").expect("there").values(),
        [5.0, 6.0]
    );
    write("(2, 3)", &good);
    assert!(
        said().contains("places = [1, 2] of 1 number give"),
        "{}",
        said()
    );
    write("(2, 2)", &good[..4]);
    assert!(said().contains("2 rows of signals"), "{}", said());
    write("(4, 2)", &[good.as_slice(), &[7.0, 8.0]].concat());
    assert!(
        said().contains("4 rows of signals for 3 rows"),
        "{}",
        said()
    );
    let mut broken = good;
    broken[3] = f32::NAN;
    write("(3, 2)", &broken);
    assert!(
        said().contains("row 1: number 1 of its signals is NaN"),
        "{}",
        said()
    );
}

/// Folder with three rows of 4 × 3 taxels with two numbers each, as an array of the shape `shape`, and with their forces.
fn taxels_lab(shape: &str) -> tempfile::TempDir {
    let folder = lab(&[("skin.csv", "Fz\n1\n2\n3\n")]);
    let numbers: Vec<f32> = (0..72_u8).map(f32::from).collect();
    let array = npy("<f4", shape, &bytes_of(&numbers));
    std::fs::write(folder.path().join("taxels.npy"), array).expect("written");
    folder
}

#[test]
fn an_array_that_is_transposed_or_of_another_shape_is_refused_naming_both() {
    let taxels = |order: &str| {
        let columns = MAP.replace("[drop]\nplaceholders = { Fz = -1 }\n", "");
        format!(
            "{columns}{NO_TIME}[signals]\nfrom = {{ file = \"taxels.npy\" }}\nunit = \"uT\"\nplaces = [4, 3]\nchannels = [\"x\", \"y\"]\norder = \"{order}\"\n"
        )
    };
    for (shape, order, accepted) in [
        ("(3, 4, 3, 2)", "place-first", true),
        ("(3, 12, 2)", "place-first", true),
        ("(3, 24)", "channel-first", true),
        ("(3, 2, 4, 3)", "channel-first", true),
        ("(3, 2, 4, 3)", "place-first", false),
        ("(3, 3, 4, 2)", "place-first", false),
        ("(3, 4, 3, 2)", "channel-first", false),
        ("(3, 8, 3)", "place-first", false),
    ] {
        let folder = taxels_lab(shape);
        let outcome = planned(folder.path(), &taxels(order));
        if accepted {
            outcome.expect(shape);
            continue;
        }
        let problem = outcome.expect_err(shape);
        let rest = format!("({}", &shape[4..]);
        for words in ["taxels.npy", &rest, "places = [4, 3] of 2 numbers", order] {
            assert!(problem.contains(words), "no `{words}` in {problem}");
        }
    }
}

#[test]
fn lists_of_lists_in_a_cell_are_held_against_the_places() {
    let packed = |order: &str, channels: &str| {
        let columns = MAP.replace("[drop]\nplaceholders = { Fz = -1 }\n", "");
        format!(
            "{columns}{NO_TIME}[signals]\nfrom = \"taxels\"\nunit = \"uT\"\nplaces = [3, 1]\nchannels = {channels}\norder = \"{order}\"\n"
        )
    };
    let files = |cell: &str| format!("Fz,taxels\n1,\"{cell}\"\n");
    let two = "[\"x\", \"y\"]";
    let place_first = files("[[1, 2], [3, 4], [5, 6]]");
    assert_eq!(
        numbers(&[("skin.csv", &place_first)], &packed("place-first", two)),
        [[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]]
    );
    let problem = refused(&[("skin.csv", &place_first)], &packed("channel-first", two));
    assert!(
        problem.contains("skin.csv, line 2, column `taxels`"),
        "{problem}"
    );
    assert!(
        problem.contains("order = \"place-first\" would fit it"),
        "{problem}"
    );
    let ragged = files("[[1, 2, 3], [4, 5], [6]]");
    let problem = refused(&[("skin.csv", &ragged)], &packed("place-first", two));
    assert!(problem.contains("lists of 3 and of 2 members"), "{problem}");
}
