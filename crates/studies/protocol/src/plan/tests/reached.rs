//! Tests that a scene, a rig or a recording can cause every reason, with the right subject.

use std::collections::BTreeSet;

use taceva_core::{Axes, Channel, Channels, Field, FieldSet, Millimetre, SensorFacts, SkipReason};

use super::bench::{SMALL, paper_metrics, rig_of, sensor};
use super::{only, planned, planned_as};
use crate::phase_kind::PhaseKind;
use crate::plan::{MetricNeeds, Plan};
use crate::reason::{Cause, PlanReason, Subject};
use crate::source::{RecordingInfo, RigInfo, SourceInfo};

fn whole() -> RigInfo {
    rig_of(sensor(), Axes::FORCE)
}

fn with_sensor(sensor: SensorFacts) -> Plan {
    planned(SMALL, rig_of(sensor, Axes::FORCE))
}

/// Plan of a scene with only the metrics `kept`.
fn of(kept: &[&str]) -> Plan {
    planned_as(SMALL, SourceInfo::Rig(Box::new(whole())), &only(kept))
}

fn of_recording(fields: FieldSet, channels: &[Channel], needs: &[MetricNeeds]) -> Plan {
    let recording = RecordingInfo {
        fields,
        channels: Channels::new(channels.iter().cloned()).expect("different"),
        opaque: None,
        footprint: None,
        frame: None,
    };
    let text = SMALL.replace(
        "driver = \"test/gel\"\nunits = [\"a\", \"b\"]",
        "dataset = \"mine\"",
    );
    planned_as(&text, SourceInfo::Recording(recording), needs)
}

/// Reason why `plan` skips `subject`.
fn reason(plan: &Plan, subject: &Subject) -> Option<PlanReason> {
    let skip = plan.skipped.iter().find(|skip| skip.subject == *subject)?;
    Some(skip.reason.clone())
}

fn metric(id: &str) -> Subject {
    Subject::Metric(id.to_owned())
}

fn channel(name: &str) -> Subject {
    Subject::Channel(name.to_owned())
}

fn unresolved(field: Field, cause: Cause) -> PlanReason {
    PlanReason::Unresolved { field, cause }
}

fn unmeasured(name: &str, cause: Cause) -> PlanReason {
    PlanReason::Unmeasured {
        channel: name.to_owned(),
        cause,
    }
}

