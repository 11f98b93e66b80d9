//! Tests of times of a local clock that is set back by an hour at the end of summer time.

use taceva_check::CheckReport;

use super::lab::{SENSOR, imported};
use super::streams::{message, says_nothing};

/// Unix time of the first row, s.
const BEGIN_S: u32 = 1_729_990_790;
/// Row before which the clock is set back.
const CHANGE: u32 = 100;

/// Report on 200 rows in 20 s, in a file with the extension `form`. `time` writes the time of a row as a cell.
fn report(form: &str, [clock, unit]: [&str; 2], time: impl Fn(u32) -> String) -> CheckReport {
    let force = |row: u32| 1.0 + 0.02 * f64::from(row * 37 % 50);
    let (slash, head) = match form {
        "jsonl" => ("/", ""),
        "tsv" => ("", "stamp\tfz\n"),
        _ => ("", "stamp,fz\n"),
    };
    let row = |row: u32| match form {
        "jsonl" => format!("{{\"stamp\": {}, \"fz\": {}}}\n", time(row), force(row)),
        "tsv" => format!("{}\t{}\n", time(row), force(row)),
        _ => format!("{},{}\n", time(row), force(row)),
    };
    let rows: String = (0..200).map(row).collect();
    let name = format!("labels.{form}");
    let map = format!(
        "map_version = 2\ntable = \"{name}\"\n[columns]\nFz = {{ from = \"{slash}fz\", unit = \"N\" }}\n[time]\nclock = \"{clock}\"\ncolumn = \"{slash}stamp\"\nunit = \"{unit}\"\n{SENSOR}"
    );
    let files = [(name.as_str(), format!("{head}{rows}").into_bytes())];
    imported(&files, &map, &["TAC024"])
}

/// Time of day of a row by a local clock, with the zones before and after the change.
fn text(row: u32, zones: [&str; 2]) -> String {
    let (minute, second) = match row < CHANGE {
        true => ("59", 50 + row / 10),
        false => ("00", (row - CHANGE) / 10),
    };
    let zone = zones[usize::from(row >= CHANGE)];
    format!("2024-10-27 02:{minute}:{second:02}.{}{zone}", row % 10)
}

/// Unix time of a row in tenths of a second, an hour earlier after the change.
fn tenths(row: u32) -> u64 {
    let back = if row < CHANGE { 0 } else { 36_000 };
    u64::from(BEGIN_S) * 10 + u64::from(row) - back
}

const SAID: &str = "1 step is about an hour back, first from ";

#[test]
fn a_local_clock_that_is_set_back_by_an_hour_is_named_in_tables_of_every_form_and_unit() {
    let unix = ["unix", "s"];
    let reports = [
        report("csv", unix, |row| text(row, [""; 2])),
        report("jsonl", unix, |row| format!("\"{}\"", text(row, [""; 2]))),
        report("jsonl", unix, |row| {
            format!("{}.{}", tenths(row) / 10, tenths(row) % 10)
        }),
        report("tsv", ["unix", "ms"], |row| (tenths(row) * 100).to_string()),
    ];
    for report in &reports {
        let said = message(report, "TAC024");
        assert!(said.starts_with(SAID) && said.contains("in UTC"), "{said}");
    }
}

#[test]
fn texts_with_their_zone_and_clocks_that_count_from_a_start_are_not_set_back() {
    let stated = |row: u32| text(row, ["+02:00", "+01:00"]);
    says_nothing(&report("csv", ["unix", "s"], stated), "TAC024");
    let running = |row: u32| (tenths(row) - 17_299_000_000).to_string();
    says_nothing(&report("csv", ["monotonic", "s"], running), "TAC024");
    // Takes of five seconds each begin their times anew, the second pair an hour earlier.
    let takes = |row: u32| (tenths(row) - u64::from(row / 50 * 50)) * 100;
    let takes = report("csv", ["unix", "ms"], |row| takes(row).to_string());
    says_nothing(&takes, "TAC024");
}
