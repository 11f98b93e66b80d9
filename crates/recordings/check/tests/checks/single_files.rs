//! Tests of recordings in which each picture is a file and a row, joined to a log.

use taceva_check::{CheckReport, Severity};

use super::lab::{SENSOR, imported};

/// Findings of the checks `only` on 25 presses. The log contains the time and the force of each press; `drop` is a section of the map.
fn checked(time: fn(u32) -> f64, force: fn(u32) -> f64, drop: &str, only: &[&str]) -> CheckReport {
    let fixture = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../recordings/dataset/tests/fixtures/jpeg/baseline-gray.jpg"
    );
    let jpeg = std::fs::read(fixture).expect("readable");
    let names: Vec<String> = (0..25).map(|number| format!("g_{number:02}.jpg")).collect();
    let rows = (0..25).map(|number| format!("{number},{:.4},{:.3}\n", time(number), force(number)));
    let log = format!("n,t,Fz\n{}", rows.collect::<String>());
    let mut files: Vec<(&str, Vec<u8>)> = vec![("log.csv", log.into_bytes())];
    files.extend(names.iter().map(|name| (name.as_str(), jpeg.clone())));
    let map = format!(
        "map_version = 2\ntable = {{ files = \"g_*.jpg\" }}\n[path]\npattern = \"g_{{n:number}}.jpg\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"log.Fz\", unit = \"N\" }}\n[time]\nclock = \"unix\"\ncolumn = \"log.t\"\nunit = \"s\"\n[[join]]\nname = \"log\"\ntable = \"log.csv\"\non = {{ \"path.n\" = \"n\" }}\n{drop}{SENSOR}"
    );
    imported(&files, &map, only)
}

/// Time of press `number`, s. Presses are 4.3 s apart, in a different order than the names of their pictures.
fn shuffled(number: u32) -> f64 {
    1.76e9 + 4.3 * f64::from(number * 7 % 25)
}

/// Force of press `number`, N: up to 2.4 N, except 15 N in press 7.
fn one_far(number: u32) -> f64 {
    match number {
        7 => 15.0,
        number => 0.1 * f64::from(number),
    }
}

#[test]
fn times_of_files_that_are_rows_are_ordered_and_of_single_pictures_there_is_nothing_to_mend() {
    let report = checked(shuffled, one_far, "", &["TAC008"]);
    assert_eq!(report.findings.len(), 1, "{:#?}", report.findings);
    let finding = &report.findings[0];
    let expected = "single pictures, not a stream: the median step is 4.3000 s, above ";
    assert!(finding.message.starts_with(expected), "{finding:#?}");
    assert_eq!(finding.hint, "");
    // A stream of files has its rate, and the remedy of the check.
    let report = checked(
        |number| 1.76e9 + 0.05 * f64::from(number * 7 % 25),
        one_far,
        "",
        &["TAC008"],
    );
    let finding = &report.findings[0];
    assert!(finding.message.starts_with("20.0000 Hz"), "{finding:#?}");
    assert!(!finding.hint.is_empty());
}

#[test]
fn a_label_far_from_all_others_is_given_with_its_sample_and_the_line_that_leaves_it_out() {
    let report = checked(shuffled, one_far, "", &["TAC013"]);
    let [finding] = report.findings.as_slice() else {
        panic!("{:#?}", report.findings);
    };
    assert_eq!(finding.samples, ["7"]);
    let message = &finding.message;
    assert!(message.contains("such as 15 N in sample 7; "), "{message}");
    let (_, line) = message
        .split_once("write under [drop] of the map: ")
        .expect("a line");
    assert_eq!(line, "frames_named = [\"g_07.jpg\"]");
    let left = checked(shuffled, one_far, &format!("[drop]\n{line}\n"), &["TAC013"]);
    assert_eq!((left.samples, left.findings.len()), (24, 0));
}

#[test]
fn files_of_which_each_begins_its_own_clock_have_no_repeated_times() {
    let two_sessions = |number: u32| 1.76e9 + 4.3 * f64::from(number % 13);
    let report = checked(two_sessions, one_far, "", &["TAC008"]);
    let [finding] = report.findings.as_slice() else {
        panic!("{:#?}", report.findings);
    };
    assert_eq!(finding.severity, Severity::Note, "{finding:#?}");
}