/// Plans, each with a skipped subject and its reason.
fn scenes() -> Vec<(Plan, Subject, PlanReason)> {
    use PlanReason::{NoMarkers, NoMetricNeeds, Skip, VisitedBy};
    use SkipReason::{
        AlreadyThere, ChannelAbsent, FactAbsent, FieldAbsent, GelIsOpaque, NotWanted,
    };

    let pair = FieldSet::EMPTY.with(Field::Truth).with(Field::Frame);
    let without = |take: fn(&mut RigInfo)| {
        let mut rig = whole();
        take(&mut rig);
        planned(SMALL, rig)
    };
    let blind = || {
        without(|rig| {
            rig.sensor = None;
            rig.robot = None;
        })
    };
    let no_robot = || without(|rig| rig.robot = None);
    let no_model = SMALL.replace("[model]\nname = \"ridge\"\n", "");
    let finished = SMALL.replace("name = \"ridge\"", "file = \"my.model\"");
    let one_unit = SMALL.replace("units = [\"a\", \"b\"]\n", "");
    let one_light = format!("{SMALL}[lighting]\nscenes = [\"S1\"]\n");
    let one_light = one_light.replace("[lighting]", "[lighting]\ndriver = \"test/light\"");
    let wanted = format!("{SMALL}[metrics]\nwant = [\"mae\"]\n");
    let few = |text: &str| planned(text, whole());
    vec![
        (few(&wanted), metric("hysteresis"), Skip(NotWanted)),
        (
            with_sensor(sensor().with_opaque(true)),
            metric("r_light"),
            Skip(GelIsOpaque),
        ),
        (
            with_sensor(sensor().with_markers(false)),
            metric("repeatability (Fx, Fy)"),
            NoMarkers,
        ),
        (
            with_sensor(
                sensor()
                    .with_footprint(None)
                    .with_depth_max(Millimetre(1.0)),
            ),
            metric("mae"),
            Skip(FactAbsent("footprint")),
        ),
        (
            of_recording(pair.without(Field::Frame), &[Channel::PZ], &only(&["mae"])),
            metric("mae"),
            Skip(FieldAbsent(Field::Frame)),
        ),
        (
            of_recording(pair, &[Channel::FZ], &only(&["sensitivity"])),
            metric("sensitivity"),
            Skip(ChannelAbsent("Px".to_owned())),
        ),
        (
            few(&finished),
            Subject::Fit(Field::Prediction),
            Skip(AlreadyThere),
        ),
        (
            few(&finished),
            metric("sr"),
            unresolved(Field::PredictedSpacing, Cause::NoEstimator),
        ),
        (
            few(&no_model),
            metric("mae"),
            unresolved(Field::Prediction, Cause::NoModel),
        ),
        (
            blind(),
            metric("mae"),
            unresolved(Field::Prediction, Cause::NoSensor),
        ),
        (
            blind(),
            metric("intrinsic"),
            unresolved(Field::Frame, Cause::NoSensor),
        ),
        (
            no_robot(),
            metric("hysteresis"),
            unresolved(Field::Phase, Cause::NoRobot),
        ),
        (no_robot(), channel("Px"), unmeasured("Px", Cause::NoRobot)),
        (
            without(|rig| rig.force = None),
            channel("Fz"),
            unmeasured("Fz", Cause::NoForce),
        ),
        (
            planned(SMALL, rig_of(sensor(), Axes::NORMAL)),
            channel("Fy"),
            unmeasured("Fy", Cause::NoAxis),
        ),
        (
            without(|rig| rig.lighting = None),
            metric("r_light"),
            unresolved(Field::Scene, Cause::NoLighting),
        ),
        (
            few(&one_light),
            metric("r_light"),
            unresolved(Field::Scene, Cause::OneLight),
        ),
        (
            few(&one_unit),
            metric("inter_sensor"),
            unresolved(Field::UnitId, Cause::OneUnit),
        ),
        (
            of(&["hysteresis"]),
            Subject::Fit(Field::Prediction),
            NoMetricNeeds,
        ),
        (
            of(&["hysteresis"]),
            Subject::Phase(PhaseKind::Spatial),
            NoMetricNeeds,
        ),
        (
            of(&["hysteresis"]),
            Subject::Field(Field::Repeat),
            NoMetricNeeds,
        ),
        (of(&["hysteresis"]), channel("surface_z"), NoMetricNeeds),
        (
            planned_as(SMALL, SourceInfo::Rig(Box::new(whole())), &paper_metrics()),
            Subject::Phase(PhaseKind::LightSweep),
            VisitedBy {
                phase: PhaseKind::Spatial,
                presses: 3,
            },
        ),
    ]
}

#[test]
fn each_scene_that_lacks_something_gets_the_reason() {
    for (plan, subject, expected) in scenes() {
        let found = reason(&plan, &subject);
        assert_eq!(found, Some(expected), "{subject}\n{plan}");
    }
}

/// Kind of a reason, without its subject.
fn kind(reason: &PlanReason) -> String {
    match reason {
        PlanReason::Skip(skip) => {
            let whole = format!("{skip:?}");
            whole.split('(').next().unwrap_or_default().to_owned()
        }
        PlanReason::Unresolved { cause, .. } | PlanReason::Unmeasured { cause, .. } => {
            format!("{cause:?}")
        }
        PlanReason::NoMarkers => "NoMarkers".to_owned(),
        PlanReason::NoMetricNeeds => "NoMetricNeeds".to_owned(),
        PlanReason::VisitedBy { .. } => "VisitedBy".to_owned(),
    }
}

#[test]
fn no_reason_of_the_planner_is_without_a_scene_that_reaches_it() {
    let reached: BTreeSet<String> = scenes().iter().map(|(.., reason)| kind(reason)).collect();
    let mut all: BTreeSet<String> = PlanReason::all().iter().map(kind).collect();
    // Reason of a metric that was skipped without a reason, which never happens.
    all.remove(&format!("{:?}", SkipReason::NothingReadsIt));
    // Reason in the check of a recording, never in a plan.
    all.remove("NoSplit");
    assert_eq!(reached, all);
}
