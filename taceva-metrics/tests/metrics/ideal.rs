//! Scores of sensors and classifiers that are ideal in one respect, by algebra.

use crate::support::press::{METRICS, evaluate, press as pressed};
use taceva_core::{GratingKind, Nanometre, Sample};
use taceva_metrics::{Evaluation, Value};

/// Spacings of the paper: 0.25 mm to 1.75 mm in steps of 0.05 mm.
const LEVELS: std::ops::RangeInclusive<i64> = 5..=35;
const STEP_NM: i64 = 50_000;

fn classified(truth: i64, prediction: i64) -> Sample {
    Sample::default()
        .with_kind(GratingKind::Line)
        .with_spacing(Nanometre(truth * STEP_NM))
        .with_predicted_spacing(Nanometre(prediction * STEP_NM))
}

fn success_rate(samples: &[Sample]) -> Value {
    let evaluation: Evaluation = evaluate(&METRICS, samples);
    evaluation
        .score("sr", "line")
        .expect("a score")
        .value
        .clone()
}

#[test]
fn a_perfect_classifier_predicts_every_spacing() {
    let samples: Vec<Sample> = LEVELS.map(|level| classified(level, level)).collect();
    assert_eq!(success_rate(&samples), Value::Scalar(1.0));
}

#[test]
fn a_classifier_that_guesses_evenly_is_right_as_often_as_spacings_have_neighbours() {
    let guesses = |truth: i64| LEVELS.map(move |guess| classified(truth, guess));
    let samples: Vec<Sample> = LEVELS.flat_map(guesses).collect();
    // Each of 31 spacings paired with itself, and 30 pairs of neighbours counted twice.
    assert_eq!(
        success_rate(&samples),
        Value::Scalar((31.0 + 2.0 * 30.0) / (31.0 * 31.0))
    );
}

#[test]
fn a_gel_that_yields_alike_everywhere_is_wholly_uniform() {
    let places = (0..100_u32).map(|at| [f64::from(at % 10) - 4.5, f64::from(at / 10) - 4.5]);
    let samples: Vec<Sample> = places
        .enumerate()
        .map(|(point, [x, y])| pressed(point, [x, y, 0.5], 2.0, 0.0))
        .collect();
    let evaluation = evaluate(&["uniformity", "sensitivity"], &samples);
    let value = |metric: &str| &evaluation.score(metric, "Fz").expect("a score").value;
    assert_eq!(
        (value("sensitivity"), value("uniformity")),
        (&Value::Scalar(0.25), &Value::Scalar(1.0))
    );
}
