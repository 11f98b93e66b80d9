//! Tests of the planner with synthetic metrics, so that each rule is tested independently of the catalogue.

pub(crate) mod bench;
mod explained;
mod reached;
mod shapes_and_poses;
mod skipped;
mod strokes;

use taceva_core::{Axes, FieldSet, Millimetre};
use taceva_core::{Channel, Channels, Field};

use super::*;
use crate::source::{RecordingInfo, RigInfo};
use bench::{SMALL, paper_metrics, rig_of, sensor};

fn planned_as(text: &str, source: SourceInfo, needs: &[MetricNeeds]) -> Plan {
    let scene = Scene::parse("small", text).expect("a scene");
    plan_study(&scene, &scene.studies[0], &source, needs).expect("a plan")
}

fn planned(text: &str, rig: RigInfo) -> Plan {
    planned_as(text, SourceInfo::Rig(Box::new(rig)), &paper_metrics())
}

fn ids(plan: &Plan) -> Vec<&str> {
    plan.metrics
        .iter()
        .map(|metric| metric.id.as_str())
        .collect()
}

fn reason(plan: &Plan, metric: &str) -> String {
    let subject = Subject::Metric(metric.to_owned());
    let skip = plan.skipped.iter().find(|skip| skip.subject == subject);
    skip.map_or_else(String::new, |skip| skip.reason.to_string())
}

/// Only the metrics called `kept`.
fn only(kept: &[&str]) -> Vec<MetricNeeds> {
    let all = paper_metrics().into_iter();
    all.filter(|needs| kept.contains(&needs.id.as_str()))
        .collect()
}

#[test]
fn a_whole_rig_runs_everything() {
    let plan = planned(SMALL, rig_of(sensor(), Axes::FORCE));
    assert_eq!(ids(&plan).len(), paper_metrics().len(), "{plan}");
    // The scene asks for no strokes.
    assert_eq!(plan.phases, PhaseKind::ALL[..8]);
    let golden = include_str!("../../tests/golden/everything.txt");
    assert_eq!(plan.to_string(), golden);
}

#[test]
fn every_reason_has_its_golden_line_in_the_text_of_a_plan() {
    let mut plan = planned(SMALL, rig_of(sensor(), Axes::FORCE));
    let explained = |reason: PlanReason, plan: &mut Plan| {
        let subject = match reason {
            PlanReason::VisitedBy { .. } => Subject::Phase(PhaseKind::LightSweep),
            _ => Subject::Metric("r_light".to_owned()),
        };
        plan.skipped = vec![PlanSkip { subject, reason }];
        let text = plan.to_string();
        let last = text.lines().last().expect("a plan has lines").to_owned();
        let is_explained = last.starts_with("skip  ") || last.starts_with("join  ");
        if is_explained { last } else { String::new() }
    };
    let lines: Vec<String> = PlanReason::all()
        .into_iter()
        .map(|reason| explained(reason, &mut plan))
        .collect();
    // A plan omits the reason of a metric that was not requested, so its line is empty.
    let golden = include_str!("../../tests/golden/reasons.txt");
    assert_eq!(lines, golden.lines().collect::<Vec<_>>());
}

#[test]
fn planning_twice_changes_nothing() {
    let opaque = sensor().with_opaque(true).with_markers(false);
    for (facts, axes) in [(sensor(), Axes::FORCE), (opaque, Axes::NORMAL)] {
        let scene = shapes_and_poses::with_both(SMALL);
        let scene = Scene::parse("small", &scene).expect("a scene");
        let source = SourceInfo::Rig(Box::new(rig_of(facts, axes)));
        let study = &scene.studies[0];
        let (units, lights) = (
            study.units(),
            study_facts::lights(&scene, study, &source).expect("lights"),
        );
        let gather = Gather {
            scene: &scene,
            study,
            source: &source,
            units: &units,
            lights: &lights,
        };
        let facts = gather.facts().expect("no contradiction");
        let phase_inputs = facts.phase_inputs.as_ref().expect("a footprint");
        for kind in PhaseKind::ALL {
            assert_eq!(
                phase_inputs.count(kind),
                phase_inputs.presses(kind).len() as u64,
                "{kind}"
            );
        }
        let everything = Collected::everything(&paper_metrics(), &facts);
        let once = refine(everything.clone(), &facts).expect("a plan");
        assert_eq!(refine(once.clone(), &facts).expect("the same"), once);
        // Nothing is added: every pass works on the result of the previous one.
        let kept = |collected: &Collected| {
            collected
                .presses
                .iter()
                .map(|press| press.id)
                .collect::<Vec<_>>()
        };
        assert!(kept(&once).iter().all(|id| kept(&everything).contains(id)));
        assert!(
            once.fields
                .iter()
                .all(|field| everything.fields.contains(field))
        );
        assert!(once.metrics.len() <= everything.metrics.len());
    }
}

