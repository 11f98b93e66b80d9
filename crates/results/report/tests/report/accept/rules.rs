//! Tests of limits of version 2, which rules decide.

use serde_json::json;
use taceva_metrology::conformity::Word;
use taceva_report::{AcceptError, LimitCheck, LimitsFile, Study, accept, limits_template};

use crate::support;

/// Study with three mean absolute errors: of Fz with a standard uncertainty of 10 % from 97 clusters, of Fx without an interval, of Fy without
/// skill.
pub(super) fn study() -> Study {
    let clusters = "jackknife by point_id, G=97, logarithmic";
    let json = json!({
        "schema": "taceva.evaluation/1.0",
        "subject": {"sensor": "drawn", "serial": "7", "source": "simulated"},
        "metrics": {
            "mae": {
                "Fz": {"value": 0.082, "unit": "N", "n": 460, "ci95": [0.0671, 0.1002], "method": clusters},
                "Fx": {"value": 0.05, "unit": "N", "n": 4, "ci95": {"undefined": "too few clusters"}},
                "Fy": {"value": 0.05, "unit": "N", "n": 460, "ci95": [0.04, 0.0625], "method": clusters, "standing": "no skill"}
            },
            "r2": {"Fz": {"value": 0.9, "unit": "1", "n": 460, "ci95": [0.7996, 0.95], "method": clusters}}
        }
    });
    support::study(&json)
}

const GUARDED: &str = "[decision]\nrule = \"guarded\"";
const BY_PROBABILITY: &str = "[decision]\nrule = \"probability\"";

/// A limit on an error, in N.
fn on_error(channel: &str, limit: &str) -> String {
    format!("[[limit]]\nmetric = \"mae\"\nchannel = \"{channel}\"\nunit = \"N\"\n{limit}\n")
}

pub(super) fn limits(decision: &str, limits: &str) -> LimitsFile {
    let text = format!("limits_version = 2\nname = \"line 3\"\n{decision}\n{limits}");
    LimitsFile::read(&text).expect("limits")
}

/// Check of one limit on the error of Fz.
fn held(decision: &str, limit: &str) -> LimitCheck {
    held_on("Fz", decision, limit)
}

fn held_on(channel: &str, decision: &str, limit: &str) -> LimitCheck {
    let limits = limits(decision, &on_error(channel, limit));
    accept(&study(), &limits).expect("checks").remove(0)
}

fn p_of(check: &LimitCheck) -> f64 {
    let decision = check.decision.as_ref().expect("a decision");
    decision.conformance_probability.expect("an uncertainty")
}

#[test]
fn a_limit_just_above_the_value_passes_by_the_value_and_conditionally_with_a_guard() {
    let most = format!("most = {}", 0.082 * 1.001);
    let simple = held("", &most);
    assert_eq!((simple.verdict, simple.is_kept), (Word::Pass, true));
    let p = p_of(&simple);
    assert!((0.5..0.51).contains(&p), "{p}");
    let crossed = "met by the value only: its interval crosses the limit";
    assert_eq!(simple.reason.as_deref(), Some(crossed));
    let guarded = held(GUARDED, &most);
    assert_eq!(
        (guarded.verdict, guarded.is_kept),
        (Word::ConditionalPass, false)
    );
    assert!((p_of(&guarded) - p).abs() < 1e-15);
    let reason = guarded.reason.expect("a reason");
    assert!(
        reason.starts_with("within the limit, not within the acceptance limit ≤ 0.067"),
        "{reason}"
    );
    assert!(
        reason.ends_with("; probability of conformity 0.504"),
        "{reason}"
    );
}

#[test]
fn a_probability_of_nineteen_in_twenty_needs_room_of_eighteen_in_a_hundred() {
    let roomy = held(BY_PROBABILITY, "most = 0.0971");
    assert_eq!(roomy.verdict, Word::Pass, "{roomy:?}");
    assert_eq!(roomy.reason, None);
    let tight = held(BY_PROBABILITY, "most = 0.096");
    assert_eq!(tight.verdict, Word::ConditionalPass, "{tight:?}");
    let modest = held(BY_PROBABILITY, "most = 0.096\np_conformity = 0.9");
    assert_eq!(modest.verdict, Word::Pass, "{modest:?}");
}

