//! Tests that a value on the limit meets it and the next binary64 number beyond does not: by value and by interval, above and below.

mod rules;
mod sheets;
mod units;

use crate::compare;
use crate::compare::trainings::over_seeds;
use crate::support;
use serde_json::{Value, json};
use taceva_report::{LimitCheck, LimitsFile, Study, accept, limits_template};

/// Score of every test, and the ends of its interval: dyadic fractions, so that a limit can equal them.
const VALUE: f64 = 0.5;
const LOW: f64 = 0.375;
const HIGH: f64 = 0.75;

/// Study with `mae` of three channels: Fz with an interval and a variant, Fx without an interval, Fy without a value.
fn study() -> Study {
    let json = json!({
        "schema": "taceva.evaluation/1.0",
        "subject": {"sensor": "drawn", "source": "simulated"},
        "metrics": {
            "mae": {
                "Fz": {
                    "value": VALUE, "unit": "N", "n": 80, "ci95": [LOW, HIGH], "method": "drawn",
                    "angle": {"value": 2.0 * VALUE, "unit": "deg", "ci95": [2.0 * LOW, 2.0 * HIGH], "method": "drawn"}
                },
                "Fx": {"value": VALUE, "unit": "N", "n": 4, "ci95": {"undefined": "too few clusters"}},
                "Fy": {"undefined": "no samples", "n": 0}
            },
            "sensitivity": {"Fz": {
                "value": VALUE, "unit": "1", "n": 8,
                "curve": {"x": [0.0, 1.0], "x_unit": "mm", "values": [0.25, 0.5], "counts": [4, 4], "unit": "1"}
            }}
        }
    });
    support::study(&json)
}

/// Check of one limit of a metric and a channel.
fn held(metric: &str, channel: &str, unit: &str, limit: &str) -> LimitCheck {
    let text = format!(
        "limits_version = 1\n[[limit]]\nmetric = {metric:?}\nchannel = {channel:?}\nunit = {unit:?}\n{limit}\n"
    );
    let limits = LimitsFile::read(&text).expect("limits");
    accept(&study(), &limits).expect("checks").remove(0)
}

/// Remark on a value within the limit whose interval crosses it.
const BY_VALUE: &str = "met by the value only: its interval crosses the limit";

fn is_kept(limit: &str) -> bool {
    let finding = held("mae", "Fz", "N", limit);
    let by_value = finding.reason.as_deref() == Some(BY_VALUE);
    let has_no_objection = finding.reason.is_none() || by_value;
    assert_eq!(finding.is_kept, has_no_objection, "{finding:?}");
    assert_eq!(
        (finding.value, finding.ends),
        (Some(VALUE), Some([LOW, HIGH]))
    );
    assert_eq!(finding.n, 80);
    finding.is_kept
}

/// A number that TOML reads back bit by bit.
fn digits(number: f64) -> Value {
    json!(number)
}

#[test]
fn a_value_keeps_to_the_limit_that_it_lies_on_and_to_none_that_it_lies_beyond() {
    for (end, on, beyond) in [
        ("most", VALUE, VALUE.next_down()),
        ("least", VALUE, VALUE.next_up()),
    ] {
        assert!(is_kept(&format!("{end} = {}", digits(on))), "{end}");
        assert!(!is_kept(&format!("{end} = {}", digits(beyond))), "{end}");
    }
}

#[test]
fn an_interval_keeps_to_the_limit_that_its_end_lies_on_and_to_none_that_it_reaches_beyond() {
    for (end, on, beyond) in [
        ("most", HIGH, HIGH.next_down()),
        ("least", LOW, LOW.next_up()),
    ] {
        let whole = |limit: f64| format!("{end} = {}\nwhole_interval = true", digits(limit));
        assert!(is_kept(&whole(on)), "{end}");
        assert!(!is_kept(&whole(beyond)), "{end}");
        // The value alone would meet the limit.
        assert!(is_kept(&format!("{end} = {}", digits(beyond))), "{end}");
    }
}

#[test]
fn both_limits_hold_at_once_and_the_one_that_is_broken_is_named() {
    for (limit, reason) in [
        ("least = 0.5\nmost = 0.5", Some(BY_VALUE)),
        (
            "least = 0.25\nmost = 0.4375",
            Some("value is 0.5, above 0.4375"),
        ),
        (
            "least = 0.5625\nmost = 1.0",
            Some("value is 0.5, below 0.5625"),
        ),
        ("least = 0.375\nmost = 0.75\nwhole_interval = true", None),
        (
            "least = 0.5\nmost = 0.75\nwhole_interval = true",
            Some("interval reaches 0.375, below 0.5"),
        ),
        (
            "least = 0.375\nmost = 0.5\nwhole_interval = true",
            Some("interval reaches 0.75, above 0.5"),
        ),
    ] {
        let finding = held("mae", "Fz", "N", limit);
        assert_eq!(finding.reason.as_deref(), reason, "{limit}");
        let is_kept = reason.is_none_or(|reason| reason == BY_VALUE);
        assert_eq!(finding.is_kept, is_kept, "{limit}");
    }
}

#[test]
fn a_variant_is_held_by_its_own_value_unit_and_interval() {
    for (limit, is_kept) in [
        ("most = 1.0", true),
        ("most = 0.9375", false),
        ("most = 1.5\nwhole_interval = true", true),
        ("most = 1.4375\nwhole_interval = true", false),
    ] {
        let finding = held("mae.angle", "Fz", "deg", limit);
        assert_eq!(finding.is_kept, is_kept, "{limit}");
    }
    let finding = held("mae.angle", "Fz", "N", "most = 2.0");
    assert_eq!(
        finding.reason.as_deref(),
        Some("the score is in deg, the limit in N")
    );
    let finding = held("mae.other", "Fz", "N", "most = 2.0");
    assert_eq!(finding.reason.as_deref(), Some("this variant is missing"));
}

