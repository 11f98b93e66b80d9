//! Tests of findings of `check` about taxels.

use std::num::NonZeroUsize;

use taceva_check::{CheckReport, CheckRequest, check};
use taceva_core::{Field, SilentProgress, SkipReason};
use taceva_dataset::Dataset;

use crate::taxel_drawing::{REST, record, record_changed};

fn checked(dataset: &Dataset, only: &[&str]) -> CheckReport {
    let request = CheckRequest {
        only: only.iter().map(|&code| code.to_owned()).collect(),
        split: None,
        seed: 0,
        jobs: NonZeroUsize::MIN,
    };
    check(dataset, &request, &SilentProgress).expect("checked")
}

/// Codes and messages of the findings in a generated recording whose signals are changed by `change`.
fn found(change: impl Fn(u32, Vec<f32>) -> Vec<f32>) -> Vec<(&'static str, String)> {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record_changed(&folder.path().join("data"), 400, change);
    let findings = checked(&dataset, &[]).findings.into_iter();
    let of_taxels =
        findings.filter(|finding| ["TAC016", "TAC017", "TAC018", "TAC039"].contains(&finding.code));
    of_taxels
        .map(|finding| (finding.code, finding.message))
        .collect()
}

#[test]
fn sound_taxels_are_sound_and_what_looks_at_frames_is_skipped_by_name() {
    assert_eq!(found(|_, values| values), []);
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), 100);
    let report = checked(&dataset, &[]);
    assert!(report.looked_for.contains(&"TAC017") && !report.looked_for.contains(&"TAC004"));
    let skipped = report
        .skipped
        .iter()
        .find(|skipped| skipped.what == "check:TAC004");
    assert_eq!(
        skipped.expect("said").reason,
        SkipReason::FieldAbsent(Field::Frame)
    );
    assert_eq!(report.frames_decoded, 0);
}

#[test]
fn a_taxel_that_never_changes_is_named() {
    let found = found(|_, mut values| {
        values[4] = 12.5;
        values
    });
    let message = "1 of 15 signals are the same in every sample: taxel_1_0_y is 12.5 uT";
    assert_eq!(found, [("TAC016", message.to_owned())]);
}

#[test]
fn a_taxel_at_the_end_of_its_converter_is_named_and_one_that_is_silent_at_rest_is_not() {
    let clipped = found(|_, mut values| {
        values[14] = values[14].min(400.0);
        values
    });
    let [(code, message)] = &clipped[..] else {
        panic!("{clipped:?}");
    };
    assert_eq!(*code, "TAC017");
    assert!(
        message.starts_with("1 of 15 signals are clipped at a limit: taxel_4_0_z is 400 uT in "),
        "{message}"
    );
    // Below 320 µT, which few presses stay under, the taxel shows nothing.
    let silent = found(|_, values| values.into_iter().map(|value| value.max(320.0)).collect());
    assert_eq!(silent, []);
}

#[test]
fn a_number_far_from_all_others_is_called_a_code_for_nothing_measured() {
    for code in [-1.0, 65_535.0] {
        let coded = found(|row, mut values| {
            if row >= REST && row % 7 == 0 {
                values[4] = code;
            }
            values
        });
        let [(code_of_check, message)] = &coded[..] else {
            panic!("{coded:?}");
        };
        assert_eq!(*code_of_check, "TAC017");
        let start = format!(
            "1 of 15 signals have a number that may mean \"nothing measured\": taxel_1_0_y is {code} uT in "
        );
        assert!(message.starts_with(&start), "{message}");
        assert!(
            message.contains("samples, and the nearest other value is "),
            "{message}"
        );
    }
}

#[test]
fn rows_without_contact_that_are_pressed_are_named() {
    // The values at rest are those of a deep press, so deeper samples are nearer to them.
    let pressed = found(|row, values| match row < REST {
        true => values.into_iter().map(|value| value + 700.0).collect(),
        false => values,
    });
    let [(code, message)] = &pressed[..] else {
        panic!("{pressed:?}");
    };
    assert_eq!(*code, "TAC018");
    assert!(
        message.contains("samples of greater Fz are more similar to the mean of `rest`"),
        "{message}"
    );
}

#[test]
fn two_taxels_that_are_equal_in_every_row_are_named_and_two_that_differ_once_are_not() {
    let equal = found(|_, mut values| {
        values[7] = values[4];
        values
    });
    let message = "2 taxels are equal to another one in all 400 rows, such as `taxel_1_0_y` and `taxel_2_0_y`";
    assert_eq!(equal, [("TAC039", message.to_owned())]);
    let once = found(|row, mut values| {
        values[7] = values[4] + if row == 9 { 0.5 } else { 0.0 };
        values
    });
    assert_eq!(once, []);
}
