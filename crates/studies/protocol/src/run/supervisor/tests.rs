//! Tests of readings that must halt the robot, and of readings that must not.

mod boundaries;
mod enabling;
mod noise;
mod signals;

use std::sync::atomic::{AtomicU32, Ordering};

use taceva_core::{DriverError, Millimetre, Newton, Point, RobotFacts};

use super::*;
use crate::limits::{Overshoot, Signals};

#[derive(Default)]
struct Halts(AtomicU32);

impl Halt for Halts {
    fn halt(&self) -> Result<(), DriverError> {
        self.0.fetch_add(1, Ordering::SeqCst);
        Ok(())
    }
}

fn watching(stage: MotionStage) -> (Supervisor, Arc<Halts>) {
    let limits = RigLimits {
        depth_max: Millimetre(1.0),
        normal_max: Newton(1.83),
        shear_max: Newton(1.0),
        saturation: Some(Newton(20.0)),
        speed_max_mm_s: 20.0,
        overshoot: Overshoot::at(1.0, &RobotFacts::default(), 0.0),
        simulated: true,
        signals: Signals::default(),
    };
    let halts = Arc::new(Halts::default());
    let mut supervisor = Supervisor::new(limits, halts.clone());
    supervisor.watch(stage, 10.0);
    (supervisor, halts)
}

fn force(z: f64) -> Wrench {
    Wrench {
        force: [Newton(0.0), Newton(0.0), Newton(z)],
        ..Wrench::default()
    }
}

fn at(valid_s: f64) -> Stamp {
    Stamp {
        valid_s,
        received_s: None,
    }
}

fn at_height(z: f64) -> Pose {
    let z = Millimetre(z);
    Pose {
        position: Point {
            z,
            ..Point::default()
        },
        ..Pose::default()
    }
}

const PRESS: MotionStage = MotionStage::Press { height_mm: 0.2 };

/// Reason for which one observation at 10.02 s in `stage` halts the robot; `None` without a halt. Checks that the halt was sent.
fn trip(stage: MotionStage, observation: &Observation) -> Option<Trip> {
    let (mut supervisor, halts) = watching(stage);
    let tripped = supervisor.observe(observation, 10.02).err();
    assert_eq!(halts.0.load(Ordering::SeqCst), u32::from(tripped.is_some()));
    assert_eq!(supervisor.tripped(), tripped);
    tripped
}

fn pose(z: f64, target: f64, valid_s: f64) -> Observation {
    Observation::Pose {
        pose: at_height(z),
        stamp: at(valid_s),
        target: at_height(target),
    }
}

#[test]
fn a_healthy_press_is_left_alone() {
    assert_eq!(
        trip(PRESS, &Observation::Force(force(1.8), at(10.02))),
        None
    );
    assert_eq!(trip(PRESS, &pose(1.2, 1.2, 10.02)), None);
    assert_eq!(trip(PRESS, &Observation::Silence), None);
}

#[test]
fn a_limit_that_is_passed_halts_and_is_no_fault() {
    let hard = trip(PRESS, &Observation::Force(force(1.84), at(10.02)));
    assert!(matches!(hard, Some(Trip::NormalForce { .. })) && hard.and_then(Trip::limit).is_some());
    let pulled = trip(PRESS, &Observation::Force(force(-1.84), at(10.02)));
    assert!(matches!(pulled, Some(Trip::NormalForce { .. })));
    let mut sheared = force(0.5);
    sheared.force[0] = Newton(-0.8);
    sheared.force[1] = Newton(0.8);
    let sheared = trip(PRESS, &Observation::Force(sheared, at(10.02)));
    assert!(matches!(sheared, Some(Trip::ShearForce { .. })));
    let deep = trip(PRESS, &pose(1.25, 1.25, 10.02));
    assert!(matches!(deep, Some(Trip::Depth { .. })));
}

#[test]
fn a_reading_that_is_no_number_halts() {
    assert_eq!(
        trip(PRESS, &Observation::Force(force(f64::NAN), at(10.02))),
        Some(Trip::NotFinite)
    );
    assert_eq!(
        trip(PRESS, &pose(f64::INFINITY, 0.3, 10.02)),
        Some(Trip::NotFinite)
    );
    assert_eq!(
        trip(PRESS, &Observation::Force(force(0.1), at(f64::NAN))),
        Some(Trip::NotFinite)
    );
}

