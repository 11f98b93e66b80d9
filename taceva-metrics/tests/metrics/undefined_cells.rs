//! Scores by press, unit, time and level, for samples with a known answer, and reasons for missing scores.

mod detection;
mod limits;
mod loops;
mod predictions;
mod recording;
mod repeats;
mod surfaces;

use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, Phase, Readings, Sample, SampleSink, Stamp, Unit,
};
use taceva_metrics::{
    Evaluation, Evaluator, Flag, Interval, MetricPlan, Score, SensorFacts, Value, catalogue,
};

/// Evaluates samples with readings of `channels`.
fn evaluate(metric: &str, channels: &[&str], samples: &[Sample]) -> Evaluation {
    let channel = |name: &&str| {
        let unit = match name.as_bytes() {
            [b'F', ..] => Unit::Newton,
            [b'R', ..] => Unit::Degree,
            [b'L', ..] => Unit::Lux,
            _ => Unit::Millimetre,
        };
        Channel::named(name, unit).expect("a plain name")
    };
    let channels = Channels::new(channels.iter().map(channel)).expect("distinct channels");
    let wanted = catalogue::select([metric]).expect("a known name");
    let available: FieldSet = Field::ALL.into_iter().collect();
    let facts =
        SensorFacts::default().with_footprint(Some(Footprint::disc(10.0, None).expect("a length")));
    let plan = MetricPlan::new(&wanted, channels, available).with_facts(facts);
    assert_eq!(plan.skipped(), []);
    let mut evaluator = Evaluator::new(&plan);
    for sample in samples {
        evaluator.accept(sample).expect("the plan's channels");
    }
    evaluator.finish().expect("the plan's channels")
}

fn score<'a>(evaluation: &'a Evaluation, metric: &str, label: &str) -> &'a Score {
    evaluation.score(metric, label).expect("a score")
}

fn said(evaluation: &Evaluation, metric: &str, label: &str) -> String {
    match &score(evaluation, metric, label).value {
        Value::Undefined(reason) => reason.to_string(),
        Value::NotApplicable(reason) => reason.to_string(),
        value => panic!("{metric} of {label} is {value:?}"),
    }
}

fn scalar(evaluation: &Evaluation, metric: &str, label: &str) -> f64 {
    let score = score(evaluation, metric, label);
    score
        .value
        .scalar()
        .unwrap_or_else(|| panic!("{:?}", score.value))
}

fn close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{found}, not {expected}"
    );
}

fn pair(truth: &[f64], prediction: &[f64]) -> Sample {
    Sample::default()
        .with_truth(Readings::from_values(truth.iter().copied()))
        .with_prediction(Readings::from_values(prediction.iter().copied()))
}

fn at(point: &str, sample: Sample) -> Sample {
    sample.with_point_id(point.to_owned())
}

fn timed(valid_s: f64, sample: Sample) -> Sample {
    sample.with_stamp(Stamp {
        valid_s,
        received_s: None,
    })
}

#[test]
fn an_empty_stream_has_no_value_of_any_kind() {
    let channels = ["Px", "Py", "Pz", "Fx", "Fy", "Fz", "surface_z"];
    for metric in catalogue::ALL
        .iter()
        .skip_while(|metric| metric.id != "r_light")
        .filter(|metric| metric.id != "intrinsic")
    {
        let evaluation = evaluate(metric.id, &channels, &[]);
        assert!(evaluation.scores().count() > 0, "{}", metric.id);
        for (_, label, score) in evaluation.scores() {
            let expected = match metric.id {
                "noise_equivalent_force" | "zero_error" => "every sample is in contact",
                "detection_limit" => {
                    "no light press: press ten places or more with 0.02 N to 0.2 N"
                }
                _ => "empty",
            };
            let undefined = !matches!(score.value, Value::NotApplicable(_));
            assert!(undefined);
            assert_eq!(
                said(&evaluation, metric.id, label),
                expected,
                "{} {label}",
                metric.id
            );
        }
    }
}

#[test]
fn values_that_are_no_numbers_are_counted_and_give_none() {
    let broken = |point: &str| {
        timed(1.0, at(point, pair(&[f64::NAN; 6], &[f64::INFINITY; 6])))
            .with_depth_step(0)
            .with_repeat(0)
            .with_phase(Phase::Load)
    };
    let channels = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"];
    for metric in [
        "repeatability",
        "hysteresis",
        "linearity",
        "crosstalk",
        "bias_level",
        "tolerance",
        "drift",
        "agreement",
        "tolerance_interval",
    ] {
        let evaluation = evaluate(metric, &channels, &[broken("a"), broken("b")]);
        for (_, label, score) in evaluation.scores() {
            assert!(
                matches!(score.value, Value::Undefined(_)),
                "{metric} {label}"
            );
            assert_eq!((score.n, score.n_invalid), (0, 2), "{metric} {label}");
        }
    }
}
