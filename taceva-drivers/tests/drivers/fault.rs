//! Tests that each fault emulates failing hardware, is counted, and repeats with the same seed.

use std::time::Duration;

use crate::support::{PATIENCE, capture, folder, replay};
use crate::toy::{FULL_SCALE, Flaw, KEY, ToyFactory, open};
use taceva_core::{Deadline, ErrorKind, ForceTransducer, Pose, Robot, Sensor, Speed};
use taceva_drivers::VirtualPace;
use taceva_simulation::fault::{
    FaultKind, FaultPlan, FaultyForce, FaultyRobot, FaultySensor, Likelihood,
};

fn pace() -> Box<VirtualPace> {
    Box::new(VirtualPace::starting_at(0.0))
}

/// Stamps, in 0.1 s, and shades of five captures, with `kind` in captures number 1 and 2.
fn captures(kind: FaultKind) -> Vec<Option<(f64, u8)>> {
    let folder = folder(9);
    let plan = FaultPlan::none().during(kind, 1..3);
    let log = plan.log();
    let mut sensor = FaultySensor::new(replay(folder.path(), ";rate=10"), KEY, plan, pace());
    let frames = (0..5)
        .map(|_| capture(&mut sensor, PATIENCE).ok())
        .map(|frame| frame.map(|(stamp, shade)| ((stamp.valid_s * 10.0).round(), shade)))
        .collect();
    assert_eq!(log.count(kind), 2, "{kind}");
    frames
}

#[test]
fn a_sensor_goes_wrong_as_planned_and_recovers() {
    let whole = |frames: [(f64, u8); 5]| frames.map(Some).to_vec();
    let freeze = [(0.0, 1), (1.0, 1), (2.0, 1), (3.0, 4), (4.0, 5)];
    assert_eq!(captures(FaultKind::Freeze), whole(freeze));
    let saturated = [(0.0, 1), (1.0, 255), (2.0, 255), (3.0, 4), (4.0, 5)];
    assert_eq!(captures(FaultKind::Saturation), whole(saturated));
    let stale = [(0.0, 1), (0.0, 2), (0.0, 3), (3.0, 4), (4.0, 5)];
    assert_eq!(captures(FaultKind::StaleStamp), whole(stale));
    let dropped = [(0.0, 1), (2.0, 3), (4.0, 5), (5.0, 6), (6.0, 7)];
    assert_eq!(captures(FaultKind::Drop), whole(dropped));
    let late = [(0.0, 1), (1.0, 2), (2.0, 3), (3.0, 4), (4.0, 5)];
    assert_eq!(captures(FaultKind::SlowLink), whole(late));
    let silent = [Some((0.0, 1)), None, None, Some((1.0, 2)), Some((2.0, 3))];
    assert_eq!(captures(FaultKind::Silence), silent);
    let spoilt = captures(FaultKind::NotANumber);
    let is_nan = |frame: &Option<(f64, u8)>| frame.is_some_and(|(stamp, _)| stamp.is_nan());
    assert!(is_nan(&spoilt[1]) && is_nan(&spoilt[2]) && !is_nan(&spoilt[3]));
}

#[test]
fn a_link_slower_than_the_deadline_times_out() {
    let folder = folder(3);
    let plan = FaultPlan::none()
        .during(FaultKind::SlowLink, 0..2)
        .delay(Duration::from_millis(50));
    let mut sensor = FaultySensor::new(replay(folder.path(), ""), KEY, plan, pace());
    let error = capture(&mut sensor, Deadline::after(Duration::from_millis(49))).expect_err("late");
    assert_eq!(error.kind(), ErrorKind::Timeout);
    assert_eq!(
        error.to_string(),
        "test/toy: cannot capture a frame: no answer within 49ms"
    );
    capture(&mut sensor, Deadline::after(Duration::from_millis(50))).expect("just in time");
}

#[test]
fn a_force_transducer_freezes_saturates_and_gives_nan_without_an_error() {
    let toy = || -> Box<dyn ForceTransducer> { open(&ToyFactory::force(Flaw::Nothing)) };
    let normal_force = |kind| {
        let plan = FaultPlan::none().during(kind, 1..2);
        let mut force = FaultyForce::new(toy(), KEY, FULL_SCALE, plan, pace());
        force.read(PATIENCE).expect("sound");
        force.read(PATIENCE).expect("announces nothing").0.force[2]
    };
    assert!(normal_force(FaultKind::NotANumber).0.is_nan());
    assert_eq!(normal_force(FaultKind::Saturation), FULL_SCALE);
    assert_eq!(
        normal_force(FaultKind::Freeze),
        normal_force(FaultKind::StaleStamp)
    );
}

#[test]
fn a_robot_that_lost_a_command_stands_and_one_that_lost_the_answer_has_moved() {
    let speed = Speed::try_new(5.0).expect("positive");
    let mut target = Pose::default();
    target.position.z.0 = -1.0;
    for (kind, moved_mm) in [(FaultKind::Drop, 0.0), (FaultKind::Silence, -1.0)] {
        let toy: Box<dyn Robot> = open(&ToyFactory::robot(Flaw::Nothing));
        let plan = FaultPlan::none().during(kind, 0..1);
        let mut robot = FaultyRobot::new(toy, KEY, plan, pace());
        let error = robot
            .move_to(target, speed, PATIENCE)
            .expect_err("no answer");
        assert_eq!(error.kind(), ErrorKind::Timeout, "{kind}");
        let (pose, _) = robot.pose(PATIENCE).expect("answers again");
        assert!(
            pose.position.z.0.total_cmp(&moved_mm).is_eq(),
            "{kind}: {pose:?}"
        );
    }
}

#[test]
fn a_halt_reaches_a_robot_whose_link_is_silent() {
    let speed = Speed::try_new(5.0).expect("positive");
    let toy: Box<dyn Robot> = open(&ToyFactory::robot(Flaw::Nothing));
    let plan = FaultPlan::none().during(FaultKind::Silence, 0..9);
    let mut robot = FaultyRobot::new(toy, KEY, plan, pace());
    robot.halt().expect("sent");
    let error = robot
        .move_to(Pose::default(), speed, PATIENCE)
        .expect_err("halted");
    assert_eq!(error.kind(), ErrorKind::Interrupted);
}

#[test]
fn a_seed_draws_every_kind_of_fault_and_the_same_ones_again() {
    let run = |seed| {
        let likelihood = Likelihood {
            per_thousand: 20,
            calls: 2,
        };
        let plan = FaultKind::ALL
            .into_iter()
            .fold(FaultPlan::none(), |plan, kind| {
                plan.drawn(seed, kind, likelihood)
            });
        let log = plan.log();
        let toy: Box<dyn Sensor> = open(&ToyFactory::sensor(Flaw::Nothing));
        let mut sensor = FaultySensor::new(toy, KEY, plan, pace());
        let frames: Vec<String> = (0..2_000)
            .map(|_| match capture(&mut sensor, Deadline::PASSED) {
                Ok((stamp, shade)) => format!("{} {shade}", stamp.valid_s),
                Err(error) => error.to_string(),
            })
            .collect();
        // Without time left, a slow link is a timeout, and counts as a slow link.
        for kind in FaultKind::ALL {
            assert!(
                log.count(kind) > 0,
                "{kind} never happened with seed {seed}"
            );
        }
        frames
    };
    assert_eq!(run(11), run(11));
    assert_ne!(run(11), run(12));
}
