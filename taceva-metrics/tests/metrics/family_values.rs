//! Scores by place, scene and grating: values computed by hand, reasons for missing values, and rejected states.

mod lighting;
mod states;

use crate::support::press::{METRICS, evaluate, evaluator, facts, plan, press as pressed};
use serde_json::json;
use taceva_core::{
    Batch, Channel, Channels, Column, Field, FieldSet, Footprint, GratingKind, Labels, Nanometre,
    Readings, Sample,
};
use taceva_metrics::{
    Evaluation, Evaluator, Flag, Interval, MetricPlan, SensorFacts, Settings, State,
    UndefinedReason, Value, catalogue,
};

fn said(value: &Value) -> String {
    match value {
        Value::Undefined(reason) => reason.to_string(),
        Value::NotApplicable(reason) => reason.to_string(),
        value => panic!("{value:?}"),
    }
}

fn score_said(evaluation: &Evaluation, metric: &str, label: &str) -> String {
    said(&evaluation.score(metric, label).expect("a score").value)
}

fn variant_said(evaluation: &Evaluation, metric: &str, label: &str, name: &str) -> String {
    let score = evaluation.score(metric, label).expect("a score");
    said(&score.variant(name).expect("a variant").value)
}

fn lit(point: usize, scene: &str, intensity: f64, error: f64) -> Sample {
    pressed(point, [0.0, 0.0, 0.5], 1.0, error)
        .with_scene_id(scene.to_owned())
        .with_intensity(intensity)
}

#[test]
fn nothing_has_no_value_and_says_so() {
    let evaluation = evaluate(&METRICS, &[]);
    let labels: Vec<&str> = evaluation.scores().map(|(_, label, _)| label).collect();
    assert_eq!(labels[..4], ["line", "dot", "Fz", "Fz"]);
    for (metric, label, score) in evaluation.scores() {
        assert_eq!(
            (said(&score.value), score.n),
            ("empty".to_owned(), 0),
            "{} {label}",
            metric.id
        );
    }
}

#[test]
fn one_press_has_a_sensitivity_and_one_bin_and_no_interval() {
    let evaluation = evaluate(&METRICS, &[pressed(0, [1.0, 1.0, 0.5], 2.0, 0.25)]);
    let sensitivity = evaluation.score("sensitivity", "Fz").expect("a score");
    assert_eq!(sensitivity.value, Value::Scalar(0.25));
    let Interval::Undefined(reason) = sensitivity.interval else {
        panic!("one cluster is not enough");
    };
    assert_eq!(reason.to_string(), "1 cluster, 5 are needed");
    let uniformity = evaluation.score("uniformity", "Fz").expect("a score");
    assert_eq!(
        (&uniformity.value, &uniformity.flags[..]),
        (&Value::Scalar(1.0), &[Flag::OneBin][..])
    );
    assert_eq!(
        variant_said(&evaluation, "uniformity", "Fz", "debiased"),
        "no bin has two samples"
    );
    assert_eq!(
        variant_said(&evaluation, "uniformity", "Fz", "n_min_5"),
        "no bin has 5 samples"
    );
    assert_eq!(
        evaluation.score("r_spatial", "Fz").expect("a score").value,
        Value::Scalar(0.0)
    );
    assert_eq!(
        variant_said(&evaluation, "r_spatial", "Fz", "excess"),
        "no bin has two samples"
    );
}

#[test]
fn what_is_no_number_is_counted_everywhere() {
    let samples: Vec<Sample> = (0..6)
        .map(|point| lit(point, "normal", 100.0, f64::NAN))
        .collect();
    let evaluation = evaluate(&["r_spatial", "r_light"], &samples);
    for metric in ["r_spatial", "r_light"] {
        let score = evaluation.score(metric, "Fz").expect("a score");
        assert_eq!((score.n, score.n_invalid), (0, 6), "{metric}");
        assert_eq!(said(&score.value), "empty");
    }
    let presses: Vec<Sample> = (0..6)
        .map(|point| pressed(point, [0.0, 0.0, f64::NAN], 1.0, 0.0))
        .collect();
    let evaluation = evaluate(&["sensitivity"], &presses);
    let score = evaluation.score("sensitivity", "Fz").expect("a score");
    assert_eq!((score.n, score.n_invalid), (0, 6));
    let dark = evaluate(&["r_light"], &[lit(0, "normal", -1.0, 0.1)]);
    assert_eq!(dark.score("r_light", "Fz").expect("a score").n_invalid, 1);
}

