//! Conformity: probabilities, decisions in words, and global risks of JCGM 106.

mod scales;

use taceva_metrics::distributions::normal;
use taceva_metrology::conformity::{
    ConformityError, Decision, DecisionRule, Limits, Measurement, Process, RuleSettings, Word,
    decide,
};

use crate::support::{case, close, number};

fn at_most(most: f64) -> Limits {
    Limits::at_most(most).expect("finite")
}

fn both(least: f64, most: f64) -> Limits {
    Limits::between(least, most).expect("in order")
}

fn normal_value(value: f64, u: f64) -> Measurement {
    Measurement::new(value, u, f64::INFINITY).expect("valid")
}

const GUARDED: DecisionRule = DecisionRule::Guarded {
    r: 1.0,
    coverage: 0.95,
};

fn decided(measured: &Measurement, limits: &Limits, rule: &DecisionRule) -> Decision {
    decide(measured, limits, rule).expect("a decision")
}

#[test]
fn factors_of_table_one_of_jcgm_106_are_normal_quantiles() {
    let case = case("JCGM 106");
    for p in ["0.8", "0.9", "0.95", "0.99", "0.999"] {
        let share: f64 = p.parse().expect("a number");
        close(
            normal::quantile(share),
            number(&case["z"], &format!("/{p}")),
            2e-15,
            p,
        );
    }
}

#[test]
fn probabilities_of_conformity_are_those_of_the_reference() {
    let case = case("JCGM 106");
    let one = normal_value(0.045, 0.004).conformance_probability(&at_most(0.05));
    let two = normal_value(0.012, 0.006).conformance_probability(&both(-0.02, 0.02));
    let student = Measurement::new(0.045, 0.004, 9.0).expect("valid");
    let student = student.conformance_probability(&at_most(0.05));
    for (found, key) in [
        (one, "/specific/one-sided hi=0.050 y=0.045 u=0.004"),
        (two, "/specific/two-sided lo=-0.02 hi=0.02 y=0.012 u=0.006"),
        (student, "/specific_student_nu9"),
    ] {
        close(found.expect("p"), number(&case, key), 1e-14, key);
    }
}

#[test]
fn a_value_at_its_limit_conforms_with_one_half() {
    let p = normal_value(0.05, 0.004).conformance_probability(&at_most(0.05));
    close(p.expect("p"), 0.5, 1e-15, "p");
    let mirrored = Limits::at_least(-0.045).expect("finite");
    let left = normal_value(-0.05, 0.004).conformance_probability(&mirrored);
    let right = normal_value(0.05, 0.004).conformance_probability(&at_most(0.045));
    assert_eq!(left, right);
}

#[test]
fn global_risks_are_those_of_the_reference() {
    let case = case("JCGM 106");
    let deviation = 1.0 / normal::quantile(0.975);
    let process = Process::new(0.0, deviation, 0.125).expect("valid");
    let limits = both(-1.0, 1.0);
    let risk = process.risk(&limits, &limits);
    for (found, key) in [(risk.consumer, "PFA"), (risk.producer, "PFR")] {
        close(
            found,
            number(&case, &format!("/global_own/{key}")),
            1e-12,
            key,
        );
        // Suncal's quadrature keeps twelve digits.
        close(found, number(&case, &format!("/suncal/{key}")), 2e-12, key);
    }
    let guard = process
        .guard(&limits, 0.005)
        .expect("a target")
        .expect("a guard");
    close(
        guard,
        1.0 - number(&case, "/global_own/acceptance_limit_for_PFA_.5%"),
        1e-9,
        "guard",
    );
    let inner = both(guard - 1.0, 1.0 - guard);
    close(
        process.risk(&limits, &inner).consumer,
        0.005,
        1e-12,
        "consumer",
    );
    assert!(process.risk(&limits, &inner).producer > risk.producer);
}

#[test]
fn risks_of_one_limit_are_those_of_a_bivariate_normal() {
    // Mean at the limit: P(false acceptance) = arctan(u / deviation) / 2π, by symmetry of the plane.
    for u in [1e-3, 0.1, 1.0, 30.0] {
        let process = Process::new(2.0, 1.0, u).expect("valid");
        let risk = process.risk(&at_most(2.0), &at_most(2.0));
        let expected = u.atan() / std::f64::consts::TAU;
        close(risk.consumer, expected, 1e-12, "consumer");
        close(risk.producer, expected, 1e-12, "producer");
    }
}

