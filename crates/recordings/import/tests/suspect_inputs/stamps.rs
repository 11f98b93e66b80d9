//! Tests of joins by times that several rows share.

use super::{FACTS, codes, lab, summary};

/// Codes of the warnings, and summary, of an import that joins `rows` times in whole seconds with the file `name`. `time` is the time of the join in
/// the map.
fn warned(rows: u32, [name, text, from, time]: [&str; 4]) -> (Vec<&'static str>, String) {
    let times: String = (0..rows).map(|row| format!("{}\n", row / 10)).collect();
    let folder = lab(&[("t.csv", &format!("t\n{times}")), (name, text)]);
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\n[columns]\nFz = {{ from = \"{from}\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\n\
         unit = \"s\"\n[[join]]\nname = \"ft\"\ntable = \"{name}\"\ntime = {{ {time} }}\npick = \"nearest\"\ntolerance_ms = 500\nlag_ms = 0\n{FACTS}"
    );
    let found = summary(folder.path(), &map);
    (codes(&found), found.to_string())
}

/// Table of `rows` rows under `header`.
fn table(header: &str, rows: u32, row: impl Fn(u32) -> String) -> String {
    let rows: String = (0..rows)
        .map(|number| format!("{}\n", row(number)))
        .collect();
    format!("{header}{rows}")
}

const BY_SECONDS: &str = "column = \"t\", unit = \"s\"";

#[test]
fn a_join_of_whole_seconds_is_warned_of_in_tables_of_every_form_and_unit() {
    let force = |row: u32| 0.5 * f64::from(row);
    let seconds = table("t,fz\n", 40, |row| format!("{},{}", row / 10, force(row)));
    let nanoseconds = table("", 40, |row| {
        format!(
            "{{\"w\": {{\"z\": {}}}, \"t\": {}}}",
            force(row),
            u64::from(row / 10) * 1_000_000_000
        )
    });
    let milliseconds = table("fz;stamp\n", 40, |row| {
        format!("{};{}", force(row), row / 10 * 1000)
    });
    for joined in [
        ["ft.csv", seconds.as_str(), "ft.fz", BY_SECONDS],
        [
            "ft.jsonl",
            nanoseconds.as_str(),
            "ft./w/z",
            "column = \"/t\", unit = \"ns\"",
        ],
        [
            "ft.csv",
            milliseconds.as_str(),
            "ft.fz",
            "column = \"stamp\", unit = \"ms\"",
        ],
    ] {
        let (codes, said) = warned(40, joined);
        assert_eq!(codes, ["repeated-stamps"], "{said}");
        for words in [
            "the 40 rows of join `ft` have only 4 different times",
            "`on = \"row\"`",
        ] {
            assert!(said.contains(words), "{said}");
        }
    }
}

#[test]
fn times_with_fractions_and_a_few_equal_ones_are_no_clock_of_whole_seconds() {
    let fractions = table("t,fz\n", 40, |row| format!("{},0.5", f64::from(row) * 0.1));
    let few = table("t,fz\n", 8, |_| "0,0.5".to_owned());
    for (rows, text) in [(40, &fractions), (8, &few)] {
        let (codes, said) = warned(rows, ["ft.csv", text, "ft.fz", BY_SECONDS]);
        assert_eq!(codes, [""; 0], "{said}");
    }
}
