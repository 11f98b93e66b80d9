//! Tests of similar samples in the training and the test part, and of the clusters of a test part without contact points.

use taceva_check::{CheckReport, Severity};

use super::{Recording, SAMPLES, readings};

/// Recording without contact points, whose labels are a function of the row number.
fn labelled(label: impl Fn(u32) -> f64) -> Recording {
    let mut recording = Recording::sound();
    for (number, sample) in (0..SAMPLES).zip(&mut recording.samples) {
        sample.point_id = None;
        readings(sample, |_, _| Some(label(number)));
    }
    recording
}

/// Force of a press that rises and falls.
fn pressed(number: u32) -> f64 {
    1.0 + (f64::from(number) / 9.0).sin()
}

/// Label that does not resemble the previous label.
fn scattered(number: u32) -> f64 {
    0.1 + f64::from(number.wrapping_mul(2_654_435_761) >> 16) / 65_536.0
}

fn of<'a>(report: &'a CheckReport, code: &str) -> Vec<(Severity, &'a str)> {
    let findings = report.findings.iter();
    let findings = findings.filter(|finding| finding.code == code);
    findings
        .map(|finding| (finding.severity, finding.message.as_str()))
        .collect()
}

#[test]
fn neighbours_in_time_on_both_sides_of_a_division_leak() {
    let report = labelled(pressed).check("random");
    let found = of(&report, "TAC007");
    assert!(
        matches!(&found[..], [(Severity::Warning, said)] if said.contains("a neighbour in the training part")),
        "{found:?}"
    );
}

#[test]
fn neighbours_in_the_order_of_a_table_without_times_leak() {
    let mut recording = labelled(pressed);
    recording
        .samples
        .iter_mut()
        .for_each(|sample| sample.stamp = None);
    let report = recording.check("random");
    let found = of(&report, "TAC007");
    assert!(
        matches!(&found[..], [(Severity::Warning, said)] if said.starts_with("neighbours in the table")),
        "{found:?}"
    );
}

#[test]
fn neighbours_that_stay_together_in_blocks_are_noted_and_leak_nothing() {
    for split in ["", "by-block"] {
        let report = labelled(pressed).check(split);
        let found = of(&report, "TAC007");
        assert!(
            matches!(&found[..], [(Severity::Note, said)] if said.contains("blocks of time stay together")),
            "{split}: {found:?}"
        );
    }
}

#[test]
fn samples_unlike_their_neighbours_are_divided_at_random_and_are_clusters_themselves() {
    for split in ["", "random"] {
        let report = labelled(scattered).check(split);
        assert_eq!(of(&report, "TAC007"), [], "{split}");
        assert_eq!(of(&report, "TAC010"), [], "{split}");
    }
}

#[test]
fn a_test_part_of_few_blocks_is_counted_in_groups() {
    let report = labelled(pressed).check("by-block");
    let found = of(&report, "TAC010");
    assert!(
        matches!(&found[..], [(Severity::Warning, said)] if said.ends_with("1 group; intervals need 5")),
        "{found:?}"
    );
}
