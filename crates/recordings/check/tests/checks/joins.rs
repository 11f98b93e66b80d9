//! Tests of labels joined by time although the times or the readings do not suit a join by time.

use super::codes;
use super::lab::{PICTURES, SENSOR, imported, pictures};
use super::streams::{message, says_nothing};
use taceva_check::Severity;

/// Report on the main table `cam`, with the forces of the table `ft` joined by time.
fn joined(cam: &str, ft: &str, pick: &str, only: &[&str]) -> taceva_check::CheckReport {
    let rows = cam.lines().count() - 1;
    let presses: Vec<f64> = (0..rows)
        .map(|row| 0.02 * f64::from(u32::try_from(row * 13 % 61).expect("small")))
        .collect();
    let files = [
        ("cam.csv", cam.as_bytes().to_vec()),
        ("ft.csv", ft.as_bytes().to_vec()),
        ("f.npy", pictures(&presses)),
    ];
    let map = format!(
        "map_version = 2\ntable = \"cam.csv\"\n{PICTURES}[columns]\nFz = {{ from = \"ft.fz\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\npick = \"{pick}\"\ntolerance_ms = 1000\nlag_ms = 0\nunmatched = \"drop\"\n{SENSOR}"
    );
    imported(&files, &map, only)
}

const ALL: &[&str] = &["TAC019", "TAC036", "TAC037"];

#[test]
fn forces_that_were_joined_by_whole_seconds_are_warned_of_and_no_lag_is_sought() {
    let report = joined(
        include_str!("../cases/12-join-whole-second-stamps/cam.csv"),
        include_str!("../cases/12-join-whole-second-stamps/ft.csv"),
        "nearest",
        ALL,
    );
    assert_eq!(codes(&report), [("TAC036", Severity::Warning)]);
    assert_eq!(
        message(&report, "TAC036"),
        "150 rows were joined with `ft` by only 5 different times: rows of equal time get the labels of the same row, so a match may be wrong by as much as 1.000 s"
    );
}

#[test]
fn repeated_stamps_are_one_finding_although_the_import_warned_of_them() {
    let report = joined(
        include_str!("../cases/12-join-whole-second-stamps/cam.csv"),
        include_str!("../cases/12-join-whole-second-stamps/ft.csv"),
        "nearest",
        &["TAC036", "TAC043"],
    );
    message(&report, "TAC036");
    let mut findings = report.findings.iter();
    assert!(
        !findings.any(|finding| finding.message.starts_with("repeated-stamps")),
        "{:#?}",
        report.findings
    );
}

#[test]
fn stamps_that_are_all_zero_and_stamps_of_tenths_are_warned_of_and_exact_ones_are_not() {
    let force = |row: u32| 1.0 + 0.01 * f64::from(row * 37 % 100);
    let table = |stamp: &dyn Fn(u32) -> f64, head: &str, cell: &dyn Fn(u32) -> String| {
        let rows = (0..120).map(|row| format!("{}{}", stamp(row), cell(row)));
        std::iter::once(head.to_owned())
            .chain(rows)
            .collect::<Vec<_>>()
            .join("\n")
    };
    type Stamps<'a> = (&'a dyn Fn(u32) -> f64, Option<&'a str>);
    let stamps: [Stamps<'_>; 3] = [
        (
            &|_| 0.0,
            Some("120 rows were joined with `ft` by only 1 different time:"),
        ),
        (
            &|row| f64::from(row / 4) * 0.1,
            Some("120 rows were joined with `ft` by only 30 different times"),
        ),
        (&|row| f64::from(row) / 30.0, None),
    ];
    for (stamp, expected) in stamps {
        let cam = table(stamp, "t,x", &|row| format!(",{row}"));
        let ft = table(stamp, "t,fz", &|row| format!(",{}", force(row)));
        let report = joined(&cam, &ft, "nearest", ALL);
        match expected {
            Some(expected) => {
                let said = message(&report, "TAC036");
                assert!(said.starts_with(expected), "{said}");
            }
            None => says_nothing(&report, "TAC036"),
        }
    }
}

#[test]
fn forces_at_5_hz_beside_pictures_at_30_hz_are_slow_and_linear_is_proposed() {
    let cam = include_str!("../cases/13-join-slow-force/cam.csv");
    let ft = include_str!("../cases/13-join-slow-force/ft.csv");
    let report = joined(cam, ft, "nearest", ALL);
    let said = message(&report, "TAC037");
    assert_eq!(
        said,
        "16 rows of `ft` label 90 rows, up to 7 each: labels are up to 100 ms old; `pick = \"linear\"` would change Fz by 0.176 N on average and by at most 0.526 N"
    );
    assert_eq!(codes(&report), [("TAC037", Severity::Warning)]);
    says_nothing(&joined(cam, ft, "linear", ALL), "TAC037");
}