#[test]
fn a_plan_does_not_change_with_the_order_or_number_of_other_metrics() {
    let source = || SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let all = planned_as(SMALL, source(), &paper_metrics());
    let alone = planned_as(SMALL, source(), &only(&["hysteresis"]));
    let of = |plan: &Plan| {
        let presses = plan.presses_of(PhaseKind::LoadUnload);
        presses.map(|press| press.id).collect::<Vec<_>>()
    };
    assert_eq!(
        of(&all),
        of(&alone),
        "a resumed or extended study finds its presses again"
    );
}

#[test]
fn a_plan_says_the_same_as_data() {
    let plan = planned(SMALL, rig_of(sensor(), Axes::FORCE));
    let json = serde_json::to_value(&plan).expect("a plan is data");
    assert_eq!(json["schema"], "taceva.plan/1");
    assert_eq!(
        json["presses"].as_array().map(Vec::len),
        Some(plan.presses.len())
    );
    assert_eq!(json["limits"]["normal_max"], 1.83);
    assert_eq!(json["digest"], plan.digest().to_string());
}

#[test]
fn a_whole_rig_gives_every_metric_of_the_catalogue() {
    let catalogue = MetricNeeds::catalogue();
    let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let plan = planned_as(SMALL, source, &catalogue);
    let left_out: Vec<&MetricNeeds> = catalogue
        .iter()
        .filter(|needs| !ids(&plan).contains(&needs.id.as_str()))
        .collect();
    assert!(left_out.is_empty(), "{left_out:?}\n{plan}");
}

#[test]
fn each_metric_is_computed_on_the_presses_that_vary_what_it_reads() {
    let expected = [
        ("mae", PhaseKind::Calibration),
        ("smape_gated", PhaseKind::Calibration),
        ("sensitivity", PhaseKind::Calibration),
        ("uniformity", PhaseKind::Calibration),
        ("sr", PhaseKind::Gratings),
        ("r_spatial", PhaseKind::Spatial),
        ("r_light", PhaseKind::LightSweep),
    ];
    let catalogue = MetricNeeds::catalogue();
    for (id, phase) in expected {
        let needs = catalogue
            .iter()
            .find(|needs| needs.id == id)
            .expect("in the catalogue");
        assert_eq!(needs.phase, phase, "{id}");
    }
    let of_paper = paper_metrics();
    let phase = |id: &str| {
        of_paper
            .iter()
            .find(|needs| needs.id == id)
            .map(|needs| needs.phase)
    };
    assert_eq!(phase("repeatability"), Some(PhaseKind::Repeatability));
    assert_eq!(phase("hysteresis"), Some(PhaseKind::LoadUnload));
    assert_eq!(phase("inter_sensor"), Some(PhaseKind::SurfaceMap));
    assert_eq!(phase("intrinsic"), Some(PhaseKind::Idle));
}

#[test]
fn metrics_get_the_facts_of_the_sensor_that_the_plan_knows() {
    let facts = planned(SMALL, rig_of(sensor(), Axes::FORCE)).sensor_facts();
    assert_eq!(
        (facts.opaque, facts.frame_size),
        (Some(false), Some([64, 48]))
    );
    assert_eq!(facts.reference_scene, "normal");
    let depth = facts.footprint.and_then(|footprint| footprint.depth_max());
    assert_eq!(depth, Some(taceva_core::Nanometre(1_000_000)));
}
