//! Measured values given by intervals, on the scale on which each interval is symmetric.

use taceva_metrics::Scale;
use taceva_metrology::conformity::{
    ConformityError, DecisionRule, Limits, Measurement, Population, Process, Word,
};

use super::{GUARDED, at_most, decided};
use crate::support::close;

/// Intervals about a value, each with its scale: errors, R², a normalised error of at most 2, a share, and a bias.
const INTERVALS: [(f64, [f64; 2], Scale); 5] = [
    (0.08, [0.064, 0.1], Scale::Logarithm),
    // Distances to 1 of 0.2, 0.1 and 0.05.
    (0.9, [0.8, 0.95], Scale::Logarithm),
    // Odds of 1/4, 1 and 4 within a width of 2.
    (1.0, [0.4, 1.6], Scale::Logit),
    // Odds of 1, 4 and 16.
    (0.8, [0.5, 16.0 / 17.0], Scale::Wilson),
    (-0.1, [-0.3, 0.1], Scale::Own),
];

fn measured(value: f64, ends: [f64; 2], scale: Scale) -> Measurement {
    Measurement::of_interval(value, ends, 9.0, scale).expect("an interval")
}

#[test]
fn a_limit_at_the_end_of_an_interval_is_met_with_the_probability_of_that_end() {
    for (value, ends, scale) in INTERVALS {
        let measured = measured(value, ends, scale);
        let [low, high] = ends;
        let above = measured.conformance_probability(&at_most(high));
        close(above.expect("p"), 0.975, 1e-12, "the upper end");
        let least = Limits::at_least(low).expect("finite");
        let below = measured.conformance_probability(&least);
        close(below.expect("p"), 0.975, 1e-12, "the lower end");
        let within = Limits::between(low, high).expect("in order");
        let both = measured.conformance_probability(&within);
        close(both.expect("p"), 0.95, 1e-12, "both ends");
    }
}

#[test]
fn a_guard_of_the_whole_uncertainty_leads_from_the_end_of_an_interval_to_its_value() {
    for (value, ends, scale) in INTERVALS {
        let decision = decided(&measured(value, ends, scale), &at_most(ends[1]), &GUARDED);
        let inner = decision.acceptance.and_then(|limits| limits.most());
        close(inner.expect("a limit"), value, 1e-12, "A − w");
    }
}

#[test]
fn a_guard_divides_or_multiplies_the_quantity_of_its_scale() {
    let expected = [
        (Some("the limit"), 0.8),
        (Some("1 − limit"), 2.0),
        (Some("limit / (2 − limit)"), 0.25),
        (Some("limit / (1 − limit)"), 0.25),
        (None, -1.0),
    ];
    for ((value, ends, scale), (quantity, quotient)) in INTERVALS.into_iter().zip(expected) {
        let measured = measured(value, ends, scale);
        assert_eq!(measured.guarded_quantity(), quantity, "{scale:?}");
        let found = measured.guard_quotient(ends[1], value);
        close(found, quotient, 1e-12, "from the upper end to the value");
    }
}

#[test]
fn a_guard_of_nothing_accepts_a_value_at_its_limit() {
    let rule = DecisionRule::Guarded {
        r: 0.0,
        coverage: 0.95,
    };
    // 1 − (1 − 0.1) is less than 0.1 in binary64.
    let share = measured(0.1, [-0.08, 0.25], Scale::Logarithm);
    let decision = decided(&share, &at_most(0.1), &rule);
    let inner = decision.acceptance.and_then(|limits| limits.most());
    assert_eq!((decision.word, inner), (Word::Pass, Some(0.1)));
}

#[test]
fn an_expanded_uncertainty_is_its_factor_times_the_standard_uncertainty() {
    for (value, ends, scale) in INTERVALS {
        let decision = decided(&measured(value, ends, scale), &at_most(2.0), &GUARDED);
        let k = decision.coverage_factor.expect("k");
        close(
            k,
            2.262_157_162_798_205,
            1e-12,
            "t of nine degrees of freedom",
        );
        let u = decision.standard_uncertainty.expect("u");
        close(decision.expanded_uncertainty.expect("U"), k * u, 1e-12, "U");
    }
}

#[test]
fn a_value_at_the_end_of_its_range_has_the_distance_of_the_farther_end() {
    let whole = measured(1.0, [0.9, 1.0], Scale::Wilson);
    let k = whole.coverage_factor(0.95).expect("k");
    let u = whole.standard_uncertainty().expect("u");
    close(k * u, 0.1, 1e-12, "U");
    let cut = measured(0.1, [0.0, 0.5], Scale::Cut);
    let u = cut.standard_uncertainty().expect("u");
    close(k * u, 0.4, 1e-12, "U");
}

#[test]
fn a_value_outside_its_interval_is_no_measurement() {
    let refused = Measurement::of_interval(0.0535, [0.0842, 0.136], 31.0, Scale::Logarithm);
    let error = refused.expect_err("outside");
    assert!(matches!(error, ConformityError::Number { .. }), "{error}");
    let infinite = Measurement::of_interval(0.1, [0.05, f64::INFINITY], 31.0, Scale::Own);
    assert!(infinite.is_err());
}

