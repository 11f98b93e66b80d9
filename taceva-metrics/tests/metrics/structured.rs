//! Golden values of scores by grating, place and scene, bit for bit: in order, backwards, and shuffled, split and merged.

mod lighting;
mod spatial;
mod success_rate;
mod surface;

use crate::support::golden_vectors::{
    Comparison, Random, check_keys, exact, in_every_way, real, section, signed, text, whole,
};
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, GratingKind, Nanometre, Readings, Sample,
};
use taceva_metrics::{
    Evaluation, MetricPlan, SensorFacts, Settings, UndefinedReason, Value as Finished, catalogue,
};

fn plan(metrics: &[&str], channels: &[Channel], facts: SensorFacts) -> MetricPlan {
    let wanted = catalogue::select(metrics.iter().copied()).expect("known names");
    let channels = Channels::new(channels.iter().cloned()).expect("distinct channels");
    let available: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels, available).with_facts(facts);
    assert_eq!(plan.skipped(), []);
    plan
}

fn with(plan: &MetricPlan, settings: Settings) -> MetricPlan {
    plan.clone()
        .with_settings(settings)
        .expect("settings with a meaning")
}

fn value(evaluation: &Evaluation, metric: &str, label: &str) -> Option<f64> {
    evaluation.score(metric, label)?.value.scalar()
}

fn variant(evaluation: &Evaluation, metric: &str, label: &str, name: &str) -> Option<f64> {
    evaluation
        .score(metric, label)?
        .variant(name)?
        .value
        .scalar()
}

fn millimetres(nanometres: i64) -> f64 {
    Nanometre(nanometres).to_millimetres()
}

fn point(row: usize) -> Option<String> {
    Some(format!("point {}", row % 50))
}

#[test]
fn scores_by_place_scene_and_grating_are_the_same_on_every_instruction_set() {
    crate::support::golden_vectors::again_on_every_instruction_set("structured::");
}
