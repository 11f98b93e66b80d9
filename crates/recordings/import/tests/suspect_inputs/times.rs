//! Tests of times written as text.

use super::drafts::{filled, with_pictures};
use super::{FACTS, case, codes, draft, imported, lab, map_of, parquet_lab, planned, summary};
use taceva_tables::Cell;

#[test]
fn dates_and_times_as_text_are_seconds_and_a_zone_that_nobody_states_is_warned_of() {
    let folder = case("times-as-text");
    let map = map_of("times-as-text");
    let times = imported(&folder, &map, "t_s");
    assert_eq!(times.first(), Some(&1_729_997_999.0));
    for pair in times.windows(2) {
        assert!((pair[1] - pair[0] - 0.1).abs() < 1e-6, "{pair:?}");
    }
    assert_eq!(codes(&summary(&folder, &map)), ["zone-unstated"]);
    let stated = map.replace("unit = \"s\"", "unit = \"s\"\nzone = \"+02:00\"");
    assert_eq!(codes(&summary(&folder, &stated)), [""; 0]);
    assert_eq!(
        imported(&folder, &stated, "t_s").first(),
        Some(&1_729_990_799.0)
    );
}

fn rest(clock: &str, more: &str) -> String {
    format!(
        "[columns]\nFz = {{ from = \"fz\", unit = \"N\" }}\n[time]\nclock = \"{clock}\"\ncolumn = \"t\"\nunit = \"s\"\n{more}{FACTS}"
    )
}

#[test]
fn zones_in_texts_times_of_day_through_midnight_and_fractions_of_any_length_are_read() {
    for (cells, clock, expected, warned) in [
        (
            ["2024-10-27T01:00:00+02:00", "2024-10-27T01:00:00.5+02:00"],
            "unix",
            [1_729_983_600.0, 1_729_983_600.5],
            &[][..],
        ),
        (
            ["2024-10-26T23:00:00.25Z", "2024-10-26T23:00:01Z"],
            "unix",
            [1_729_983_600.25, 1_729_983_601.0],
            &[],
        ),
        (
            ["23:59:59.875", "00:00:00.125"],
            "monotonic",
            [86_399.875, 86_400.125],
            &["midnight"],
        ),
        (
            ["2024/10/26 23:00:00.250000", "2024/10/26 23:00:01"],
            "monotonic",
            [1_729_983_600.25, 1_729_983_601.0],
            &[],
        ),
    ] {
        let folder = lab(&[("t.csv", &format!("t,fz\n{},1\n{},2\n", cells[0], cells[1]))]);
        let map = format!("map_version = 2\ntable = \"t.csv\"\n{}", rest(clock, ""));
        assert_eq!(imported(folder.path(), &map, "t_s"), expected, "{cells:?}");
        assert_eq!(codes(&summary(folder.path(), &map)), warned, "{cells:?}");
    }
}

#[test]
fn texts_of_times_in_json_lines_and_parquet_are_seconds_too() {
    let texts = ["2024-10-26T23:00:00.25Z", "2024-10-27T01:00:01+02:00"];
    let lines = texts.map(|text| format!("{{\"t\": \"{text}\", \"fz\": 1}}\n"));
    let json = lab(&[("t.jsonl", &lines.concat())]);
    let rows = texts.map(|text| vec![Cell::Text(text.to_owned()), Cell::Number(1.0)]);
    let parquet = parquet_lab("t.parquet", &["t", "fz"], &rows);
    let pointers = rest("unix", "")
        .replace("\"fz\"", "\"/fz\"")
        .replace("\"t\"", "\"/t\"");
    for (folder, table, rest) in [
        (&json, "t.jsonl", pointers),
        (&parquet, "t.parquet", rest("unix", "")),
    ] {
        let map = format!("map_version = 2\ntable = \"{table}\"\n{rest}");
        let times = imported(folder.path(), &map, "t_s");
        assert_eq!(times, [1_729_983_600.25, 1_729_983_601.0], "{table}");
        assert_eq!(codes(&summary(folder.path(), &map)), [""; 0], "{table}");
    }
}

