//! Tests of explained plans, rejected plans and plans without frames.

use taceva_core::{
    Axes, Descriptor, DescriptorSpec, DriverKey, DriverSource, Facts, Field, FieldSet, Millimetre,
    Point, RobotFacts, SensorFacts, Workspace,
};

use super::bench::{SMALL, rig_of, sensor};
use super::{only, planned_as};
use crate::phase_kind::PhaseKind;
use crate::plan::{MetricNeeds, plan};
use crate::scene::Scene;
use crate::source::SourceInfo;

fn whole() -> SourceInfo {
    SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)))
}

#[test]
fn a_metric_that_is_named_and_cannot_be_is_refused_though_others_can() {
    let opaque = sensor().with_opaque(true);
    let refusal = |want: &str, sensor: &SensorFacts| {
        let text = format!("{SMALL}[metrics]\nwant = {want}\n");
        let scene = Scene::parse("small", &text).expect("a scene");
        let rig = || SourceInfo::Rig(Box::new(rig_of(sensor.clone(), Axes::FORCE)));
        plan(&scene, |_| rig()).err().map(|error| error.to_string())
    };
    let said = refusal("[\"mae\", \"r_light\"]", &opaque).expect("light needs a clear gel");
    assert!(
        said.contains("`r_light`") && said.contains("the gel is opaque"),
        "{said}"
    );
    assert_eq!(refusal("[\"mae\", \"r_light\"]", &sensor()), None);
    assert_eq!(refusal("[\"mae\"]", &opaque), None);
}

#[test]
fn one_of_two_fields_is_enough_to_say_which_presses_a_metric_is_of() {
    for (field, phase) in [
        (Field::Spacing, PhaseKind::Gratings),
        (Field::Kind, PhaseKind::Gratings),
        (Field::Scene, PhaseKind::LightSweep),
        (Field::Intensity, PhaseKind::LightSweep),
        (Field::Repeat, PhaseKind::Repeatability),
        (Field::DepthStep, PhaseKind::Repeatability),
        (Field::Phase, PhaseKind::LoadUnload),
        (Field::UnitId, PhaseKind::SurfaceMap),
    ] {
        let needs = MetricNeeds::new("of_one_field", FieldSet::PAIRS.with(field), &[]);
        let plan = planned_as(SMALL, whole(), &[needs]);
        let phases: Vec<PhaseKind> = plan.metrics.iter().map(|metric| metric.phase).collect();
        assert_eq!(phases, [phase], "{field}");
    }
}

#[test]
fn pictures_are_counted_where_some_are_taken_and_not_spoken_of_where_none_is() {
    let blind = planned_as(SMALL, whole(), &only(&["sensitivity", "hysteresis"]));
    assert_eq!(blind.cost.frames, 0);
    let said = blind.to_string();
    assert!(
        !said.contains(" 0 frames") && said.contains("    frames are not captured"),
        "{said}"
    );
    let seeing = planned_as(SMALL, whole(), &only(&["mae"]));
    let counted = format!(", {} frames", seeing.cost.frames);
    assert!(seeing.to_string().contains(&counted), "{seeing}");
}

#[test]
fn the_skill_that_nobody_asked_for_is_named_where_predictions_are_read_and_not_elsewhere() {
    let line = "add   metric  skill";
    for (want, is_added) in [
        (&["noise_equivalent_force"][..], true),
        (&["mae"], true),
        (&["mae", "skill"], false),
        (&["sensitivity"], false),
    ] {
        let catalogue = MetricNeeds::catalogue().into_iter();
        let wanted = catalogue.filter(|needs| want.contains(&needs.id.as_str()));
        let plan = planned_as(SMALL, whole(), &wanted.collect::<Vec<_>>());
        assert_eq!(
            plan.to_string().contains(line),
            is_added,
            "{want:?}\n{plan}"
        );
        let json = serde_json::to_value(&plan).expect("an object");
        assert_eq!(json.get("added_metrics").is_some(), is_added, "{want:?}");
    }
}

/// A robot with the given `workspace`.
fn reaching(workspace: Workspace) -> Option<Descriptor> {
    let key = DriverKey::fixed("test/robot");
    let facts = Facts::Robot(RobotFacts::default().with_workspace(workspace));
    let spec = DescriptorSpec::new(key, "a robot", DriverSource::Simulated, facts);
    Some(spec.check().expect("no contradiction"))
}

#[test]
fn a_robot_that_just_reaches_the_whole_surface_will_do_and_one_of_a_micrometre_less_on_any_side_will_not()
 {
    let scene = Scene::parse("small", SMALL).expect("a scene");
    let contact = &scene.protocol.contact;
    let (up, down) = (contact.clearance_mm.value, contact.search_mm.value);
    let refusal = |tightened: usize| {
        let part = |side: usize, length: f64| match side == tightened {
            true => Millimetre(length - 0.001),
            false => Millimetre(length),
        };
        let negative = |side: usize, length: f64| Millimetre(-part(side, length).0);
        let workspace = Workspace {
            least: Point {
                x: negative(0, 8.0),
                y: negative(1, 10.0),
                z: negative(2, up),
            },
            greatest: Point {
                x: part(3, 8.0),
                y: part(4, 10.0),
                z: part(5, down),
            },
        };
        let mut rig = rig_of(sensor(), Axes::FORCE);
        rig.robot = reaching(workspace);
        let source = SourceInfo::Rig(Box::new(rig));
        let planned = plan(&scene, |_| source.clone());
        planned.err().map(|error| error.to_string())
    };
    for side in 0..6 {
        let said = refusal(side).unwrap_or_default();
        assert!(
            said.contains("the robot `test/robot` does not reach ("),
            "{side}: {said}"
        );
    }
    assert_eq!(refusal(6), None);
}
