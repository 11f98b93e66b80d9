//! Tests of clocks whose lag differs in every run.

use super::{FACTS, assert_near, codes, imported, lab, planned, summary};

const FORCES: &str = "t,fz\n0,0\n1,1\n2,2\n3,3\n";

fn map(table: &str, lag: &str, more: &str) -> String {
    format!(
        "map_version = 2\ntable = {table}\n{more}[columns]\nFz = {{ from = \"ft.fz\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n\
         [[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\npick = \"linear\"\ntolerance_ms = 2000\nlag_ms = {lag}\n{FACTS}"
    )
}

#[test]
fn a_lag_by_file_and_by_column_moves_each_run_by_its_own() {
    let runs = lab(&[
        ("run/1.csv", "t,lag\n1,250\n2,250\n"),
        ("run/2.csv", "t,lag\n1,-500\n2,-500\n"),
        ("ft.csv", FORCES),
    ]);
    let json = lab(&[
        (
            "t.jsonl",
            "{\"t\": 1, \"lag\": 250}\n{\"t\": 2, \"lag\": 250}\n{\"t\": 1, \"lag\": -500}\n{\"t\": 2, \"lag\": -500}\n",
        ),
        ("ft.csv", FORCES),
    ]);
    let files = "{ \"run/1.csv\" = 250, \"run/2.csv\" = -500 }";
    for (folder, table, lag) in [
        (&runs, "\"run/*.csv\"", files),
        (&runs, "\"run/*.csv\"", "\"lag\""),
        (&json, "\"t.jsonl\"", "\"/lag\""),
    ] {
        let map = map(table, lag, "");
        // Columns of JSON are pointers.
        let map = match table.contains("jsonl") {
            true => map.replacen("column = \"t\"", "column = \"/t\"", 1),
            false => map,
        };
        let found = imported(folder.path(), &map, "Fz");
        for (found, expected) in found.iter().zip([1.25, 2.25, 0.5, 1.5]) {
            assert_near(*found, expected);
        }
        assert_eq!(found.len(), 4, "{lag}");
    }
    // By the joined table: each run has its own.
    let pairs = lab(&[
        ("run/1.csv", "t\n1\n2\n"),
        ("run/2.csv", "t\n1\n2\n"),
        ("1_ft.csv", FORCES),
        ("2_ft.csv", FORCES),
    ]);
    let path = "path = { pattern = \"run/{n}.csv\" }\n";
    let lag = "{ \"1_ft.csv\" = 250, \"2_ft.csv\" = -500 }";
    let map = map("\"run/*.csv\"", lag, path).replace("\"ft.csv\"", "\"{path.n}_ft.csv\"");
    let found = imported(pairs.path(), &map, "Fz");
    assert_eq!(found, [1.25, 2.25, 0.5, 1.5]);
}

#[test]
fn a_file_without_a_lag_and_a_lag_that_is_no_number_are_refused() {
    let folder = lab(&[
        ("run/1.csv", "t,lag,note\n1,250,late\n"),
        ("run/2.csv", "t,lag,note\n1,,late\n"),
        ("ft.csv", FORCES),
    ]);
    for (lag, words) in [
        ("{ \"run/1.csv\" = 250 }", "add `\"run/2.csv\" = …`"),
        ("\"lag\"", "empty, expected the lag of join `ft` in ms"),
        ("\"note\"", "`late`"),
        ("\"gone\"", "gone"),
        ("{ \"run/1.csv\" = inf }", "a finite lag"),
    ] {
        let problem = planned(folder.path(), &map("\"run/*.csv\"", lag, "")).map(|_| ());
        let problem = problem.expect_err("refused");
        assert!(problem.contains(words), "{lag}: {problem}");
    }
}

#[test]
fn a_join_in_which_most_rows_of_both_sides_match_none_is_warned_of() {
    let rows = |begin: i32, step: i32| -> String {
        let rows = (0..20).map(|row| format!("{},{row}.5\n", begin + step * row));
        rows.collect()
    };
    // A clip of 20 s, and presses over 800 s: one matches by chance.
    let main = format!("t,lag\n{}", rows(0, 1));
    let of = |begin: i32, step: i32| {
        let presses = format!("t,fz\n{}", rows(begin, step));
        let folder = lab(&[("run.csv", &main), ("ft.csv", &presses)]);
        let map = map("\"run.csv\"", "0", "").replace("tolerance_ms = 2000", "tolerance_ms = 100");
        let map = map.replace(
            "pick = \"linear\"",
            "pick = \"nearest\"\nunmatched = \"drop\"",
        );
        codes(&summary(folder.path(), &map))
    };
    assert_eq!(of(0, 40), ["join-few"]);
    assert!(of(0, 1).is_empty());
}
