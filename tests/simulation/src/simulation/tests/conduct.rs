//! Tests of signals as a real rig has them: noisy poses, temporary gaps in readings, and a robot that stops by itself.

use std::collections::BTreeSet;
use std::ops::Range;

use taceva_core::{Fault, Frame, Nanometre};

use super::bench::{Bench, Memory, SOFT};
use crate::simulation::fault::{FaultKind, Faults};
use crate::simulation::gel::Gel;
use crate::simulation::scenario::planned_scene;
use taceva_protocol::Signals;
use taceva_protocol::{DepthOrigin, DepthZero, ZeroUnknown};
use taceva_protocol::{Event, Left, Mode, RunError, RunReport, StopCause, Trip};
use taceva_protocol::{Motion, Plan, PlannedPress};

/// Gel of a rig whose robot reports its pose with uniform noise of ±0.05 mm per axis.
const JITTERED: Gel = Gel {
    pose_noise_mm: 0.05,
    ..SOFT
};

const SCENE: &str = r#"
scene_version = 1
name = "jittered"
sensor = { driver = "faults/sensor" }
robot = { driver = "faults/robot" }
force = { driver = "faults/force" }
model = { name = "ridge" }
[protocol]
contact = { clearance_mm = 0.5, search_mm = 1.0 }
calibration = { points = 120, indentations = 4 }
hysteresis = { points = 100, depth_step_mm = 0.4 }
"#;

/// Plan of 200 presses without pictures, on the gel [`JITTERED`].
fn plan() -> Plan {
    let mut plan = planned_scene(SCENE, 1, &JITTERED).expect("a plan");
    assert!(plan.presses.len() >= 200, "{}", plan.presses.len());
    plan.presses.truncate(200);
    for press in &mut plan.presses {
        press.frames = false;
    }
    plan
}

fn is_halt(event: &&Event) -> bool {
    matches!(event, Event::Halted(_) | Event::Redone { .. })
}

#[test]
fn a_robot_whose_pose_jitters_makes_two_hundred_presses_without_a_false_halt() {
    let mut bench = Bench::with(JITTERED, plan());
    let mut log = Memory::default();
    let report = bench
        .run(Mode::Acquire, &mut log)
        .expect("noise is not a fault");
    assert_eq!((report.made, report.limited, report.redone), (200, 0, 0));
    assert_eq!(bench.events.iter().find(is_halt), None);
    assert_eq!(bench.shared.world().oracle.violations, []);
}

#[test]
fn the_same_robot_is_halted_without_allowance_for_its_noise() {
    let mut plan = plan();
    let limits = plan.limits.as_mut().expect("it moves");
    limits.signals = Signals::default();
    let still = planned_scene(SCENE, 1, &SOFT).expect("a plan");
    limits.overshoot = still.limits.expect("limits").overshoot;
    let mut bench = Bench::with(JITTERED, plan);
    let mut log = Memory::default();
    let error = bench
        .run(Mode::Acquire, &mut log)
        .expect_err("a false halt");
    assert!(
        matches!(error.cause, StopCause::Workspace { .. }),
        "{error}"
    );
    assert_eq!(log.records.len(), 0);
}

#[test]
fn by_default_depths_count_from_the_first_contact_and_no_uncertainty_is_stated() {
    let mut plan = planned_scene(SCENE, 1, &SOFT).expect("a plan");
    plan.presses.truncate(20);
    let mut bench = Bench::with(SOFT, plan);
    let mut log = Memory::default();
    bench.run(Mode::Acquire, &mut log).expect("no faults");
    let records = log.records.iter();
    let zeros: Vec<DepthZero> = records.filter_map(|record| record.zero).collect();
    assert!(!zeros.is_empty());
    for zero in zeros {
        assert_eq!(zero.uncertainty, Err(ZeroUnknown::CountedFromContact));
    }
    let mut samples = log.records.iter().flat_map(|record| &record.samples);
    assert!(samples.all(|sample| sample.zero_u_mm.is_none()));
}

