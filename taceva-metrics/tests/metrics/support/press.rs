//! Samples with all fields of scores by place, scene and grating.

use taceva_core::{Channel, Channels, Field, FieldSet, Footprint, Readings, Sample, SampleSink};
use taceva_metrics::{Evaluation, Evaluator, MetricPlan, SensorFacts, catalogue};

/// Metrics by place, scene and grating.
pub(crate) const METRICS: [&str; 5] = ["sr", "sensitivity", "uniformity", "r_spatial", "r_light"];

/// Facts of a disc with a radius of 12.5 mm and a greatest indentation of 1 mm.
pub(crate) fn facts() -> SensorFacts {
    SensorFacts::default().with_footprint(Some(Footprint::disc(12.5, Some(1.0)).expect("lengths")))
}

/// A plan of `metrics` for the six channels of a contact.
pub(crate) fn plan(metrics: &[&str]) -> MetricPlan {
    let wanted = catalogue::select(metrics.iter().copied()).expect("known names");
    let channels = Channels::new(Channel::SIX).expect("distinct channels");
    MetricPlan::new(
        &wanted,
        channels,
        Field::ALL.into_iter().collect::<FieldSet>(),
    )
    .with_facts(facts())
}

/// A press at a place in mm with a normal force in N and no shear. Predictions differ from the truth by `error` in every channel.
pub(crate) fn press(point: usize, place: [f64; 3], force_n: f64, error: f64) -> Sample {
    let [x, y, z] = place;
    let truth = [x, y, z, 0.0, 0.0, force_n];
    Sample::default()
        .with_point_id(format!("point {point}"))
        .with_truth(Readings::from_values(truth))
        .with_prediction(Readings::from_values(truth.map(|value| value + error)))
}

/// An evaluator with `samples`, added one by one.
pub(crate) fn evaluator<'a>(
    plan: &MetricPlan,
    samples: impl IntoIterator<Item = &'a Sample>,
) -> Evaluator {
    let mut evaluator = Evaluator::new(plan);
    for sample in samples {
        evaluator.accept(sample).expect("the plan's channels");
    }
    evaluator
}

/// The scores of `samples`.
pub(crate) fn evaluate(metrics: &[&str], samples: &[Sample]) -> Evaluation {
    let evaluator = evaluator(&plan(metrics), samples);
    evaluator.finish().expect("the plan's channels")
}
