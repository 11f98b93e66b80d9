//! Tests of the skipped parts of a plan and their reasons.

use super::*;

#[test]
fn an_opaque_gel_skips_lighting_and_says_why() {
    let opaque = sensor().with_opaque(true);
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
    let bare = sensor().with_markers(false);
    let plan = planned(SMALL, rig_of(bare, Axes::FORCE));
    let metric = plan
        .metrics
        .iter()
        .find(|metric| metric.id == "repeatability");
    assert_eq!(metric.expect("kept").channels, ["Px", "Py", "Pz", "Fz"]);
    assert!(
        reason(&plan, "repeatability (Fx, Fy)").starts_with("shear repeatability applies only")
    );
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
fn loading_and_unloading_take_pictures_on_request_if_a_model_predicts() {
    let rig = || SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let text = SMALL.replace(
        "hysteresis = { points = 2 }",
        "hysteresis = { points = 2, predicted = true }",
    );
    let plan = planned_as(&text, rig(), &only(&["mae", "hysteresis"]));
    assert!(plan.presses_of(PhaseKind::LoadUnload).count() > 0);
    assert!(plan.presses.iter().all(|press| press.frames));
    let blind = planned_as(&text, rig(), &only(&["sensitivity", "hysteresis"]));
    assert!(blind.presses.iter().all(|press| !press.frames));
}

#[test]
fn presses_are_repeated_on_every_unit_on_request() {
    let rig = || SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let text = SMALL.replace("trials = 3,", "trials = 3, every_unit = true,");
    let wanted = only(&["repeatability"]);
    let [one, every] = [SMALL, text.as_str()].map(|text| planned_as(text, rig(), &wanted));
    let count = |plan: &Plan, unit: &str| {
        let presses = plan.presses_of(PhaseKind::Repeatability);
        presses.filter(|press| press.press.unit == unit).count()
    };
    assert_eq!([count(&one, "a"), count(&one, "b")], [6, 0]);
    assert_eq!([count(&every, "a"), count(&every, "b")], [6, 6]);
    assert!(every.presses.iter().all(|press| press.frames));
    assert!(every.fields.contains(Field::UnitId) && !one.fields.contains(Field::UnitId));
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
    assert_eq!(skip.reason.to_string(), "a finished result was given");
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
    assert!(
        skip.reason
            .to_string()
            .contains("the transducer of the scene does not")
    );
}

#[test]
fn equal_presses_are_visited_once() {
    let plan = planned(SMALL, rig_of(sensor(), Axes::FORCE));
    // Three lights at three points. The first light is that of the held-out presses.
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
    let bare = sensor()
        .with_footprint(None)
        .with_depth_max(Millimetre(1.0));
    let plan = planned(SMALL, rig_of(bare, Axes::FORCE));
    assert!(plan.presses.is_empty());
    assert_eq!(
        reason(&plan, "sensitivity"),
        "the sensor's `footprint` is not declared: write `footprint = { shape = \"disc\", radius_mm = … }` or \
         `footprint = { shape = \"rect\", half_x_mm = …, half_y_mm = … }` under [sensor] of the scene or of the rig file"
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
    assert_eq!(reason(&plan, "sensitivity"), "channel `Px` is not scored");
    assert!(plan.phases.is_empty() && plan.presses.is_empty());
    assert_eq!(plan.fits.len(), 1);
}
