//! Scores that compare presses at one point, from golden vectors in every order, split and merged.

use crate::support::golden_vectors::{
    Comparison, Random, check_keys, exact, in_every_way, real, section, text, whole,
};
use serde_json::Value;
use taceva_core::{Channel, Channels, Field, FieldSet, Phase, Readings, Sample};
use taceva_metrics::{
    Evaluation, MetricPlan, Score, UndefinedReason, Value as ScoreValue, catalogue,
};

fn plan(metric: &str, channels: &[Channel]) -> MetricPlan {
    let channels = Channels::new(channels.iter().cloned()).expect("distinct channels");
    let wanted = catalogue::select([metric]).expect("a known name");
    let available: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels, available);
    assert_eq!(plan.skipped(), []);
    plan
}

fn score<'a>(evaluation: &'a Evaluation, metric: &str, label: &str) -> &'a Score {
    evaluation.score(metric, label).expect("a score")
}

fn variant(score: &Score, name: &str) -> Option<f64> {
    score.variant(name)?.value.scalar()
}

/// Nearest binary64 of a decimal number or a fraction.
fn number(value: &Value) -> f64 {
    let parse = |text: &str| text.parse::<f64>().expect("a decimal number");
    match text(value).split_once('/') {
        Some((numerator, denominator)) => parse(numerator) / parse(denominator),
        None => parse(text(value)),
    }
}

/// Samples of the recipe's repeats. Dropped repeats are presses with a NaN prediction.
fn repeats(params: &Value) -> Vec<Sample> {
    let mut random = Random::new(whole(&params["seed"]));
    let count = |key: &str| u32::try_from(whole(&params[key])).expect("a small count");
    let [z0, dz, sd] = ["z0", "dz", "sd"].map(|key| real(&params[key]));
    let mut samples = Vec::new();
    for point in 0..count("K") {
        for step in 0..count("D") {
            let mut values = Vec::new();
            for _ in 0..count("N") {
                let value = (z0 + dz * f64::from(step)) + sd * random.bell();
                let dropped = random.next().is_multiple_of(10);
                values.push(if dropped { f64::NAN } else { value });
            }
            match (point, step) {
                (0, 0) => {
                    values.retain(|value| !value.is_nan());
                    values.truncate(1);
                }
                (0, 1) => values = vec![f64::NAN],
                (0, 2) => values = vec![7.25; 4],
                _ => {}
            }
            samples.extend((0..).zip(values).map(|(repeat, value)| {
                Sample::default()
                    .with_point_id(format!("point {point}"))
                    .with_depth_step(step)
                    .with_repeat(repeat)
                    .with_truth(Readings::new(vec![None]))
                    .with_prediction(Readings::from_values([value]))
            }));
        }
    }
    samples
}

#[test]
fn repeatability_is_that_of_the_golden_vectors_by_bits() {
    let known = [
        "params",
        "recipe",
        "cells_total",
        "cells_valid",
        "samples",
        "rep_sample_std",
        "rep_population_std",
        "truth_sample",
    ];
    let rep = section("rep", &known);
    check_keys(&rep["params"], &["seed", "K", "D", "N", "z0", "dz", "sd"]);
    let samples = repeats(&rep["params"]);
    let mut comparison = Comparison::default();
    for (way, evaluation) in in_every_way(&plan("repeatability", &[Channel::PX]), &samples) {
        let score = score(&evaluation, "repeatability", "Px");
        comparison.bits(way, score.value.scalar(), exact(&rep["rep_sample_std"]));
        let population = variant(score, "population");
        comparison.bits(way, population, exact(&rep["rep_population_std"]));
        comparison.count(way, Some(score.n), whole(&rep["samples"]));
        comparison.count(way, score.count("cells_valid"), whole(&rep["cells_valid"]));
        comparison.count(way, score.count("cells_total"), whole(&rep["cells_total"]));
        let truth = number(&rep["truth_sample"]);
        let found = score.value.scalar().expect("a number");
        assert!((found - truth).abs() <= 1e-15 * truth);
    }
    println!("{} values of repeatability compared", comparison.done());
}

/// Both branches of a case as samples of one point.
fn press(case: &Value) -> Vec<Sample> {
    let branch = |key: &str, phase| {
        let corners = case[key].as_array().expect("corners").iter();
        let samples = corners.map(move |corner| {
            Sample::default()
                .with_point_id("only".to_owned())
                .with_phase(phase)
                .with_truth(Readings::from_values([
                    number(&corner[0]),
                    number(&corner[1]),
                ]))
        });
        samples.collect::<Vec<_>>()
    };
    [
        branch("load_zF", Phase::Load),
        branch("unload_zF", Phase::Unload),
    ]
    .concat()
}

#[test]
fn hysteresis_is_that_of_the_golden_vectors_to_a_rounding() {
    let cases = section("hysteresis", &[]);
    let plan = plan("hysteresis", &[Channel::PZ, Channel::FZ]);
    let mut compared = 0;
    for case in cases.as_array().expect("cases") {
        check_keys(case, &["name", "load_zF", "unload_zF", "expected"]);
        let name = text(&case["name"]);
        for (way, evaluation) in in_every_way(&plan, &press(case)) {
            let score = score(&evaluation, "hysteresis", "Fz");
            let expected = &case["expected"];
            if expected.is_null() {
                assert_eq!(
                    score.value,
                    ScoreValue::Undefined(UndefinedReason::NoOverlap),
                    "{name}"
                );
                compared += 1;
                continue;
            }
            check_keys(
                expected,
                &["abs_area", "signed_area", "work_load", "ratio", "overlap"],
            );
            let area = score.value.scalar();
            let ratio = variant(score, "ratio");
            let work = area.zip(ratio).map(|(area, ratio)| area / ratio);
            for (key, found) in [
                ("abs_area", area),
                ("signed_area", variant(score, "signed_area")),
                ("ratio", ratio),
                ("work_load", work),
            ] {
                let (found, expected) = (found.expect("a number"), number(&expected[key]));
                let error = (found - expected).abs();
                assert!(
                    error <= 1e-15 * expected.abs(),
                    "{name}, {way}, {key}: {found}"
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 0, "nothing was compared");
    println!("{compared} values of hysteresis compared");
}

#[test]
fn scores_by_press_are_the_same_on_every_instruction_set() {
    crate::support::golden_vectors::again_on_every_instruction_set("structured_cells::");
}