#[test]
fn what_has_no_number_or_no_interval_keeps_to_nothing() {
    let reason = |metric: &str, channel: &str, unit: &str, limit: &str| {
        let finding = held(metric, channel, unit, limit);
        assert!(!finding.is_kept, "{finding:?}");
        finding.reason.expect("what is not kept has a reason")
    };
    let whole = "most = 9.0\nwhole_interval = true";
    assert_eq!(
        reason("mae", "Fx", "N", whole),
        "there is no interval to compare with the limit"
    );
    assert!(held("mae", "Fx", "N", "most = 9.0").is_kept);
    assert_eq!(
        reason("mae", "Fy", "N", "most = 9.0"),
        "undefined: no samples"
    );
    assert_eq!(
        reason("sensitivity.curve", "Fz", "1", "most = 9.0"),
        "not a single number"
    );
    assert_eq!(
        reason("mae", "Pz", "mm", "most = 9.0"),
        "this score is missing"
    );
}

#[test]
fn limits_that_say_nothing_or_no_number_are_refused_by_their_place() {
    let good = "[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 1.0\n";
    let refusal = |text: &str| {
        let error = LimitsFile::read(text).expect_err("refused");
        error.to_string()
    };
    for (limit, expected) in [
        (
            "most = nan",
            "limit 2: expected `most`, `least` or both, as numbers",
        ),
        (
            "least = inf",
            "limit 2: expected `most`, `least` or both, as numbers",
        ),
        (
            "most = 1.0\nleast = -inf",
            "limit 2: expected `most`, `least` or both, as numbers",
        ),
        ("", "limit 2: expected `most`, `least` or both, as numbers"),
    ] {
        let bad = good.replace("most = 1.0", limit);
        assert_eq!(
            refusal(&format!("limits_version = 1\n{good}{bad}")),
            expected
        );
    }
    let stranger = good.replace("\"N\"", "\"stone\"");
    let said = refusal(&format!("limits_version = 1\n{stranger}"));
    assert!(said.starts_with("limit 1: unit `stone`"), "{said}");
    let said = refusal(&format!("limits_version = 3\n{good}"));
    assert_eq!(said, "limits_version 3: expected 1 or 2");
    assert!(refusal("limits_version = 1\n").contains("no [[limit]]"));
}

#[test]
fn limits_that_name_no_version_are_of_the_first() {
    let limit = "[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 1.0\n";
    let unversioned = LimitsFile::read(limit).expect("limits");
    let first = LimitsFile::read(&format!("limits_version = 1\n{limit}")).expect("limits");
    assert_eq!(unversioned, first);
}

#[test]
fn a_value_without_an_interval_is_kept_by_itself_and_that_is_said() {
    let finding = held("mae", "Fx", "N", "most = 0.75");
    assert!(finding.is_kept);
    let reason = "met by the value only: there is no interval";
    assert_eq!(finding.reason.as_deref(), Some(reason));
    let finding = held("mae", "Fx", "N", "most = 0.75\nwhole_interval = true");
    assert!(!finding.is_kept);
}

#[test]
fn a_limit_is_judged_by_the_interval_that_contains_the_variance_between_seeds() {
    let score = compare::score(0.5, 0.01, "N");
    let mut study = compare::study("drawn", &[("mae", "Fz", score)], &["Fz"]);
    let limits = "[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 0.5625\n";
    let checked = |study: &Study, more: &str| {
        let limits = LimitsFile::read(&format!("{limits}{more}")).expect("limits");
        accept(study, &limits).expect("checks").remove(0)
    };
    let whole = "whole_interval = true\n";
    let one = checked(&study, whole);
    assert_eq!((one.ends, one.trainings), (Some([0.48, 0.52]), 0));
    assert!(one.is_kept, "{one:?}");
    // Trainings that agree, and those of another metric, change no bit.
    for other in [
        over_seeds("mae", [0.5; 3]),
        over_seeds("rmse", [0.5, 0.54, 0.46]),
    ] {
        study.over_seeds = Some(other);
        assert_eq!(checked(&study, whole), one);
    }
    study.over_seeds = Some(over_seeds("mae", [0.5, 0.54, 0.46]));
    let several = checked(&study, whole);
    assert_eq!((several.value, several.trainings), (one.value, 3));
    let [low, high] = several.ends.expect("an interval");
    // √(0.0096² + 0.04²) times Student's t of 2.23 degrees of freedom.
    assert!((0.15..0.18).contains(&(high - 0.5)), "{high}");
    assert!((0.5 - low - (high - 0.5)).abs() < 1e-12, "{low} {high}");
    assert!(!several.is_kept, "{several:?}");
    let reason = several.reason.expect("a reason");
    assert!(reason.starts_with("interval reaches 0.6"), "{reason}");
    let by_value = checked(&study, "");
    assert!(by_value.is_kept);
    assert_eq!(by_value.reason.as_deref(), Some(BY_VALUE));
    // A template allows the whole interval of its own result.
    let limits = LimitsFile::read(&limits_template(&study)).expect("limits");
    let findings = accept(&study, &limits).expect("checks");
    let mut findings = findings.iter();
    let own = findings.find(|finding| finding.limit.metric == "mae");
    let own = own.expect("a limit");
    let rule = own
        .decision
        .as_ref()
        .map(|decision| decision.rule.to_string());
    let guarded = "guard band w = 1 U, U at a coverage of 0.95";
    assert_eq!((own.is_kept, rule.as_deref()), (true, Some(guarded)));
}