#[test]
fn a_target_above_the_risk_needs_no_guard() {
    let process = Process::new(0.0, 0.5, 0.1).expect("valid");
    assert_eq!(process.guard(&at_most(1.0), 0.5), Ok(Some(0.0)));
    let refused = process.guard(&at_most(1.0), 0.0);
    assert!(
        matches!(refused, Err(ConformityError::Number { .. })),
        "{refused:?}"
    );
}

#[test]
fn a_guard_band_has_the_four_words() {
    // U = 1.96 × 0.1 at a limit of 1.
    for (value, expected) in [
        (0.80, Word::Pass),
        (0.81, Word::ConditionalPass),
        (1.0, Word::ConditionalPass),
        (1.19, Word::ConditionalFail),
        (1.20, Word::Fail),
    ] {
        let decision = decided(&normal_value(value, 0.1), &at_most(1.0), &GUARDED);
        assert_eq!(decision.word, expected, "{value}");
        let acceptance = decision.acceptance.and_then(|limits| limits.most());
        close(
            acceptance.expect("a limit"),
            0.804_003_601_545_994_6,
            1e-14,
            "A − w",
        );
    }
    let lower = Limits::at_least(1.0).expect("finite");
    assert_eq!(
        decided(&normal_value(1.2, 0.1), &lower, &GUARDED).word,
        Word::Pass
    );
    assert_eq!(
        decided(&normal_value(1.19, 0.1), &lower, &GUARDED).word,
        Word::ConditionalPass
    );
    assert_eq!(
        decided(&normal_value(0.8, 0.1), &lower, &GUARDED).word,
        Word::Fail
    );
}

#[test]
fn the_probability_rule_has_the_four_words() {
    let rule = DecisionRule::Probability { p_conformity: 0.95 };
    // 1.645 × 0.1 from the limit of 1.
    for (value, expected) in [
        (0.835, Word::Pass),
        (0.836, Word::ConditionalPass),
        (1.164, Word::ConditionalFail),
        (1.165, Word::Fail),
    ] {
        let decision = decided(&normal_value(value, 0.1), &at_most(1.0), &rule);
        assert_eq!(decision.word, expected, "{value}");
    }
}

#[test]
fn acceptance_by_probability_lies_where_the_probability_is_reached() {
    let rule = DecisionRule::Probability { p_conformity: 0.95 };
    for limits in [
        at_most(1.0),
        both(0.5, 1.0),
        Limits::at_least(0.5).expect("finite"),
    ] {
        let measured = Measurement::new(0.7, 0.1, 12.0).expect("valid");
        let inner = decided(&measured, &limits, &rule).acceptance.expect("room");
        for end in [inner.least(), inner.most()].into_iter().flatten() {
            let at = Measurement::new(end, 0.1, 12.0).expect("valid");
            let p = at.conformance_probability(&limits).expect("p");
            close(p, 0.95, 1e-13, "p");
        }
    }
    // Two limits nearer than that leave no room.
    let narrow = decided(&normal_value(0.7, 0.1), &both(0.6, 0.8), &rule);
    assert_eq!(
        (narrow.acceptance, narrow.word),
        (None, Word::ConditionalPass)
    );
}

#[test]
fn the_simple_rule_looks_at_the_value_alone() {
    let unknown = Measurement::without_uncertainty(0.05).expect("finite");
    let decision = decided(&unknown, &at_most(0.05), &DecisionRule::Simple);
    assert_eq!(
        (decision.word, decision.conformance_probability),
        (Word::Pass, None)
    );
    let above = normal_value(0.050_001, 0.1);
    assert_eq!(
        decided(&above, &at_most(0.05), &DecisionRule::Simple).word,
        Word::Fail
    );
}

#[test]
fn shared_risk_needs_an_uncertainty_no_greater_than_agreed() {
    let rule = DecisionRule::Shared {
        most_uncertainty: 0.01,
        coverage: 0.95,
    };
    let limits = at_most(1.0);
    assert_eq!(
        decided(&normal_value(0.999, 0.005), &limits, &rule).word,
        Word::Pass
    );
    assert_eq!(
        decided(&normal_value(1.001, 0.005), &limits, &rule).word,
        Word::Fail
    );
    assert_eq!(
        decided(&normal_value(0.5, 0.006), &limits, &rule).word,
        Word::Undecided
    );
}

