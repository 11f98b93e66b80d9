//! A missing value has a reason, which reports print in words.

use crate::support::rows::{Row, evaluate};
use taceva_core::{Batch, Channel, Channels, Column, FieldSet, Unit};
use taceva_metrics::{Evaluation, Evaluator, GREATEST, Interval, MetricPlan, Value, catalogue};

fn said(evaluation: &Evaluation, metric: &str, channel: &str) -> String {
    match &evaluation.score(metric, channel).expect("a score").value {
        Value::Undefined(reason) => reason.to_string(),
        Value::NotApplicable(reason) => reason.to_string(),
        value => panic!("{metric} of {channel} is {value:?}"),
    }
}

fn interval_said(evaluation: &Evaluation, metric: &str, channel: &str) -> String {
    match evaluation.score(metric, channel).expect("a score").interval {
        Interval::Undefined(reason) => reason.to_string(),
        interval => panic!("{metric} of {channel} has {interval:?}"),
    }
}

#[test]
fn nothing_has_no_value() {
    let evaluation = evaluate(&[]);
    let labels: Vec<&str> = evaluation
        .scores()
        .filter(|(metric, _, _)| metric.id == "mae")
        .map(|(_, label, _)| label)
        .collect();
    assert_eq!(labels, ["Fx", "Fy", "Fxy"]);
    for (metric, label, score) in evaluation.scores() {
        assert_eq!(said(&evaluation, metric.id, label), "empty");
        assert_eq!(score.n, 0);
    }
}

#[test]
fn one_sample_has_an_error_and_no_explained_share() {
    let evaluation = evaluate(&[Row::same(1.0, 1.5, 0)]);
    assert_eq!(said(&evaluation, "r2", "Fx"), "fewer than 2 samples");
    assert_eq!(said(&evaluation, "r2", "Fxy"), "fewer than 2 samples");
    let mae = evaluation.score("mae", "Fx").expect("a score");
    assert_eq!(mae.value, Value::Scalar(0.5));
    assert_eq!(
        interval_said(&evaluation, "mae", "Fx"),
        "1 cluster, 5 are needed"
    );
}

#[test]
fn a_constant_truth_has_no_spread_to_explain() {
    let rows: Vec<Row> = (0..9).map(|row| Row::same(0.1, 0.2, row)).collect();
    assert_eq!(said(&evaluate(&rows), "r2", "Fy"), "constant truth");
}

#[test]
fn a_spread_that_hangs_on_one_location_has_no_interval() {
    let rows: Vec<Row> = (0..9)
        .map(|row| Row::same(if row == 4 { 1.0 } else { 0.0 }, 0.5, row))
        .collect();
    let evaluation = evaluate(&rows);
    assert!(
        evaluation
            .score("r2", "Fx")
            .is_some_and(|score| score.value.scalar().is_some())
    );
    assert_eq!(interval_said(&evaluation, "r2", "Fx"), "constant truth");
}

#[test]
fn samples_below_the_gate_have_no_gated_score() {
    let rows: Vec<Row> = (0..9).map(|row| Row::same(0.01, 0.02, row)).collect();
    let evaluation = evaluate(&rows);
    assert_eq!(
        said(&evaluation, "smape_gated", "Fx"),
        "no truth reaches the gate"
    );
    let reached = evaluate(&[Row::same(0.02, 0.02, 0), Row::same(-0.02, 0.0, 1)]);
    assert_eq!(reached.score("smape_gated", "Fx").expect("a score").n, 2);
}

#[test]
fn one_sample_without_location_ends_the_clusters() {
    let mut rows: Vec<Row> = (0..9).map(|row| Row::same(1.0, 2.0, row)).collect();
    assert!(
        evaluate(&rows)
            .score("mae", "Fx")
            .is_some_and(|score| score.interval.ends().is_some())
    );
    rows[3].point = None;
    let evaluation = evaluate(&rows);
    assert_eq!(
        interval_said(&evaluation, "mae", "Fx"),
        "samples without point_id"
    );
}

#[test]
fn a_root_of_a_square_beyond_binary64_is_a_number() {
    let large = 2.0_f64.powi(1020);
    let evaluation = evaluate(&[Row::same(large, -large, 0)]);
    let rmse = evaluation.score("rmse", "Fx").expect("a score");
    assert_eq!(rmse.value, Value::Scalar(2.0 * large));
    let mae = evaluation.score("mae", "Fx").expect("a score");
    assert_eq!(mae.value, Value::Scalar(2.0 * large));
    let euclidean = evaluation.score("mae_euclid", "Fxy").expect("a score");
    assert!(
        euclidean
            .value
            .scalar()
            .is_some_and(|value| value > 2.0 * large)
    );
}

#[test]
fn what_is_no_number_is_counted_and_what_is_absent_is_not() {
    let mut rows: Vec<Row> = (0..9).map(|row| Row::same(1.0, 1.0, row)).collect();
    rows[0].truth[0] = Some(f64::NAN);
    rows[1].prediction[0] = Some(f64::INFINITY);
    rows[2].truth[0] = Some(f64::from_bits(GREATEST.to_bits() + 1));
    rows[3].truth[0] = None;
    rows[4].prediction[0] = None;
    rows[5].prediction[0] = None;
    rows[5].truth[0] = Some(f64::NAN);
    let evaluation = evaluate(&rows);
    let counts = |metric, label| {
        let score = evaluation.score(metric, label).expect("a score");
        (score.n, score.n_invalid)
    };
    assert_eq!(counts("mae", "Fx"), (3, 3));
    assert_eq!(counts("mae", "Fy"), (9, 0));
    assert_eq!(counts("mae", "Fxy"), (3, 3));
    assert_eq!(counts("mae_euclid", "Fxy"), (3, 3));
}

#[test]
fn an_angle_has_no_gate() {
    let angle = Channel::named("Rx", Unit::Degree).expect("a plain name");
    let channels = Channels::new([angle]).expect("one channel");
    let plan = MetricPlan::new(&catalogue::ALL, channels.clone(), FieldSet::PAIRS);
    let mut evaluator = Evaluator::new(&plan);
    let column = || vec![Column::full(vec![1.0, 2.0])];
    evaluator
        .update(&Batch::from_columns(channels, column(), column(), None))
        .expect("the plan's channels");
    let evaluation = evaluator.finish().expect("the plan's channels");
    assert_eq!(
        said(&evaluation, "smape_gated", "Rx"),
        "no gate is defined for deg"
    );
    let json = serde_json::to_value(&evaluation).expect("a report");
    assert_eq!(
        json["metrics"]["smape_gated"]["Rx"],
        serde_json::json!({"better": "lower", "not_applicable": "no gate is defined for deg"})
    );
}

#[test]
fn a_batch_of_other_channels_is_refused() {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let batch = Batch::from_columns(
        channels,
        vec![Column::default()],
        vec![Column::default()],
        None,
    );
    let error = Evaluator::new(&crate::support::rows::plan())
        .update(&batch)
        .expect_err("other channels");
    assert_eq!(
        error.to_string(),
        "channels Fz [N], expected Fx [N], Fy [N]"
    );
}