#[test]
fn presses_below_the_gate_or_off_the_surface_are_counted_apart() {
    let samples = [
        pressed(0, [0.0, 0.0, 0.1], 0.019, 0.0),
        pressed(1, [0.0, 0.0, -0.1], 1.0, 0.0),
        pressed(2, [12.0, 12.0, 0.1], 1.0, 0.0),
    ];
    let all = evaluate(&["sensitivity", "uniformity"], &samples);
    let score = all.score("sensitivity", "Fz").expect("a score");
    assert_eq!(
        (score.n, score.count("gated"), score.count("outside")),
        (1, Some(2), Some(1))
    );
    assert_eq!(
        score_said(&all, "uniformity", "Fz"),
        "no sample on the footprint"
    );
    let gated = evaluate(&["sensitivity", "uniformity"], &samples[..2]);
    assert_eq!(
        score_said(&gated, "sensitivity", "Fz"),
        "no truth reaches the gate"
    );
    let deep = evaluate(&["r_spatial"], &[pressed(0, [0.0, 0.0, 1.5], 1.0, 0.1)]);
    assert_eq!(
        score_said(&deep, "r_spatial", "Fz"),
        "no sample on the footprint"
    );
    assert_eq!(
        deep.score("r_spatial", "Fz")
            .and_then(|score| score.count("outside")),
        Some(1)
    );
}

#[test]
fn shear_that_nobody_measures_leaves_no_normal_presses_to_select() {
    let wanted = catalogue::select(["sensitivity"]).expect("known names");
    let channels = Channels::new([Channel::PZ, Channel::FZ]).expect("two channels");
    let plan = MetricPlan::new(&wanted, channels, FieldSet::PAIRS);
    let sample = Sample::default().with_truth(Readings::from_values([0.5, 2.0]));
    let evaluation = evaluator(&plan, [&sample])
        .finish()
        .expect("the plan's channels");
    assert_eq!(
        variant_said(&evaluation, "sensitivity", "Fz", "normal_only"),
        "channel `Fx` is not scored"
    );
    assert_eq!(
        evaluation
            .score("sensitivity", "Fz")
            .map(|score| score.variant("map")),
        Some(None)
    );
    let sheared =
        Sample::default().with_truth(Readings::from_values([0.0, 0.0, 0.5, 0.1, 0.0, 2.0]));
    let evaluation = evaluate(&["sensitivity"], &[sheared]);
    assert_eq!(
        variant_said(&evaluation, "sensitivity", "Fz", "normal_only"),
        "empty"
    );
}

#[test]
fn facts_that_nobody_declared_are_named() {
    let wanted = catalogue::select(METRICS).expect("known names");
    let channels = Channels::new(Channel::SIX).expect("distinct channels");
    let all: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels, all);
    let reasons = |plan: &MetricPlan| -> Vec<String> {
        let skipped = plan.skipped().iter();
        skipped
            .map(|skipped| format!("{}: {}", skipped.what, skipped.reason))
            .collect()
    };
    assert_eq!(
        reasons(&plan),
        [
            "metric:uniformity: the sensor's `footprint` is not declared",
            "metric:r_spatial: the sensor's `footprint` is not declared",
        ]
    );
    let opaque = SensorFacts::default()
        .with_footprint(Some(Footprint::disc(5.0, None).expect("a length")))
        .with_opaque(Some(true));
    assert_eq!(
        reasons(&plan.with_facts(opaque)),
        [
            "metric:r_spatial: the sensor's `depth_max_mm` is not declared",
            "metric:r_light: the gel is opaque: ambient light cannot reach the camera",
        ]
    );
}

#[test]
fn boards_without_a_name_are_clusters_by_what_is_on_them() {
    let wanted = catalogue::select(["sr"]).expect("known names");
    let gratings = FieldSet::EMPTY
        .with(Field::Kind)
        .with(Field::Spacing)
        .with(Field::PredictedSpacing);
    let plan = MetricPlan::new(&wanted, Channels::default(), gratings);
    let samples: Vec<Sample> = (0..30)
        .map(|row| {
            Sample::default()
                .with_kind(GratingKind::Line)
                .with_spacing(Nanometre(250_000 + 50_000 * (row % 6)))
                .with_predicted_spacing(Nanometre(300_000))
        })
        .collect();
    let evaluation = evaluator(&plan, &samples)
        .finish()
        .expect("the plan's channels");
    let score = evaluation.score("sr", "line").expect("a score");
    assert_eq!(score.value, Value::Scalar(0.5));
    assert_eq!(
        score.interval.method().as_deref(),
        Some("jackknife by point_id, G=6, Wilson with effective samples")
    );
    let wilson = score.variant("wilson").and_then(|wilson| wilson.interval);
    assert!(matches!(wilson, Some(Interval::Wilson { low, high }) if low < 0.5 && 0.5 < high));
}

#[test]
fn a_spacing_between_two_nanometres_is_invalid() {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let wanted = catalogue::select(["sr"]).expect("known names");
    let all: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels.clone(), all);
    let mut kinds = Labels::default();
    (0..2).for_each(|_| kinds.push("line"));
    let column = || vec![Column::full(vec![0.0; 2])];
    let batch = Batch::from_columns(channels, column(), column(), None)
        .with_labels(Field::Kind, kinds)
        .with_numbers(Field::Spacing, Column::full(vec![350_000.0, 350_000.5]))
        .with_numbers(Field::PredictedSpacing, Column::full(vec![350_000.0; 2]));
    let mut evaluator = Evaluator::new(&plan);
    evaluator.update(&batch).expect("the plan's channels");
    let evaluation = evaluator.finish().expect("the plan's channels");
    let score = evaluation.score("sr", "line").expect("a score");
    assert_eq!((score.n, score.n_invalid), (1, 1));
}