#[test]
fn slow_forces_in_json_lines_and_milliseconds_are_named_too() {
    let cam: Vec<String> = (0..200)
        .map(|row| format!("{}", f64::from(row) / 50.0))
        .collect();
    let force = |row: u32| {
        let ms = 125 * row;
        let fz = 1.0 + (0.003 * f64::from(ms)).sin();
        format!("{{\"t\": {ms}, \"w\": {{\"z\": {fz:.4}}}}}\n")
    };
    let presses: Vec<f64> = (0..200_u32)
        .map(|row| 0.02 * f64::from(row * 13 % 61))
        .collect();
    let files = [
        ("cam.csv", format!("t\n{}\n", cam.join("\n")).into_bytes()),
        (
            "ft.jsonl",
            (0..33).map(force).collect::<String>().into_bytes(),
        ),
        ("f.npy", pictures(&presses)),
    ];
    let map = format!(
        "map_version = 2\ntable = \"cam.csv\"\n{PICTURES}[columns]\nFz = {{ from = \"ft./w/z\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n[[join]]\nname = \"ft\"\ntable = \"ft.jsonl\"\ntime = {{ column = \"/t\", unit = \"ms\" }}\npick = \"nearest\"\ntolerance_ms = 1000\nlag_ms = 0\n{SENSOR}"
    );
    let report = imported(&files, &map, &["TAC037"]);
    let said = message(&report, "TAC037");
    assert!(
        said.contains("rows of `ft` label 200 rows") && said.contains("would change Fz by"),
        "{said}"
    );
}

#[test]
fn the_reading_before_is_older_and_a_table_that_is_as_fast_is_no_slow_one() {
    let cam: Vec<String> = (0..200)
        .map(|row| format!("{},{row}", f64::from(row) / 50.0))
        .collect();
    let cam = format!("t,x\n{}", cam.join("\n"));
    let force = |rate: f64| {
        let rows = (0..400).map(move |row| {
            let time = f64::from(row) / rate;
            format!("{time},{}", 1.0 + (3.0 * time).sin())
        });
        format!("t,fz\n{}", rows.collect::<Vec<_>>().join("\n"))
    };
    let report = joined(&cam, &force(10.0), "before", ALL);
    let said = message(&report, "TAC037");
    assert!(
        said.contains("up to 5 each: labels are up to 80 ms old"),
        "{said}"
    );
    says_nothing(&joined(&cam, &force(200.0), "nearest", ALL), "TAC037");
    says_nothing(&joined(&cam, &force(50.0), "nearest", ALL), "TAC037");
}

#[test]
fn a_log_whose_clock_is_ahead_is_warned_of_with_the_lag_to_write() {
    let press = |row: i32| -> f64 {
        let depth = 0.4 + 0.2 * f64::from((row.div_euclid(40) * 3).rem_euclid(4));
        depth * (1.0 - (f64::from(row.rem_euclid(40)) / 20.0 - 1.0).abs())
    };
    let presses: Vec<f64> = (0..240).map(press).collect();
    let time = |row: i32| f64::from(row) / 30.0;
    let cam: String = (0..240).map(|row| format!("{:.4}\n", time(row))).collect();
    for (ahead_s, lag_ms, expected) in [
        (0.2, "0", Some("later than the pictures")),
        (0.2, "133", Some("67 ms (2 steps) later")),
        (0.2, "200", None),
        (-0.2, "0", Some("earlier than the pictures")),
    ] {
        let ft = (-40..280).map(|row| format!("{:.4},{:.4}\n", time(row) + ahead_s, press(row)));
        let files = [
            ("cam.csv", format!("t\n{cam}").into_bytes()),
            (
                "ft.csv",
                format!("t,fz\n{}", ft.collect::<String>()).into_bytes(),
            ),
            ("f.npy", pictures(&presses)),
        ];
        let map = format!(
            "map_version = 2\ntable = \"cam.csv\"\n{PICTURES}[columns]\nFz = {{ from = \"ft.fz\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\npick = \"linear\"\ntolerance_ms = 100\nlag_ms = {lag_ms}\n{SENSOR}"
        );
        let report = imported(&files, &map, &["TAC019"]);
        let Some(expected) = expected else {
            says_nothing(&report, "TAC019");
            continue;
        };
        let said = message(&report, "TAC019");
        assert!(said.contains(expected), "{said}");
        let right = format!(
            "`lag_ms = {:.0}` in the [[join]] `ft` removes it",
            1e3 * ahead_s
        );
        // Lags are found in steps of the pictures.
        if lag_ms == "0" {
            assert_eq!(codes(&report), [("TAC019", Severity::Warning)]);
            assert!(said.contains(&right), "{said}");
        } else {
            assert_eq!(codes(&report), [("TAC019", Severity::Note)]);
            assert!(said.contains("a gel that recovers slowly"), "{said}");
        }
    }
}