#[test]
fn conditional_passes_count_if_the_caller_says_so_and_nothing_else_does() {
    for (most, word, is_kept) in [
        (0.11, Word::Pass, true),
        (0.09, Word::ConditionalPass, true),
        (0.075, Word::ConditionalFail, false),
        (0.06, Word::Fail, false),
    ] {
        let limits = limits(GUARDED, &on_error("Fz", &format!("most = {most}")));
        let strict = accept(&study(), &limits).expect("checks").remove(0);
        assert_eq!(strict.verdict, word, "{most}");
        assert_eq!(strict.is_kept, word == Word::Pass, "{most}");
        let counting = limits.counting_conditional_passes();
        let counting = accept(&study(), &counting).expect("checks").remove(0);
        assert_eq!(
            (counting.verdict, counting.is_kept),
            (word, is_kept),
            "{most}"
        );
    }
}

#[test]
fn a_share_of_variance_is_decided_by_its_distance_to_one() {
    let held = |least: f64| {
        let limit = format!(
            "[[limit]]\nmetric = \"r2\"\nchannel = \"Fz\"\nunit = \"1\"\nleast = {least}\n"
        );
        let limits = limits(GUARDED, &limit);
        accept(&study(), &limits).expect("checks").remove(0)
    };
    assert_eq!(held(0.799).verdict, Word::Pass);
    assert_eq!(held(0.801).verdict, Word::ConditionalPass);
    // 1 − 0.1 / 2 is the upper end.
    assert_eq!(held(0.949).verdict, Word::ConditionalFail);
    assert_eq!(held(0.951).verdict, Word::Fail);
    let p = p_of(&held(0.7996));
    assert!((0.975..0.976).contains(&p), "{p}");
}

#[test]
fn a_limit_may_have_a_rule_of_its_own() {
    let most = "most = 0.083";
    let own = |settings: &str| held(GUARDED, &format!("{most}\n{settings}")).verdict;
    assert_eq!(own(""), Word::ConditionalPass);
    assert_eq!(own("r = 0.0"), Word::Pass);
    assert_eq!(own("rule = \"simple\""), Word::Pass);
    assert_eq!(
        own("rule = \"probability\"\np_conformity = 0.51"),
        Word::Pass
    );
    let shared = |agreed: f64| {
        let settings = format!("rule = \"shared\"\nmost_uncertainty = {agreed}");
        let check = held(GUARDED, &format!("{most}\n{settings}"));
        (check.verdict, check.reason.expect("a reason"))
    };
    assert_eq!(shared(0.02).0, Word::Pass);
    let great = "U is 0.0164 N, expected at most 0.01 N by the rule".to_owned();
    assert_eq!(shared(0.01), (Word::Undecided, great));
    // An uncertainty is agreed in the unit of each limit.
    let all = "[decision]\nrule = \"shared\"";
    let agreed = held(all, &format!("{most}\nmost_uncertainty = 0.02"));
    assert_eq!(agreed.verdict, Word::Pass);
}

#[test]
fn a_score_without_an_interval_is_undecided() {
    for decision in [GUARDED, BY_PROBABILITY] {
        let check = held_on("Fx", decision, "most = 9.0");
        assert_eq!((check.verdict, check.is_kept), (Word::Undecided, false));
        let reason = "without an uncertainty: no interval: too few clusters";
        assert_eq!(check.reason.as_deref(), Some(reason));
    }
    let by_value = held_on("Fx", "", "most = 9.0");
    assert_eq!((by_value.verdict, by_value.is_kept), (Word::Pass, true));
}

#[test]
fn a_score_that_takes_no_part_in_verdicts_is_undecided_and_so_is_a_missing_one() {
    let barred = held_on("Fy", GUARDED, "most = 9.0");
    assert_eq!((barred.verdict, barred.is_kept), (Word::Undecided, false));
    let reason = barred.reason.expect("a reason");
    assert!(
        reason.contains("not better than predicting the mean"),
        "{reason}"
    );
    let missing = held_on("Fq", GUARDED, "most = 9.0");
    assert_eq!((missing.verdict, missing.is_kept), (Word::Undecided, false));
    assert_eq!(missing.reason.as_deref(), Some("this score is missing"));
    let reason = held_on("fx", GUARDED, "most = 9.0").reason;
    let expected = "this score is missing; did you mean channel `Fx`?";
    assert_eq!(reason.as_deref(), Some(expected));
}

