//! Tests of remedies for recordings made by this program, which have no import map.

use taceva_check::{CheckReport, Finding};

use super::lab::{SENSOR, imported};
use super::{Recording, readings};

/// Finding of the check `code` in `report`.
#[track_caller]
fn finding<'r>(report: &'r CheckReport, code: &str) -> &'r Finding {
    let found = report.findings.iter().find(|own| own.code == code);
    found.unwrap_or_else(|| panic!("{code}: {:#?}", report.findings))
}

/// Report on a recording of this program with an unknown gel, an outlying force and a time that steps back.
fn recorded() -> CheckReport {
    let mut recording = Recording::sound();
    recording.facts.gel = "unknown".into();
    readings(&mut recording.samples[7], |channel, value| {
        Some(if channel == 2 { 15.0 } else { value })
    });
    let stamp = recording.samples[50].stamp.as_mut().expect("a stamp");
    stamp.valid_s -= 1.0;
    recording.check("")
}

#[test]
fn the_remedies_of_a_recording_of_this_program_name_no_map_to_complete() {
    let report = recorded();
    let facts = finding(&report, "TAC012");
    assert!(facts.hint.contains("`taceva reseal`"), "{facts:#?}");
    let far = finding(&report, "TAC013");
    assert!(far.hint.contains("`taceva export`"), "{far:#?}");
    assert!(!far.message.contains("[drop]"), "{far:#?}");
    let mut times = report.findings.iter().filter(|own| own.code == "TAC008");
    let back = times.find(|own| own.message.contains("older"));
    let back = back.unwrap_or_else(|| panic!("{:#?}", report.findings));
    assert!(back.hint.contains("`taceva rig check`"), "{back:#?}");
}

#[test]
fn a_recorded_stream_without_gaps_has_no_remedy() {
    let report = Recording::sound().check("");
    let rate = finding(&report, "TAC008");
    assert!(rate.message.ends_with("without gaps"), "{rate:#?}");
    assert_eq!(rate.hint, "");
}

#[test]
fn the_remedies_of_an_import_name_its_map() {
    let rows = (0..40).map(|row| {
        let force = if row == 7 {
            15.0
        } else {
            0.01 * f64::from(row * 7 % 40)
        };
        format!("{row},{force}\n")
    });
    let table = format!("t,Fz\n{}", rows.collect::<String>()).into_bytes();
    let map = format!(
        "map_version = 2\ntable = \"a.csv\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\ncolumn = \"t\"\n\
         unit = \"s\"\n{SENSOR}"
    );
    let report = imported(&[("a.csv", table)], &map, &["TAC008", "TAC012", "TAC013"]);
    assert!(finding(&report, "TAC012").hint.contains("complete the map"));
    assert!(
        finding(&report, "TAC013")
            .hint
            .contains("[drop] of the map")
    );
    let whole = report
        .findings
        .iter()
        .find(|own| own.message.contains("whole second"));
    let whole = whole.unwrap_or_else(|| panic!("{:#?}", report.findings));
    assert!(whole.hint.starts_with("stamp frames"), "{whole:#?}");
}
