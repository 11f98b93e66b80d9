//! Tests of runs on the simulated rig, one property each.

mod bench;
mod conduct;
mod depth;
mod operator;
mod seeds;
mod wear;

use std::collections::BTreeSet;

use taceva_core::{Deadline, DriverError, ErrorKind, Limit, Millimetre, Phase, Sample, Specimen};

use self::bench::{Bench, HARD, Memory, SOFT};
use super::devices::{SimulatedForce, SimulatedRobot, SimulatedSensor};
use super::fault::{FaultKind, Faults};
use super::gel::Gel;
use taceva_protocol::ContentId;
use taceva_protocol::Motion;
use taceva_protocol::{
    Controls, Devices, Event, Left, Mode, PressLog, PressRecord, RunSpec, SpecimenChanger,
    StopCause, Timekeeper, run,
};

#[test]
fn a_whole_run_makes_every_press_once_and_leaves_the_tip_above_the_gel() {
    let mut bench = Bench::new(SOFT);
    let mut log = Memory::default();
    let report = bench.run(Mode::Acquire, &mut log).expect("no faults");
    let presses = bench.plan.presses.len();
    assert_eq!(
        (report.made, report.resumed, report.limited),
        (presses, 0, 0)
    );
    let made: BTreeSet<ContentId> = log.records.iter().map(|record| record.press).collect();
    assert_eq!(made.len(), presses);
    assert_eq!(report.samples as u64, bench.plan.cost.samples);
    assert!(bench.height() <= -bench.plan.contact.clearance_mm.value);
    let seconds = bench.shared.now_s();
    let estimate = bench.plan.cost.minutes * 60.0;
    assert!(
        (0.5..2.0).contains(&(seconds / estimate)),
        "{seconds} s, estimated {estimate} s"
    );
}

#[test]
fn the_untouched_gel_is_seen_before_the_first_press_and_again_only_if_that_is_made_again() {
    let mut bench = Bench::new(SOFT);
    let mut log = Memory::default();
    bench.run(Mode::Acquire, &mut log).expect("no faults");
    assert_eq!(log.untouched.len(), 1);
    bench.run(Mode::Acquire, &mut log).expect("nothing to do");
    assert_eq!(log.untouched.len(), 1);
    log.records.remove(0);
    bench.run(Mode::Acquire, &mut log).expect("the first again");
    assert_eq!(log.untouched.len(), 2);
    let rehearsal = Mode::Rehearse {
        height: Millimetre(20.0),
    };
    let mut nothing = Memory::default();
    bench.run(rehearsal, &mut nothing).expect("in the air");
    assert!(nothing.untouched.is_empty());
}

#[test]
fn finished_presses_are_skipped_and_the_rest_is_made() {
    let mut bench = Bench::new(SOFT);
    let mut log = Memory {
        full_after: Some(2),
        ..Memory::default()
    };
    let error = bench.run(Mode::Acquire, &mut log).expect_err("full");
    assert!(matches!(error.cause, StopCause::Log(_)) && error.left == Left::Clear);
    let unfinished = error.press.expect("one was lost");
    assert!(!log.is_finished(unfinished));
    assert!(error.to_string().contains("no space left"), "{error}");
    log.full_after = None;
    let report = bench.run(Mode::Acquire, &mut log).expect("space again");
    assert_eq!(
        (report.resumed, report.made),
        (2, bench.plan.presses.len() - 2)
    );
    let again = bench.run(Mode::Acquire, &mut log).expect("nothing to do");
    assert_eq!((again.resumed, again.made), (bench.plan.presses.len(), 0));
}

