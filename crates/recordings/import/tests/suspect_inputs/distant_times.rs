//! Tests of joins by time across pauses, or with a wrong lag, unit or order of time stamps.

use super::{FACTS, codes, lab, planned, summary};

fn map(more: &str) -> String {
    format!(
        "map_version = 2\ntable = \"cam.csv\"\n[columns]\nFz = {{ from = \"ft.fz\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n\
         [[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\npick = \"linear\"\nunmatched = \"drop\"\n{more}{FACTS}"
    )
}

/// Table of times, s, with a column of forces if `forces` is true.
fn table(times: &[f64], forces: bool) -> String {
    let rows = times.iter().map(|time| match forces {
        true => format!("{time:.4},{:.4}\n", (3.0 * time).sin()),
        false => format!("{time:.4}\n"),
    });
    let head = match forces {
        true => "t,fz\n",
        false => "t\n",
    };
    head.to_owned() + &rows.collect::<String>()
}

fn folder(cam: &[f64], ft: &[f64]) -> tempfile::TempDir {
    lab(&[
        ("cam.csv", &table(cam, false)),
        ("ft.csv", &table(ft, true)),
    ])
}

/// Text of the warning of an import, which must give exactly one. `more` are further lines of its map.
fn warning(folder: &tempfile::TempDir, more: &str) -> String {
    let warnings = summary(folder.path(), &map(more)).warnings;
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn labels_across_the_pauses_of_a_log_are_warned_of_with_the_tolerance_that_leaves_them_out() {
    let presses = (0..6).flat_map(|press| {
        let start = 10.0 * f64::from(press);
        (0..20).map(move |row| start + 0.06 * f64::from(row))
    });
    let ft: Vec<f64> = presses.collect();
    // Each press is seen once in contact and once in the pause behind it; the last pause has no end.
    let cam: Vec<f64> = (0..6)
        .flat_map(|press| [0.51, 5.0].map(|after| 10.0 * f64::from(press) + after))
        .collect();
    let folder = folder(&cam, &ft);
    let warned = warning(&folder, "tolerance_ms = 10000\nlag_ms = 0\n");
    assert!(
        warned.starts_with(
            "join-pause: 5 rows take labels of `ft` from up to 5000 ms away, although its rows are usually 60.0 ms apart"
        ),
        "{warned}"
    );
    assert!(warned.contains("`tolerance_ms = 180`"), "{warned}");
    let narrow = summary(folder.path(), &map("tolerance_ms = 180\nlag_ms = 0\n"));
    assert_eq!((narrow.rows_kept, codes(&narrow)), (6, Vec::new()));
    // A state that lasts until the next row is valid at any distance.
    let held = map("tolerance_ms = 10000\nlag_ms = 0\n").replace("\"linear\"", "\"before\"");
    assert_eq!(codes(&summary(folder.path(), &held)), [""; 0]);
}

#[test]
fn a_long_lag_between_tables_that_share_their_stamps_is_warned_of() {
    // Each picture has the stamp of the last reading of an irregular burst.
    let cam: Vec<f64> = (0..20_u32)
        .map(|row| 1.0 + 4.0 * f64::from(row) + 0.0137 * f64::from(row * 7 % 13))
        .collect();
    let bursts = cam.iter().flat_map(|end| {
        let back = |row: u32| 0.06 * f64::from(row) + 0.001 * f64::from(row * row % 7);
        (0..10).rev().map(move |row| end - back(row))
    });
    let ft: Vec<f64> = bursts.collect();
    let shared = folder(&cam, &ft);
    let warned = warning(&shared, "tolerance_ms = 100\nlag_ms = -200\n");
    assert!(
        warned.starts_with(
            "join-lag: without `lag_ms`, `ft` has rows with the same time, to a microsecond, as 20 of 20 rows"
        ),
        "{warned}"
    );
    // A short lag is the delay of pictures.
    for lag in [0, -50] {
        let map = map(&format!("tolerance_ms = 100\nlag_ms = {lag}\n"));
        assert_eq!(codes(&summary(shared.path(), &map)), [""; 0], "{lag}");
    }
    // Rows of a regular log equal the stamps of pictures by chance.
    let ft: Vec<f64> = (0..1000).map(|row| 0.01 * f64::from(row)).collect();
    let cam: Vec<f64> = (0..20).map(|row| 1.0 + 0.4 * f64::from(row)).collect();
    let regular = folder(&cam, &ft);
    let map = map("tolerance_ms = 100\nlag_ms = -253\n");
    assert_eq!(codes(&summary(regular.path(), &map)), [""; 0]);
}

#[test]
fn two_stamps_that_were_swapped_are_warned_of_with_their_line_and_a_second_run_is_not() {
    let ft: Vec<f64> = (0..100).map(|row| 0.05 * f64::from(row)).collect();
    let mut cam: Vec<f64> = (0..40).map(|row| 0.1 * f64::from(row)).collect();
    let more = "tolerance_ms = 100\nlag_ms = 0\n";
    assert_eq!(
        codes(&summary(folder(&cam, &ft).path(), &map(more))),
        [""; 0]
    );
    cam.swap(20, 21);
    let warned = warning(&folder(&cam, &ft), more);
    assert!(
        warned.starts_with(
            "time-order: the time of 1 row is before that of the row above, first at cam.csv, line 23,"
        ),
        "{warned}"
    );
    cam.swap(20, 21);
    cam.rotate_left(20);
    assert_eq!(
        codes(&summary(folder(&cam, &ft).path(), &map(more))),
        [""; 0]
    );
}

#[test]
fn times_in_another_unit_that_match_nothing_are_refused_with_both_spans_and_the_factor() {
    let ft: Vec<f64> = (0..50).map(|row| 1e6 + 0.1 * f64::from(row)).collect();
    let cam: Vec<f64> = ft.iter().map(|time| 1e3 * time).collect();
    let folder = folder(&cam, &ft);
    let drop = map("tolerance_ms = 50\nlag_ms = 0\n");
    for map in [drop.clone(), drop.replace("\"drop\"", "\"refuse\"")] {
        let problem = planned(folder.path(), &map).map(|_| ());
        let problem = problem.expect_err("refused");
        for words in [
            "times of `ft` are 1000000.000 to 1000004.900 s",
            "times of rows are 1000 times those of the join: correct a `unit`",
        ] {
            assert!(problem.contains(words), "{words}: {problem}");
        }
    }
}

#[test]
fn a_join_that_matches_less_than_half_of_the_rows_is_warned_of_with_both_spans() {
    let ft: Vec<f64> = (0..50).map(|row| 0.1 * f64::from(row)).collect();
    let cam: Vec<f64> = (0..20).map(f64::from).collect();
    let warned = warning(&folder(&cam, &ft), "tolerance_ms = 100\nlag_ms = 0\n");
    assert!(
        warned.starts_with(
            "join-few: `ft` matches 5 of 20 rows: times of the rows plus `lag_ms` are 0.000 to 19.000 s, times of `ft` are 0.000 to 4.900 s"
        ),
        "{warned}"
    );
}

#[test]
fn single_presses_that_match_few_rows_of_a_stream_are_not_warned_of() {
    let presses: Vec<f64> = (0..12).map(|press| 1.0 + 2.0 * f64::from(press)).collect();
    let cam: Vec<f64> = (0..240).map(|row| 0.1 * f64::from(row)).collect();
    let folder = folder(&cam, &presses);
    let map = map("tolerance_ms = 50\nlag_ms = 0\n").replace("\"linear\"", "\"nearest\"");
    let found = summary(folder.path(), &map);
    assert_eq!((found.rows_kept, codes(&found)), (12, Vec::new()));
}