#[test]
fn a_limit_below_all_errors_is_certain_for_infinite_degrees_of_freedom_too() {
    let error = Measurement::new(0.08, 0.008, f64::INFINITY).expect("valid");
    let error = error.logarithmic().expect("above 0");
    let least = Limits::at_least(0.0).expect("finite");
    assert_eq!(error.conformance_probability(&at_most(0.0)), Some(0.0));
    assert_eq!(error.conformance_probability(&least), Some(1.0));
}

#[test]
fn no_probability_is_below_zero() {
    let measured = Measurement::new(0.0, 1.0, 9.0).expect("valid");
    for step in 1..400_u32 {
        let least = f64::from(step) / 100.0;
        let limits = Limits::between(least, least * (1.0 + f64::EPSILON)).expect("in order");
        let p = measured.conformance_probability(&limits).expect("p");
        assert!((0.0..1e-14).contains(&p), "{least}: {p}");
    }
}

#[test]
fn a_guard_beyond_all_numbers_refuses_no_value() {
    let rule = DecisionRule::Guarded {
        r: 1e4,
        coverage: 0.95,
    };
    let error = measured(0.08, [0.064, 0.1], Scale::Logarithm);
    let decision = decided(&error, &at_most(0.05), &rule);
    assert_eq!(decision.word, Word::ConditionalFail);
}

#[test]
fn no_error_is_accepted_by_a_limit_of_zero() {
    let error = measured(0.08, [0.064, 0.1], Scale::Logarithm);
    for rule in [GUARDED, DecisionRule::Probability { p_conformity: 0.95 }] {
        let decision = decided(&error, &at_most(0.0), &rule);
        assert_eq!(decision.word, Word::Fail, "{rule}");
        close(
            decision.conformance_probability.expect("p"),
            0.0,
            1e-300,
            "p",
        );
    }
}

#[test]
fn a_limit_at_the_end_of_a_range_leaves_the_other_one_to_the_probability() {
    let rule = DecisionRule::Probability { p_conformity: 0.95 };
    let share = measured(0.8, [0.5, 16.0 / 17.0], Scale::Wilson);
    let alone = Limits::at_least(0.6).expect("finite");
    let alone = decided(&share, &alone, &rule).acceptance.expect("room");
    let alone = alone.least().expect("a lower limit");
    assert!(alone > 0.8, "{alone}");
    for most in [1.0, 2.0] {
        let limits = Limits::between(0.6, most).expect("in order");
        let decision = decided(&share, &limits, &rule);
        assert_eq!(decision.word, Word::ConditionalPass);
        let inner = decision.acceptance.expect("room");
        close(inner.least().expect("a lower limit"), alone, 1e-12, "least");
        assert_eq!(inner.most(), Some(most));
    }
}

/// Measurements of five units, whose values are 0.08 times the exponentials of `steps`.
fn units(steps: [f64; 5], standard: f64) -> Vec<Measurement> {
    let unit = |step: f64| {
        let value = 0.08 * step.exp();
        let unit = Measurement::new(value, standard * value, 30.0).expect("a unit");
        unit.logarithmic().expect("above 0")
    };
    steps.map(unit).to_vec()
}

#[test]
fn units_are_a_process_on_the_scale_of_the_measurement() {
    // Variance 0.1 between values, 0.01 of which is that of measurement.
    let measured = units([-0.4, -0.2, 0.0, 0.2, 0.4], 0.1);
    let population = Population::of(&measured, &measured[2]).expect("a population");
    let process = Process::new(0.0, 0.09_f64.sqrt(), 0.1).expect("a process");
    let step = 1.5_f64.ln();
    let limits = at_most(0.12);
    let found = population.risk(&limits, &limits).expect("on the scale");
    let expected = process.risk(&at_most(step), &at_most(step));
    close(found.consumer, expected.consumer, 1e-9, "consumer's risk");
    close(found.producer, expected.producer, 1e-9, "producer's risk");
    let target = found.consumer / 10.0;
    let inner = population.acceptance(&limits, target).expect("a target");
    let guard = process.guard(&at_most(step), target).expect("a target");
    let most = inner.expect("room").most().expect("an upper limit");
    let expected = 0.12 * (-guard.expect("a guard")).exp();
    close(most, expected, 1e-9, "acceptance limit");
}

#[test]
fn units_that_show_no_process_are_refused() {
    let measured = units([-0.4, -0.2, 0.0, 0.2, 0.4], 0.1);
    let refusal = |units: &[Measurement]| {
        let error = Population::of(units, &measured[2]).expect_err("refused");
        error.to_string()
    };
    let few = refusal(&measured[..4]);
    assert_eq!(
        few,
        "the number of units is 4, expected at least 5 units of one process"
    );
    let alike = refusal(&units([0.0; 5], 0.1));
    assert!(
        alike.contains("differ by more than their uncertainties"),
        "{alike}"
    );
    let mut unknown = measured.clone();
    unknown[0] = Measurement::without_uncertainty(0.07).expect("finite");
    let unknown = refusal(&unknown);
    assert!(
        unknown.contains("from an interval of each unit"),
        "{unknown}"
    );
    let mut negative = measured.clone();
    negative[0] = Measurement::new(-0.07, 0.01, 30.0).expect("finite");
    let negative = refusal(&negative);
    assert!(
        negative.starts_with("the value of a unit is -0.07"),
        "{negative}"
    );
}