#[test]
fn times_as_text_join_a_table_by_time() {
    let folder = lab(&[
        ("t.csv", "t\n2024-10-27 02:00:00.0\n2024-10-27 02:00:00.1\n"),
        (
            "ft.csv",
            "stamp,fz\n2024-10-27T00:00:00.001Z,1\n2024-10-27T00:00:00.099Z,2\n",
        ),
    ]);
    let join = "[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = { column = \"stamp\", unit = \"s\" }\ntolerance_ms = 5\nlag_ms = 0\n";
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\n{}{join}",
        rest("unix", "zone = \"+02:00\"\n").replace("from = \"fz\"", "from = \"ft.fz\"")
    );
    assert_eq!(imported(folder.path(), &map, "Fz"), [1.0, 2.0]);
}

#[test]
fn texts_of_two_kinds_another_unit_and_other_dates_are_refused_by_their_row() {
    for (cells, unit, words) in [
        (["2024-10-27 01:00:00", "1.5"], "s", "line 3"),
        (
            ["2024-10-27 01:00:00", "2024-10-27 01:00:00Z"],
            "s",
            "time zone",
        ),
        (["2024-10-27 01:00:00", "01:00:01"], "s", "line 3"),
        (
            ["2024-10-27 01:00:00", "2024-10-27 01:00:01"],
            "ms",
            "`unit = \"s\"`",
        ),
        (
            ["27.10.2024 01:00:00", "27.10.2024 01:00:01"],
            "s",
            "ISO 8601",
        ),
        (
            ["2023-02-29 01:00:00", "2023-02-29 01:00:01"],
            "s",
            "ISO 8601",
        ),
    ] {
        let folder = lab(&[("t.csv", &format!("t,fz\n{},1\n{},2\n", cells[0], cells[1]))]);
        let map = format!(
            "map_version = 2\ntable = \"t.csv\"\n{}",
            rest("monotonic", "")
        );
        let map = map.replace("unit = \"s\"", &format!("unit = {unit:?}"));
        let problem = planned(folder.path(), &map).expect_err("refused");
        assert!(problem.contains(words), "{cells:?}: {problem}");
    }
}

#[test]
fn a_draft_takes_texts_of_times_for_the_time() {
    let folder = case("times-as-text");
    let draft = draft(&folder);
    assert!(
        draft.contains("column = \"stamp\"\nunit = \"s\""),
        "{draft}"
    );
    assert!(draft.contains("clock = \"unix\""), "{draft}");
}

#[test]
fn numbers_in_names_of_pictures_are_drafted_as_times_if_they_are_stamps() {
    for (names, unit, expected) in [
        (
            ["1700000000123.png", "1700000000156.png"],
            "ms",
            [1_700_000_000.123, 1_700_000_000.156],
        ),
        (
            [
                "cam/gel_1700000000123000.png",
                "cam/gel_1700000000156000.png",
            ],
            "us",
            [1_700_000_000.123, 1_700_000_000.156],
        ),
        (
            [
                "a/1700000000125000000_left.png",
                "a/1700000000250000000_left.png",
            ],
            "ns",
            [1_700_000_000.125, 1_700_000_000.25],
        ),
    ] {
        let folder = with_pictures(&[], &names);
        let text = draft(folder.path());
        let words = "clock = \"unix\"   # a guess by the size of the numbers\ncolumn = \"path.";
        assert!(text.contains(words), "{text}");
        assert!(text.contains(&format!("\nunit = {unit:?}\n")), "{text}");
        let times = imported(folder.path(), &filled(&text), "t_s");
        for (found, expected) in times.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
        }
        assert_eq!(times.len(), 2, "{text}");
    }
    // Counters of any length are no times.
    for names in [
        ["0000000000123.png", "0000000000156.png"],
        ["1700000000.png", "1700000001.png"],
        ["9700000000123.png", "9700000000156.png"],
    ] {
        let text = draft(with_pictures(&[], &names).path());
        assert!(text.contains("[time]\nclock = \"unknown\""), "{text}");
    }
}
