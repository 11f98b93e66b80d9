//! Tests of checks by value and by interval, and of checks with unknown values.

use super::*;
use crate::catalogue;
use crate::results::Study;

fn limits(lines: &str) -> LimitsFile {
    LimitsFile::read(&format!("limits_version = 1\n[[limit]]\n{lines}\n")).expect("limits")
}

/// Check of the first limit.
fn checked(study: &Study, limits: &LimitsFile) -> LimitCheck {
    accept(study, limits).expect("checks").remove(0)
}

#[test]
fn what_a_constant_reaches_is_judged_by_its_value_alone() {
    let study = crate::results::unsealed(
        r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "x"}, "metrics": {
            "tolerance": {"Px": {"value": 0.04, "unit": "1", "standing": "not above the constant",
                "of_constant": {"value": 0.05, "unit": "1"}}},
            "r2": {"Px": {"value": 0.1, "unit": "1", "ci95": [-0.25, 0.75]}}}}"#,
    );
    let study = study.expect("a result").remove(0);
    let of = |metric: &str| {
        let limit = format!("metric=\"{metric}\"\nchannel=\"Px\"\nunit=\"1\"\nleast=0.01");
        checked(&study, &limits(&limit))
    };
    let of_constant = of("tolerance.of_constant");
    assert!(of_constant.is_kept, "{:?}", of_constant.reason);
    assert!(!of("tolerance").is_kept);
}

#[test]
fn a_value_on_the_limit_keeps_to_it_and_one_beyond_does_not() {
    let study = catalogue::find("GelSight").expect("there").as_study();
    let kept = limits("metric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\"\nmost=0.0361");
    assert!(checked(&study, &kept).is_kept);
    let broken = limits("metric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\"\nmost=0.0360");
    let finding = checked(&study, &broken);
    assert_eq!(
        finding.reason.as_deref(),
        Some("value is 0.0361, above 0.036")
    );
}

#[test]
fn a_value_is_kept_alone_where_its_interval_reaches_across_the_limit() {
    let crossed = |lines: &str, ends| {
        let remark = reason::by_value_only(&limits(lines).limits[0], Some(ends));
        remark.is_some()
    };
    let most = "metric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 0.5\n";
    assert!(crossed(most, [0.3, 0.51]) && !crossed(most, [0.3, 0.5]));
    let least = "metric = \"r2\"\nchannel = \"Fz\"\nunit = \"1\"\nleast = 0.5\n";
    assert!(crossed(least, [0.49, 0.8]) && !crossed(least, [0.5, 0.8]));
}

#[test]
fn what_is_unknown_meets_no_limit() {
    let study = catalogue::find("GelSight").expect("there").as_study();
    for (lines, expected) in [
        (
            "metric=\"drift\"\nchannel=\"Fz\"\nunit=\"N/h\"\nmost=1",
            "this score is missing",
        ),
        (
            "metric=\"mae\"\nchannel=\"Fz\"\nunit=\"mm\"\nmost=1",
            "the score is in N, the limit in mm",
        ),
        (
            "metric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\"\nmost=1\nwhole_interval=true",
            "there is no interval to compare with the limit",
        ),
    ] {
        let finding = checked(&study, &limits(lines));
        assert_eq!(
            (finding.is_kept, finding.reason.as_deref()),
            (false, Some(expected))
        );
    }
    assert!(LimitsFile::read("limits_version = 1").is_err());
    assert!(
        LimitsFile::read(
            "limits_version = 1\n[[limit]]\nmetric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\""
        )
        .is_err()
    );
}