#[test]
fn settings_outside_their_range_are_refused_by_place_and_expectation() {
    let refusal = |version: u32, decision: &str, limit: &str| {
        let limit = on_error("Fz", limit);
        let text = format!("limits_version = {version}\n{decision}\n{limit}");
        LimitsFile::read(&text).expect_err("refused").to_string()
    };
    let most = "most = 1.0";
    for (decision, expected) in [
        (
            "rule = \"guarded\"\nr = -0.5",
            "[decision]: r is -0.5, expected a factor from 0 on",
        ),
        (
            "rule = \"probability\"\np_conformity = 0.5",
            "[decision]: p_conformity is 0.5, expected a probability above 0.5 and below 1",
        ),
        (
            "rule = \"guarded\"\nr = 1.0\np_conformity = 0.95",
            "[decision]: `p_conformity` belongs to rule = \"probability\", but the rule is \"guarded\": remove the setting, or change the rule",
        ),
        (
            "rule = \"gaurded\"",
            "[decision]: rule = \"gaurded\": did you mean `guarded`?",
        ),
    ] {
        let found = refusal(2, &format!("[decision]\n{decision}"), most);
        assert_eq!(found, expected, "{decision}");
    }
    for (limit, expected) in [
        ("r = -1.0", "limit 1: r is -1, expected a factor from 0 on"),
        (
            "rule = \"shared\"",
            "limit 1: rule = \"shared\" needs `most_uncertainty`",
        ),
        (
            "whole_interval = true",
            "limit 1: `whole_interval` in limits_version 2: expected rule = \"guarded\" with r = 1",
        ),
        (
            "least = 1.0",
            "limit 1: the limits are 1 and 1, expected a lower limit below an upper limit",
        ),
    ] {
        let found = refusal(2, GUARDED, &format!("{most}\n{limit}"));
        assert_eq!(found, expected, "{limit}");
    }
    let early = "in limits_version 1: expected it with limits_version = 2";
    assert_eq!(refusal(1, GUARDED, most), format!("[decision] {early}"));
    let limit = format!("{most}\nrule = \"simple\"");
    assert_eq!(refusal(1, "", &limit), format!("limit 1: `rule` {early}"));
}

#[test]
fn a_value_outside_its_own_interval_is_refused_by_both_versions() {
    let mut study = study();
    let mut scores = study.scores.iter_mut();
    let score = scores.find(|score| score.channel == "Fz" && score.metric == "mae");
    score.expect("there").value = taceva_results::Value::Number(0.0535);
    for version in [1, 2] {
        let text = format!(
            "limits_version = {version}\n{}",
            on_error("Fz", "most = 0.0821")
        );
        let limits = LimitsFile::read(&text).expect("limits");
        let error = accept(&study, &limits).expect_err("outside");
        assert!(matches!(error, AcceptError::OutsideInterval { .. }));
        assert_eq!(
            error.to_string(),
            "mae Fz: the value 0.0535 N is outside its own interval 0.0671 … 0.100 N; compute the result again with `taceva evaluate` or `taceva score`"
        );
    }
    // A limit on another score is decided.
    let limits = limits("", &on_error("Fx", "most = 1.0"));
    assert!(accept(&study, &limits).is_ok());
}

#[test]
fn a_template_has_the_guarded_rule_and_the_simple_one_where_there_is_no_interval() {
    let study = study();
    let text = limits_template(&study);
    assert!(
        text.contains("\n[decision]\nrule = \"guarded\"\n"),
        "{text}"
    );
    let limits = LimitsFile::read(&text).expect("limits");
    let found = accept(&study, &limits).expect("checks");
    let mut found: Vec<_> = found
        .iter()
        .map(|check| {
            let rule = check.decision.as_ref().expect("a decision").rule;
            let name = format!("{} {}", check.limit.metric, check.limit.channel);
            (name, check.verdict, rule.to_string())
        })
        .collect();
    found.sort_by(|(one, ..), (other, ..)| one.cmp(other));
    let guarded = "guard band w = 1 U, U at a coverage of 0.95";
    let simple = "simple acceptance, w = 0";
    let expected = [("mae Fx", simple), ("mae Fz", guarded), ("r2 Fz", guarded)];
    let expected = expected.map(|(name, rule)| (name.to_owned(), Word::Pass, rule.to_owned()));
    assert_eq!(found, expected, "{text}");
}