#[test]
fn a_press_that_reaches_the_limit_of_force_ends_there_and_the_run_goes_on() {
    let mut bench = Bench::new(HARD);
    let mut log = Memory::default();
    let report = bench
        .run(Mode::Acquire, &mut log)
        .expect("limits are no faults");
    assert!(report.limited > 0);
    assert_eq!(report.made, bench.plan.presses.len());
    let limited = log
        .records
        .iter()
        .filter(|record| record.outcome.is_limited());
    let of_plan = |record: &PressRecord| {
        let mut presses = bench.plan.presses.iter();
        presses
            .find(|press| press.id == record.press)
            .expect("planned")
    };
    let depth = bench.plan.channels.iter().position(|name| name == "Pz");
    let depth = depth.expect("depth is recorded");
    let most_mm = HARD.normal_max_n / HARD.stiffness_n_mm;
    for record in limited {
        let waypoints = of_plan(record).press.waypoints();
        for (sample, next) in record.samples.iter().zip(record.samples.iter().skip(1)) {
            assert!(sample.stamp.expect("stamped").valid_s < next.stamp.expect("stamped").valid_s);
        }
        let at_limit = |sample: &&Sample| sample.limited_by == Some(Limit::NormalForce);
        let stopped: Vec<&Sample> = record.samples.iter().filter(at_limit).collect();
        let comes_out = waypoints
            .iter()
            .any(|waypoint| waypoint.phase == Phase::Unload);
        assert_eq!(stopped.len(), if comes_out { 2 } else { 1 }, "{record:?}");
        for sample in stopped {
            let depth_mm = sample.truth.get(depth).expect("measured");
            // Contact is detected up to a step late, and the tip was withdrawn by at most two segments.
            assert!(
                (most_mm - 0.14..most_mm + 0.001).contains(&depth_mm),
                "{depth_mm}"
            );
            assert!(sample.depth_step.is_none() && sample.phase.is_some());
            assert!(sample.frame.is_some() == of_plan(record).frames);
        }
        let out = record.samples.iter();
        let out = out
            .filter(|sample| sample.phase == Some(Phase::Unload))
            .count();
        assert_eq!(2 * out, if comes_out { record.samples.len() } else { 0 });
    }
    assert_eq!(bench.shared.world().oracle.violations, []);
    let halted = bench
        .events
        .iter()
        .filter(|event| matches!(event, Event::Halted(_)));
    assert!(halted.count() >= report.limited);
}

#[test]
fn a_force_that_comes_late_costs_time_and_no_way() {
    let mut bench = Bench::new(Gel {
        noise_n: 0.000_1,
        ..HARD
    });
    bench.shared.world().faults = Faults::always(FaultKind::SlowLink);
    let mut log = Memory::default();
    let report = bench
        .run(Mode::Acquire, &mut log)
        .expect("slow is not a fault");
    assert!(report.limited > 0);
    assert_eq!(bench.shared.world().oracle.violations, []);
    let checks = bench.shared.world().oracle.checks;
    assert!(checks.greatest_force > 0.97, "{checks:?}");
}

#[test]
fn cancel_leaves_the_tip_above_the_gel() {
    let mut bench = Bench::new(SOFT);
    bench.cancel.cancel();
    let error = bench
        .run(Mode::Acquire, &mut Memory::default())
        .expect_err("cancelled");
    assert!(matches!(error.cause, StopCause::Cancelled));
    assert_eq!(error.left, Left::Clear);
    assert!(bench.height() <= -0.5);
}

#[test]
fn a_rehearsal_visits_every_place_touches_nothing_and_records_nothing() {
    let mut bench = Bench::new(SOFT);
    let mut log = Memory::default();
    let height = Millimetre(20.0);
    let report = bench.run(Mode::Rehearse { height }, &mut log).expect("air");
    assert_eq!((report.made, report.samples), (bench.plan.presses.len(), 0));
    assert!(log.records.is_empty());
    assert!(bench.height() < -19.0);
    let world = bench.shared.world();
    assert!(
        world.oracle.checks.greatest_force <= 0.0,
        "never in contact"
    );
}

#[test]
fn a_rehearsal_goes_as_far_above_the_height_of_travel_as_it_is_asked_to() {
    let mut bench = Bench::new(SOFT);
    // Presses without waypoints leave the tip at its first position.
    let presses = &mut bench.plan.presses;
    presses.retain(|press| matches!(press.press.motion, Motion::Rest { .. }));
    assert!(!bench.plan.presses.is_empty());
    let height = Millimetre(20.0);
    let rehearsal = Mode::Rehearse { height };
    bench
        .run(rehearsal, &mut Memory::default())
        .expect("in the air");
    let travel = -bench.plan.contact.clearance_mm.value;
    assert!((bench.height() - (travel - 20.0)).abs() < 1e-9);
}