#[test]
fn fitted_depths_count_from_the_uneven_surface_within_the_uncertainty_that_is_stated() {
    let mut plan = planned_scene(SCENE, 1, &SOFT).expect("a plan");
    plan.contact.depth_from.value = DepthOrigin::Surface;
    plan.presses.truncate(100);
    for press in &mut plan.presses {
        press.frames = false;
    }
    let mut bench = Bench::with(SOFT, plan);
    let mut log = Memory::default();
    bench.run(Mode::Acquire, &mut log).expect("no faults");
    let (mut zeros, mut sum_mm, mut held) = (0.0, 0.0, 0.0);
    for record in &log.records {
        let Some(zero) = record.zero else { continue };
        let mut presses = bench.plan.presses.iter();
        let planned = presses.find(|press| press.id == record.press);
        let place = planned.expect("it was planned").press.place;
        let surface_mm = bench
            .shared
            .world()
            .surface(place.map(Nanometre::to_millimetres));
        let error_mm = zero.height.0 - surface_mm;
        let deviation = zero.uncertainty.expect("readings enough");
        zeros += 1.0;
        sum_mm += error_mm;
        held += f64::from(u8::from(error_mm.abs() <= 1.96 * deviation.0));
        let stated = Some(deviation.0);
        assert!(
            record
                .samples
                .iter()
                .all(|sample| sample.zero_u_mm == stated)
        );
    }
    assert!(zeros > 50.0, "{zeros}");
    assert!((sum_mm / zeros).abs() < 0.012, "{}", sum_mm / zeros);
    assert!(held / zeros >= 0.93, "{}", held / zeros);
    assert_eq!(bench.shared.world().oracle.violations, []);
}

/// A bench whose transducer is silent from `from_s` on, for `lasting_s`.
fn silent(from_s: f64, lasting_s: f64) -> Bench {
    let bench = Bench::new(SOFT);
    bench.shared.world().faults = Faults::between(FaultKind::Silence, from_s, from_s + lasting_s);
    bench
}

#[test]
fn a_press_that_silence_broke_off_is_made_again_and_recorded_once() {
    // The fault begins in the first press that touches the gel.
    let mut bench = silent(8.0, 0.2);
    let mut log = Memory::default();
    let report = bench.run(Mode::Acquire, &mut log).expect("it spoke again");
    let presses = bench.plan.presses.len();
    assert_eq!((report.made, report.redone), (presses, 1));
    assert_eq!(log.records.len(), presses);
    let stale = |event: &&Event| matches!(event, Event::Halted(Trip::StaleForce { .. }));
    assert_eq!(bench.events.iter().filter(stale).count(), 1);
    let redone = |event: &&Event| matches!(event, Event::Redone { times: 1, .. });
    assert_eq!(bench.events.iter().filter(redone).count(), 1);
    assert_eq!(bench.shared.world().oracle.violations, []);
}

#[test]
fn a_press_that_is_broken_off_three_times_ends_the_run() {
    let mut bench = Bench::new(SOFT);
    bench.shared.world().faults = Faults::always(FaultKind::DroppedFrames);
    let mut log = Memory::default();
    let error = bench.run(Mode::Acquire, &mut log).expect_err("blind");
    assert!(matches!(error.cause, StopCause::Frames { .. }), "{error}");
    let redone = |event: &&Event| matches!(event, Event::Redone { .. });
    assert_eq!(bench.events.iter().filter(redone).count(), 2);
}

/// Runs thirty presses with a camera that repeats frames during `captures`. Returns the bench, its log, and the result of the run. Capture 18 begins
/// a press.
fn frozen(captures: Range<u32>) -> (Bench, Memory, Result<RunReport, RunError>) {
    let mut plan = planned_scene(SCENE, 1, &SOFT).expect("a plan");
    let is_indent = |press: &PlannedPress| matches!(press.press.motion, Motion::Indent(_));
    plan.presses.retain(is_indent);
    plan.presses.truncate(30);
    let mut bench = Bench::with(SOFT, plan);
    bench.frozen = captures;
    let mut log = Memory::default();
    let done = bench.run(Mode::Acquire, &mut log);
    (bench, log, done)
}