#[test]
fn a_score_without_interval_is_undecided() {
    let unknown = Measurement::without_uncertainty(0.01).expect("finite");
    for rule in [GUARDED, DecisionRule::Probability { p_conformity: 0.9 }] {
        let decision = decided(&unknown, &at_most(0.05), &rule);
        assert_eq!(
            (decision.word, decision.acceptance),
            (Word::Undecided, None)
        );
    }
}

#[test]
fn an_error_is_decided_on_a_logarithmic_scale() {
    let measured = Measurement::new(0.08, 0.008, f64::INFINITY).expect("valid");
    let measured = measured.logarithmic().expect("above 0");
    let p = measured.conformance_probability(&at_most(0.1)).expect("p");
    close(p, normal::below(1.25_f64.ln() / 0.1), 1e-14, "p");
    let decision = decided(&measured, &at_most(0.1), &GUARDED);
    let expected = 0.1 * (-0.195_996_398_454_005_4_f64).exp();
    let most = decision.acceptance.and_then(|limits| limits.most());
    close(most.expect("a limit"), expected, 1e-14, "A − w");
    let refused = Measurement::without_uncertainty(0.0).and_then(Measurement::logarithmic);
    assert!(refused.is_err());
}

#[test]
fn without_uncertainty_of_measurement_the_probability_is_zero_or_one() {
    let exact = normal_value(0.05, 0.0);
    assert_eq!(exact.conformance_probability(&at_most(0.05)), Some(1.0));
    assert_eq!(exact.conformance_probability(&at_most(0.049)), Some(0.0));
    assert_eq!(decided(&exact, &at_most(0.05), &GUARDED).word, Word::Pass);
}

/// Error message for settings written as TOML.
fn refusal(text: &str) -> String {
    let settings: RuleSettings = toml::from_str(text).expect("settings");
    settings.decision_rule().expect_err("refused").to_string()
}

#[test]
fn a_factor_below_zero_is_refused() {
    assert_eq!(
        refusal("rule = \"guarded\"\nr = -0.5"),
        "r is -0.5, expected a factor from 0 on"
    );
    let rule = DecisionRule::Guarded {
        r: -1.0,
        coverage: 0.95,
    };
    assert!(decide(&normal_value(1.0, 0.1), &at_most(1.0), &rule).is_err());
}

#[test]
fn a_probability_up_to_one_half_is_refused() {
    for p in ["0.5", "1.0", "nan"] {
        let text = refusal(&format!("rule = \"probability\"\np_conformity = {p}"));
        assert!(
            text.ends_with("expected a probability above 0.5 and below 1"),
            "{text}"
        );
    }
}

#[test]
fn settings_of_two_rules_are_refused() {
    let text = refusal("rule = \"guarded\"\nr = 1.0\np_conformity = 0.95");
    assert!(
        text.starts_with(
            "`p_conformity` belongs to rule = \"probability\", but the rule is \"guarded\""
        ),
        "{text}"
    );
    let text = refusal("r = 1.0");
    assert!(
        text.starts_with("`r` belongs to rule = \"guarded\", but the rule is \"simple\""),
        "{text}"
    );
    assert_eq!(
        refusal("rule = \"shared\""),
        "rule = \"shared\" needs `most_uncertainty`"
    );
    assert_eq!(
        refusal("rule = \"gaurded\""),
        "rule = \"gaurded\": did you mean `guarded`?"
    );
    assert!(refusal("rule = \"other\"").contains("expected one of `simple`, `guarded`"));
    assert!(refusal("rule = \"guarded\"\ncoverage = 1.0").starts_with("coverage is 1"));
}

#[test]
fn numbers_outside_their_range_are_refused() {
    assert!(Measurement::new(f64::NAN, 0.1, 9.0).is_err());
    assert!(Measurement::new(1.0, -0.1, 9.0).is_err());
    assert!(Measurement::new(1.0, f64::INFINITY, 9.0).is_err());
    assert!(Measurement::new(1.0, 0.1, 0.0).is_err());
    assert!(Limits::at_most(f64::NAN).is_err() && Limits::between(1.0, 1.0).is_err());
    assert!(Process::new(0.0, 0.0, 0.1).is_err());
}

#[test]
fn a_decision_is_written_and_read() {
    let decision = decided(&normal_value(0.81, 0.1), &at_most(1.0), &GUARDED);
    let text = serde_json::to_string(&decision).expect("finite");
    assert!(text.contains(r#""word":"conditional pass""#), "{text}");
    assert_eq!(
        serde_json::from_str::<Decision>(&text).expect("read"),
        decision
    );
}