#[test]
fn a_gel_that_is_not_there_is_searched_for_and_left() {
    let mut bench = Bench::new(SOFT);
    bench.shared.world().gel.stiffness_n_mm = 1e-9;
    let mut log = Memory::default();
    let report = bench
        .run(Mode::Acquire, &mut log)
        .expect("nothing touched is not a fault");
    let searched = bench.plan.presses.iter();
    let searched = searched.filter(|press| !matches!(press.press.motion, Motion::Rest { .. }));
    assert_eq!(report.without_contact, searched.count());
}

#[test]
fn a_unit_that_the_plan_does_not_name_is_refused() {
    let mut bench = Bench::new(SOFT);
    let error = bench
        .run_unit("9", Mode::Acquire, &mut Memory::default())
        .expect_err("unknown");
    assert_eq!(
        error.to_string(),
        "the plan needs unit `9` in its list of units"
    );
}

#[test]
fn a_plan_with_pictures_is_not_run_without_a_sensor() {
    let bench = Bench::new(SOFT);
    let (mut robot, mut force) = (
        SimulatedRobot(bench.shared.clone()),
        SimulatedForce::new(bench.shared.clone()),
    );
    let mut clock = bench.shared.clone();
    let spec = RunSpec {
        plan: &bench.plan,
        unit: &bench.plan.units[0],
        mode: Mode::Acquire,
    };
    let devices = Devices {
        robot: &mut robot,
        force: &mut force,
        sensor: None,
        lighting: None,
        specimens: None,
    };
    let controls = Controls {
        clock: &mut clock,
        cancel: &bench.cancel,
        events: &mut |_| {},
        operator: None,
    };
    let error = run(&spec, devices, &mut Memory::default(), controls).expect_err("blind");
    assert_eq!(
        error.to_string(),
        "the plan needs a sensor for its pictures"
    );
}

#[test]
fn frames_that_never_come_stop_the_run_with_the_tip_above_the_gel() {
    let mut bench = Bench::new(SOFT);
    bench.shared.world().faults = Faults::always(FaultKind::DroppedFrames);
    let error = bench
        .run(Mode::Acquire, &mut Memory::default())
        .expect_err("blind");
    assert!(matches!(error.cause, StopCause::Frames { .. }), "{error}");
    assert_eq!(error.left, Left::Clear);
}

#[test]
fn a_transducer_that_stays_silent_leaves_the_tip_where_it_is() {
    let mut bench = Bench::new(SOFT);
    // The fault begins in the first press that touches the gel.
    bench.shared.world().faults = Faults::from(FaultKind::Silence, 8.0);
    let error = bench
        .run(Mode::Acquire, &mut Memory::default())
        .expect_err("deaf");
    assert!(matches!(error.cause, StopCause::Tripped(_)), "{error}");
    assert_eq!(error.left, Left::InPlace);
    assert!(bench.shared.world().halted, "nobody moves blind");
    assert!(
        error.to_string().contains("the tip stays where it is"),
        "{error}"
    );
}

struct NoBoards;

impl SpecimenChanger for NoBoards {
    fn mount(&mut self, specimen: Specimen, _: Deadline) -> Result<(), DriverError> {
        let key = taceva_core::DriverKey::fixed("test/boards");
        Err(DriverError::new(
            ErrorKind::NotFound,
            &key,
            format!("mount a {specimen}"),
        ))
    }
}

#[test]
fn a_specimen_that_cannot_be_mounted_stops_the_run_in_the_air() {
    let bench = Bench::new(SOFT);
    let (mut robot, mut force, mut sensor) = (
        SimulatedRobot(bench.shared.clone()),
        SimulatedForce::new(bench.shared.clone()),
        SimulatedSensor(bench.shared.clone()),
    );
    let mut clock = bench.shared.clone();
    let spec = RunSpec {
        plan: &bench.plan,
        unit: &bench.plan.units[0],
        mode: Mode::Acquire,
    };
    let devices = Devices {
        robot: &mut robot,
        force: &mut force,
        sensor: Some(&mut sensor),
        lighting: None,
        specimens: Some(&mut NoBoards),
    };
    let controls = Controls {
        clock: &mut clock,
        cancel: &bench.cancel,
        events: &mut |_| {},
        operator: None,
    };
    let error = run(&spec, devices, &mut Memory::default(), controls).expect_err("no board");
    assert!(
        error
            .to_string()
            .starts_with("test/boards: cannot mount a sphere of radius 2 mm"),
        "{error}"
    );
}