#[test]
fn a_reading_that_is_old_halts() {
    let old = trip(PRESS, &Observation::Force(force(0.1), at(9.96)));
    assert!(matches!(old, Some(Trip::StaleForce { .. })));
    let old = trip(PRESS, &pose(0.3, 0.3, 9.96));
    assert!(matches!(old, Some(Trip::StalePose { .. })));
}

#[test]
fn a_transducer_that_falls_silent_halts_after_fifty_milliseconds() {
    let (mut supervisor, halts) = watching(PRESS);
    assert_eq!(supervisor.observe(&Observation::Silence, 10.049), Ok(()));
    assert!(supervisor.observe(&Observation::Silence, 10.051).is_err());
    assert_eq!(halts.0.load(Ordering::SeqCst), 1);
}

#[test]
fn a_saturated_transducer_halts_before_any_limit_is_asked() {
    let mut saturated = force(0.0);
    saturated.force[1] = Newton(-20.0);
    let tripped = trip(PRESS, &Observation::Force(saturated, at(10.02)));
    assert_eq!(tripped, Some(Trip::Saturated { force_n: 20.0 }));
}

#[test]
fn a_tip_that_is_not_where_it_was_sent_halts() {
    let astray = trip(PRESS, &pose(0.3, 0.9, 10.02));
    assert!(matches!(astray, Some(Trip::Diverged { .. })));
}

#[test]
fn a_force_in_the_air_halts() {
    let air = MotionStage::Travel { threshold_n: 0.02 };
    let touched = trip(air, &Observation::Force(force(0.03), at(10.02)));
    let expected = Trip::UnexpectedContact {
        force_n: 0.03,
        is_in_air: true,
    };
    assert_eq!(touched, Some(expected));
}

#[test]
fn a_force_that_rises_on_the_way_back_halts() {
    let back = MotionStage::Retreat { force_n: 2.0 };
    assert_eq!(trip(back, &Observation::Force(force(2.0), at(10.02))), None);
    assert!(trip(back, &Observation::Force(force(2.1), at(10.02))).is_some());
}

#[test]
fn a_force_that_jumps_halts() {
    let (mut supervisor, _) = watching(PRESS);
    assert_eq!(
        supervisor.observe(&Observation::Force(force(0.0), at(10.0)), 10.0),
        Ok(())
    );
    let jumped = supervisor.observe(&Observation::Force(force(1.5), at(10.006)), 10.006);
    assert!(matches!(jumped, Err(Trip::ForceRate { .. })));
}

#[test]
fn equal_readings_are_a_frozen_signal_only_if_the_tip_moved() {
    let frozen = |moves: bool| {
        let (mut supervisor, _) = watching(PRESS);
        (0..100_u32).find(|reading| {
            let now_s = 10.0 + 0.02 * f64::from(*reading);
            let moved = match moves {
                true => supervisor.observe(&pose(0.3, 0.3, now_s), now_s),
                false => Ok(()),
            };
            let read = supervisor.observe(&Observation::Force(force(0.1), at(now_s)), now_s);
            moved.and(read).is_err()
        })
    };
    assert_eq!(frozen(true), Some(FROZEN_READINGS));
    assert_eq!(frozen(false), None);
}

#[test]
fn a_halt_holds_through_every_stage_and_lets_no_motion_begin_until_it_is_ended() {
    let (mut supervisor, halts) = watching(PRESS);
    let healthy = Observation::Force(force(0.1), at(10.0));
    assert!(
        supervisor
            .observe(&Observation::Force(force(9.0), at(10.0)), 10.0)
            .is_err()
    );
    assert!(supervisor.observe(&healthy, 10.0).is_err());
    assert_eq!(halts.0.load(Ordering::SeqCst), 2);
    let back = MotionStage::Retreat { force_n: 9.0 };
    let [from, to] = [0.3, -1.0].map(at_height);
    supervisor.watch(back, 10.0);
    let held = supervisor.tripped();
    assert!(matches!(held, Some(Trip::NormalForce { .. })), "{held:?}");
    assert_eq!(supervisor.sent(from, to).err(), held);
    assert!(!supervisor.is_under_way());
    supervisor.release(back, 10.0);
    assert_eq!(supervisor.observe(&healthy, 10.0), Ok(()));
    assert_eq!(supervisor.sent(from, to), Ok(()));
}
