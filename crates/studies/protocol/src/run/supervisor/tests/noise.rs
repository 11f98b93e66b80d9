//! Tests that signals of real rigs are tolerated: noise, sequence numbers, slow transducers, and a zero of the host.

use super::*;
use crate::limits::FROZEN_READINGS;

/// Supervisor that tolerates `signals` and began `stage` at 10 s.
fn allowing(signals: Signals, stage: MotionStage) -> Supervisor {
    let limits = RigLimits {
        depth_max: Millimetre(1.0),
        normal_max: Newton(1.83),
        shear_max: Newton(1.0),
        saturation: Some(Newton(20.0)),
        speed_max_mm_s: 20.0,
        overshoot: Overshoot::at(1.0, &RobotFacts::default(), signals.pose_noise_mm),
        simulated: true,
        signals,
    };
    let mut supervisor = Supervisor::new(limits, Arc::new(Halts::default()));
    supervisor.watch(stage, 10.0);
    supervisor
}

fn under_way(z: f64) -> Observation {
    Observation::UnderWay {
        pose: at_height(z),
        stamp: at(10.0),
    }
}

#[test]
fn a_tip_under_way_is_compared_with_its_way_and_one_at_rest_with_its_target() {
    let mut supervisor = allowing(Signals::default(), MotionStage::Search);
    supervisor
        .sent(at_height(-8.0), at_height(0.0))
        .expect("no switch");
    for z in [-8.5, -8.0, -4.0, 0.0, 0.5] {
        assert_eq!(supervisor.observe(&under_way(z), 10.0), Ok(()), "{z}");
    }
    let astray = supervisor.observe(&under_way(0.5_f64.next_up()), 10.0);
    assert!(matches!(astray, Err(Trip::Diverged { .. })));
    let mut beside = allowing(Signals::default(), MotionStage::Search);
    beside
        .sent(at_height(-8.0), at_height(0.0))
        .expect("no switch");
    let mut pose = at_height(-4.0);
    pose.position.x = Millimetre(0.501);
    let stamp = at(10.0);
    let astray = beside.observe(&Observation::UnderWay { pose, stamp }, 10.0);
    assert!(matches!(astray, Err(Trip::Diverged { .. })));
    // It rests at its start, and reports arrival.
    let mut stuck = allowing(Signals::default(), MotionStage::Search);
    stuck
        .sent(at_height(-8.0), at_height(0.0))
        .expect("no switch");
    let astray = stuck.observe(&super::pose(-8.0, 0.0, 10.0), 10.0);
    assert!(matches!(astray, Err(Trip::Diverged { .. })));
}

#[test]
fn a_noisy_pose_may_be_five_deviations_from_its_way_and_deeper_by_what_noise_hides() {
    let signals = Signals {
        pose_noise_mm: 0.2,
        ..Signals::default()
    };
    let far = |z| {
        let mut supervisor = allowing(signals, MotionStage::Search);
        supervisor.observe(&super::pose(z, 0.0, 10.0), 10.0)
    };
    assert_eq!(far(1.0), Ok(()));
    assert!(matches!(far(1.001), Err(Trip::Diverged { .. })));
    // 1 mm of limit, 0.8 mm of a segment, 0.5 µm of braking, 0.8485 mm of noise.
    let deep = |z| allowing(signals, PRESS).observe(&super::pose(z, z, 10.0), 10.0);
    assert_eq!(deep(0.2 + 2.649), Ok(()));
    assert!(matches!(deep(0.2 + 2.650), Err(Trip::Depth { .. })));
}

#[test]
fn a_slow_transducer_may_be_silent_for_longer() {
    let signals = Signals {
        stale_s: 0.3,
        ..Signals::default()
    };
    let mut supervisor = allowing(signals, PRESS);
    assert_eq!(supervisor.observe(&Observation::Silence, 10.29), Ok(()));
    let old = Observation::Force(force(0.1), at(10.0));
    assert_eq!(supervisor.observe(&old, 10.29), Ok(()));
    let stale = supervisor.observe(&Observation::Silence, 10.31);
    assert!(matches!(stale, Err(Trip::StaleForce { .. })));
}