/// True if no two recorded frames are equal.
fn are_distinct(log: &Memory) -> bool {
    let samples = log.records.iter().flat_map(|record| &record.samples);
    let frames: Vec<&Frame> = samples.filter_map(|sample| sample.frame.as_ref()).collect();
    let seen: BTreeSet<&[u8]> = frames.iter().map(|frame| frame.bytes()).collect();
    !frames.is_empty() && seen.len() == frames.len()
}

#[test]
fn a_camera_that_freezes_for_good_ends_the_run_above_the_gel_without_a_repeated_frame() {
    let (mut bench, mut log, done) = frozen(18..u32::MAX);
    let error = done.expect_err("blind");
    assert!(matches!(error.cause, StopCause::FrozenFrame), "{error}");
    assert_eq!(error.left, Left::Clear);
    assert!(bench.height() < 0.0);
    let frozen = |event: &&Event| matches!(event, Event::FrameFrozen);
    assert_eq!(bench.events.iter().filter(frozen).count(), 3);
    assert!(are_distinct(&log));
    bench.frozen = 0..0;
    bench.run(Mode::Acquire, &mut log).expect("it is restarted");
    assert_eq!(log.records.len(), 30);
    assert!(are_distinct(&log));
    assert_eq!(bench.shared.world().oracle.violations, []);
}

#[test]
fn a_camera_that_freezes_after_five_frames_ends_the_run_within_a_few_presses() {
    let (bench, log, done) = frozen(6..u32::MAX);
    let error = done.expect_err("blind");
    assert!(matches!(error.cause, StopCause::FrozenFrame), "{error}");
    assert!(bench.height() < 0.0);
    assert!(log.records.len() < 20, "{}", log.records.len());
}

#[test]
fn a_press_with_one_frozen_frame_is_broken_off_and_made_again() {
    let (bench, log, done) = frozen(18..19);
    let report = done.expect("it sees again");
    assert_eq!((report.made, report.redone), (30, 1));
    let frozen = |event: &&Event| matches!(event, Event::FrameFrozen);
    assert_eq!(bench.events.iter().filter(frozen).count(), 1);
    assert!(are_distinct(&log));
}

#[test]
fn twenty_presses_that_were_broken_off_end_the_run() {
    let mut bench = Bench::with(SOFT, planned_scene(SCENE, 1, &SOFT).expect("a plan"));
    for press in &mut bench.plan.presses {
        press.frames = false;
    }
    // The transducer is sometimes silent longer than allowed, but hardly ever twice in a press.
    bench.shared.world().faults = Faults::every(FaultKind::Silence, 40.0, 0.2);
    let mut log = Memory::default();
    let error = bench.run(Mode::Acquire, &mut log).expect_err("too often");
    assert!(error.cause.is_silence(), "{error}");
    let redone = |event: &&Event| matches!(event, Event::Redone { .. });
    assert!(bench.events.iter().filter(redone).count() <= 19);
    assert!(log.records.len() > 5, "it went on for a while");
}

#[test]
fn after_an_emergency_stop_nothing_is_asked_of_the_robot_and_the_error_says_what_to_do() {
    let mut bench = Bench::new(SOFT);
    bench.shared.world().faults = Faults::from(FaultKind::EmergencyStop, 8.0);
    let mut log = Memory::default();
    let error = bench.run(Mode::Acquire, &mut log).expect_err("stopped");
    assert_eq!(error.cause.fault(), Some(Fault::EmergencyStop));
    assert_eq!(error.left, Left::InPlace);
    let text = error.to_string();
    assert!(
        text.ends_with("inspect the rig, and acknowledge the emergency stop at the device"),
        "{text}"
    );
    // A second run does not clear it either.
    let again = bench
        .run(Mode::Acquire, &mut log)
        .expect_err("stopped still");
    assert_eq!(again.cause.fault(), Some(Fault::EmergencyStop));
    let mut world = bench.shared.world();
    assert_eq!(
        world.oracle.violations.len(),
        1,
        "the second run asked once: {:?}",
        world.oracle.violations
    );
    world.acknowledge();
    drop(world);
    let report = bench.run(Mode::Acquire, &mut log).expect("acknowledged");
    assert!(report.resumed + report.made == bench.plan.presses.len());
}
