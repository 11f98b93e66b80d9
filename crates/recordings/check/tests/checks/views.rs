//! Tests of recordings whose samples have several pictures. Findings name the view.

use taceva_check::{CheckReport, Severity};

use super::lab::{SENSOR, imported, pictures};

const ROWS: usize = 24;

fn presses(phase: usize) -> Vec<f64> {
    let press = |row: usize| f64::from(u32::try_from((row + phase) % 7).expect("small")) / 3.0;
    (0..ROWS).map(press).collect()
}

/// Report on a table with two views, whose pictures are the arrays `left` and `right`.
fn checked(left: &[u8], right: &[u8], only: &[&str]) -> CheckReport {
    let rows = presses(0).into_iter().map(|press| format!("{press},0.5\n"));
    let table = format!("force,still\n{}", rows.collect::<String>());
    let files = [
        ("labels.csv", table.into_bytes()),
        ("left.npy", left.to_vec()),
        ("right.npy", right.to_vec()),
    ];
    let view = |name: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\narray = {{ file = \"{name}.npy\" }}\nchannel_order = \"gray\"\nreference = \"unknown\"\n"
        )
    };
    let map = format!(
        "map_version = 2\ntable = \"labels.csv\"\n{}{}[columns]\nFz = {{ from = \"force\", unit = \"N\" }}\nFx = {{ from = \"still\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\n{SENSOR}",
        view("left"),
        view("right")
    );
    imported(&files, &map, only)
}

/// Pictures whose noise differs from the noise of the other finger.
fn other_finger() -> Vec<u8> {
    let mut bytes = pictures(&presses(0));
    let pixels = bytes.len() - ROWS * 24 * 16;
    bytes[pixels..].iter_mut().for_each(|pixel| *pixel ^= 1);
    bytes
}

/// The pictures in `bytes`, with row `from` copied to row `to`.
fn repeated(mut bytes: Vec<u8>, from: usize, to: usize) -> Vec<u8> {
    let begin = bytes.len() - ROWS * 24 * 16;
    let of = |row: usize| begin + row * 24 * 16..begin + (row + 1) * 24 * 16;
    bytes.copy_within(of(from), of(to).start);
    bytes
}

fn findings<'r>(report: &'r CheckReport, code: &str) -> Vec<&'r str> {
    let found = report.findings.iter().filter(|found| found.code == code);
    found.map(|found| found.message.as_str()).collect()
}

#[test]
fn equal_pictures_in_two_views_are_named_with_both() {
    let (left, right) = (pictures(&presses(0)), other_finger());
    assert!(findings(&checked(&left, &right, &[]), "TAC044").is_empty());
    let report = checked(&left, &left, &["TAC044"]);
    assert_eq!(
        findings(&report, "TAC044"),
        ["the pictures of `left` and `right` are the same file in 24 of 24 samples"]
    );
    assert_eq!(report.findings[0].severity, Severity::Error);
    // In some samples only: one camera froze and the other was copied.
    let mut some = right.clone();
    let begin = some.len() - ROWS * 24 * 16;
    some[begin..begin + 3 * 24 * 16].copy_from_slice(&left[begin..begin + 3 * 24 * 16]);
    let report = checked(&left, &some, &["TAC044"]);
    assert_eq!(
        findings(&report, "TAC044"),
        ["the pictures of `left` and `right` are the same file in 3 of 24 samples"]
    );
    assert_eq!(report.findings[0].severity, Severity::Warning);
}

#[test]
fn a_finding_in_one_view_names_it_and_one_in_both_names_both() {
    let (left, right) = (pictures(&presses(0)), other_finger());
    let one = checked(&left, &repeated(right.clone(), 3, 9), &["TAC002"]);
    assert_eq!(
        findings(&one, "TAC002"),
        ["view `right`: 1 of 24 frames repeat an earlier frame, byte for byte"]
    );
    let both = checked(
        &repeated(left.clone(), 3, 9),
        &repeated(right.clone(), 3, 9),
        &["TAC002"],
    );
    assert_eq!(
        findings(&both, "TAC002"),
        ["views `left`, `right`: 1 of 24 frames repeat an earlier frame, byte for byte"]
    );
    let other = checked(&repeated(left, 1, 2), &repeated(right, 3, 9), &["TAC002"]);
    assert_eq!(findings(&other, "TAC002").len(), 2);
    assert_eq!(other.frames_decoded, 0);
}

#[test]
fn a_finding_about_labels_stands_once_and_names_no_view() {
    let (left, right) = (pictures(&presses(0)), other_finger());
    let report = checked(&left, &right, &[]);
    assert_eq!(report.frames_decoded, 2 * 24);
    let labels = findings(&report, "TAC009");
    assert_eq!(labels.len(), 1, "{:?}", report.findings);
    assert_eq!(labels, ["Fx is 0.5 N in every sample"]);
    assert!(
        report
            .skipped
            .iter()
            .all(|skipped| !format!("{skipped:?}").contains("TAC004"))
    );
}