/// Index of the reading, among a hundred, that halts the robot as frozen; `None` if none does.
fn frozen(signals: Signals, reading: impl Fn(u32, Stamp) -> Observation) -> Option<u32> {
    let mut supervisor = allowing(signals, PRESS);
    (0..100_u32).find(|number| {
        let now_s = 10.0 + 0.02 * f64::from(*number);
        let moved = supervisor.observe(&super::pose(0.3, 0.3, now_s), now_s);
        let read = supervisor.observe(&reading(*number, at(now_s)), now_s);
        moved.and(read).is_err()
    })
}

#[test]
fn a_signal_with_numbers_is_frozen_when_they_stand_still_and_when_forces_do_in_fine_steps() {
    let numbered =
        |number: u32| move |_, stamp| Observation::Numbered(force(0.1), stamp, number.into());
    let equal = |number: u32, stamp| Observation::Numbered(force(0.1), stamp, number.into());
    assert_eq!(frozen(Signals::default(), equal), Some(FROZEN_READINGS));
    let coarse = Signals {
        equality_is_frozen: false,
        ..Signals::default()
    };
    assert_eq!(frozen(coarse, equal), None);
    // The force changes; the sequence number does not.
    let repeated =
        |count: u32, stamp| Observation::Numbered(force(f64::from(count) * 1e-3), stamp, 7);
    assert_eq!(frozen(Signals::default(), repeated), Some(FROZEN_READINGS));
    assert_eq!(frozen(coarse, repeated), Some(FROZEN_READINGS));
    assert_eq!(
        frozen(Signals::default(), numbered(7)),
        Some(FROZEN_READINGS)
    );
}

#[test]
fn equal_forces_in_coarse_steps_are_no_frozen_signal() {
    let coarse = Signals {
        equality_is_frozen: false,
        ..Signals::default()
    };
    let equal = |_, stamp| Observation::Force(force(0.1), stamp);
    assert_eq!(frozen(coarse, equal), None);
    assert_eq!(frozen(Signals::default(), equal), Some(FROZEN_READINGS));
}

#[test]
fn a_tip_that_rests_under_a_watch_of_its_own_does_not_freeze_its_force() {
    let mut supervisor = allowing(Signals::default(), PRESS);
    supervisor
        .sent(at_height(0.3), at_height(0.3))
        .expect("no switch");
    let mut watched = |z: f64, number: u32| {
        let now_s = 10.0 + 0.005 * f64::from(number);
        let (pose, stamp) = (at_height(z), at(now_s));
        let seen = supervisor.observe(&Observation::UnderWay { pose, stamp }, now_s);
        seen.and(supervisor.observe(&Observation::Force(force(0.1), stamp), now_s))
    };
    for number in 0..50 {
        assert_eq!(watched(0.3, number), Ok(()));
    }
    let moves = (0..20_u32)
        .find(|number| watched(0.3 + 1e-3 * f64::from(number + 1), 50 + number).is_err());
    assert_eq!(moves, Some(FROZEN_READINGS - 1));
}

#[test]
fn the_zero_of_the_host_is_taken_off_for_limits_and_not_for_saturation() {
    let mut supervisor = allowing(Signals::default(), PRESS);
    supervisor.call_zero(force(1.0));
    let at_limit = Observation::Force(force(2.83), at(10.0));
    assert_eq!(supervisor.observe(&at_limit, 10.0), Ok(()));
    let pulled = Observation::Force(force(-0.84), at(10.02));
    let pulled = supervisor.observe(&pulled, 10.02);
    assert!(matches!(pulled, Err(Trip::NormalForce { .. })));
    assert_eq!(supervisor.zeroed(&force(1.5)), force(0.5));
    let mut supervisor = allowing(Signals::default(), PRESS);
    supervisor.call_zero(force(10.0));
    let saturated = supervisor.observe(&Observation::Force(force(20.0), at(10.0)), 10.0);
    assert_eq!(saturated, Err(Trip::Saturated { force_n: 20.0 }));
}
