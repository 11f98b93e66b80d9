//! The planner on metrics of its own, so that each rule is tried whatever the catalogue holds.

pub(crate) mod bench;
mod explained;
mod reached;

use taceva_core::{Axes, FieldSet, Millimetre, SensorFacts};
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
    assert_eq!(plan.phases, PhaseKind::ALL);
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
        let is_told = last.starts_with("skip  ") || last.starts_with("join  ");
        if is_told { last } else { String::new() }
    };
    let lines: Vec<String> = PlanReason::all()
        .into_iter()
        .map(|reason| explained(reason, &mut plan))
        .collect();
    // What nobody asked for is no news: its line is empty.
    let golden = include_str!("../../tests/golden/reasons.txt");
    assert_eq!(lines, golden.lines().collect::<Vec<_>>());
}

#[test]
fn planning_twice_changes_nothing() {
    let opaque = SensorFacts {
        opaque: Some(true),
        markers: Some(false),
        ..sensor()
    };
    for (facts, axes) in [(sensor(), Axes::FORCE), (opaque, Axes::NORMAL)] {
        let scene = Scene::parse("small", SMALL).expect("a scene");
        let source = SourceInfo::Rig(Box::new(rig_of(facts, axes)));
        let study = &scene.studies[0];
        let (units, lights) = (
            study.units(),
            facts::lights(&scene, study, &source).expect("lights"),
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
        // Nothing is added: every pass works on what the one before left.
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
fn an_opaque_gel_skips_lighting_and_says_why() {
    let opaque = SensorFacts {
        opaque: Some(true),
        ..sensor()
    };
    let plan = planned(SMALL, rig_of(opaque, Axes::FORCE));
    assert_eq!(
        reason(&plan, "r_light"),
        "the gel is opaque: ambient light cannot reach the camera"
    );
    assert!(!plan.phases.contains(&PhaseKind::LightSweep));
    let normal = plan.lights.first();
    assert!(
        plan.presses
            .iter()
            .all(|press| press.press.light.as_ref() == normal)
    );
}

#[test]
fn a_gel_without_markers_skips_the_repeatability_of_shear() {
    let bare = SensorFacts {
        markers: Some(false),
        ..sensor()
    };
    let plan = planned(SMALL, rig_of(bare, Axes::FORCE));
    let metric = plan
        .metrics
        .iter()
        .find(|metric| metric.id == "repeatability");
    assert_eq!(metric.expect("kept").channels, ["Px", "Py", "Pz", "Fz"]);
    assert!(reason(&plan, "repeatability (Fx, Fy)").starts_with("the gel has no markers"));
    let mut waypoints = plan
        .presses_of(PhaseKind::Repeatability)
        .flat_map(|press| press.press.waypoints());
    assert!(waypoints.all(|waypoint| waypoint.shear == [taceva_core::Nanometre(0); 2]));
}

#[test]
fn metrics_on_force_and_travel_alone_take_no_picture_and_fit_no_model() {
    let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let plan = planned_as(SMALL, source, &only(&["sensitivity", "hysteresis"]));
    assert_eq!(plan.phases, [PhaseKind::Calibration, PhaseKind::LoadUnload]);
    assert!(plan.presses.iter().all(|press| !press.frames));
    assert!(!plan.fields.contains(Field::Frame) && plan.fits.is_empty());
    assert_eq!((plan.cost.frames, plan.cost.bytes), (0, Some(0)));
    assert!(
        plan.to_string().contains("frames are not captured"),
        "{plan}"
    );
}

#[test]
fn pictures_are_taken_on_the_presses_of_those_who_look_at_them_alone() {
    let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let plan = planned_as(SMALL, source, &only(&["mae", "hysteresis"]));
    for press in &plan.presses {
        assert_eq!(press.frames, press.phases == [PhaseKind::Calibration]);
    }
    assert_eq!(plan.fits.len(), 1);
}

#[test]
fn without_a_model_predictions_are_a_chain_that_ends_there() {
    let text = SMALL.replace("[model]\nname = \"ridge\"\n", "");
    let plan = planned(&text, rig_of(sensor(), Axes::FORCE));
    assert_eq!(
        reason(&plan, "mae"),
        "needs `prediction` ← needs a model: none chosen"
    );
    assert_eq!(
        ids(&plan),
        ["sensitivity", "hysteresis", "inter_sensor", "intrinsic"]
    );
    assert!(plan.fits.is_empty());
}

#[test]
fn a_finished_model_is_not_fitted_again_and_predicts_no_spacing() {
    let text = SMALL.replace("name = \"ridge\"", "file = \"my.model\"");
    let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let plan = planned_as(&text, source, &only(&["r_spatial", "sr"]));
    assert_eq!((ids(&plan), plan.fits.len()), (vec!["r_spatial"], 0));
    assert_eq!(
        plan.phases,
        [PhaseKind::Spatial],
        "nothing is left to fit on"
    );
    let fit = Subject::Fit(Field::Prediction);
    let skip = plan
        .skipped
        .iter()
        .find(|skip| skip.subject == fit)
        .expect("said");
    assert_eq!(skip.reason.to_string(), "a finished one was given");
}

#[test]
fn a_one_axis_transducer_narrows_accuracy_to_what_it_measures() {
    let plan = planned(SMALL, rig_of(sensor(), Axes::NORMAL));
    let mae = plan
        .metrics
        .iter()
        .find(|metric| metric.id == "mae")
        .expect("kept");
    assert_eq!(mae.channels, ["Px", "Py", "Pz", "Fz"]);
    let lost = Subject::Channel("Fx".into());
    let skip = plan
        .skipped
        .iter()
        .find(|skip| skip.subject == lost)
        .expect("said");
    assert!(skip.reason.to_string().contains("this one does not"));
}

#[test]
fn equal_presses_are_visited_once() {
    let plan = planned(SMALL, rig_of(sensor(), Axes::FORCE));
    // Three lights at three points, of which the first light is that of the held-out presses.
    assert_eq!(plan.presses_of(PhaseKind::LightSweep).count(), 9);
    let both = |press: &&PlannedPress| press.phases == [PhaseKind::Spatial, PhaseKind::LightSweep];
    assert_eq!(plan.presses.iter().filter(both).count(), 3);
    let mut ids: Vec<_> = plan.presses.iter().map(|press| press.id).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), plan.presses.len());
}

#[test]
fn one_unit_has_nobody_to_differ_from() {
    let text = SMALL.replace("units = [\"a\", \"b\"]\n", "");
    let plan = planned(&text, rig_of(sensor(), Axes::FORCE));
    assert_eq!(
        reason(&plan, "inter_sensor"),
        "needs `unit_id` ← needs two units of the sensor: the scene has one"
    );
}

#[test]
fn a_sensor_without_a_footprint_is_not_pressed() {
    let bare = SensorFacts {
        footprint: None,
        depth_max: Some(Millimetre(1.0)),
        ..sensor()
    };
    let plan = planned(SMALL, rig_of(bare, Axes::FORCE));
    assert!(plan.presses.is_empty());
    assert_eq!(
        reason(&plan, "sensitivity"),
        "the sensor's `footprint` is not declared"
    );
}

#[test]
fn a_recording_is_planned_by_what_it_holds() {
    let recording = RecordingInfo {
        fields: FieldSet::EMPTY
            .with(Field::Truth)
            .with(Field::Frame)
            .with(Field::Point),
        channels: Channels::new([Channel::PZ, Channel::FZ]).expect("two"),
        opaque: None,
        footprint: None,
        frame: None,
    };
    let text = SMALL.replace(
        "driver = \"test/gel\"\nunits = [\"a\", \"b\"]",
        "dataset = \"mine\"",
    );
    let plan = planned_as(&text, SourceInfo::Recording(recording), &paper_metrics());
    assert_eq!(ids(&plan), ["mae", "intrinsic"]);
    assert_eq!(reason(&plan, "hysteresis"), "no sample carries `phase`");
    assert_eq!(
        reason(&plan, "sensitivity"),
        "nothing is scored on a channel `Px`"
    );
    assert!(plan.phases.is_empty() && plan.presses.is_empty());
    assert_eq!(plan.fits.len(), 1);
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
fn metrics_are_told_of_the_sensor_what_the_plan_knows() {
    let facts = planned(SMALL, rig_of(sensor(), Axes::FORCE)).sensor_facts();
    assert_eq!(
        (facts.opaque, facts.frame_size),
        (Some(false), Some([64, 48]))
    );
    assert_eq!(facts.reference_scene, "normal");
    let depth = facts.footprint.and_then(|footprint| footprint.depth_max());
    assert_eq!(depth, Some(taceva_core::Nanometre(1_000_000)));
}
