//! Tests of each limit from both sides, for each axis and sign: the limit itself, and the next binary64 number beyond it.

use super::*;

/// Limits that are dyadic fractions, so that sums and roots are exact. No test force reaches saturation.
fn limits() -> RigLimits {
    RigLimits {
        depth_max: Millimetre(1.0),
        normal_max: Newton(2.0),
        shear_max: Newton(0.3125),
        saturation: Some(Newton(16.0)),
        speed_max_mm_s: 20.0,
        overshoot: Overshoot::at(1.0, &RobotFacts::default(), 0.0),
        simulated: true,
        signals: Signals::default(),
    }
}

/// Limits so wide that test forces reach only saturation.
fn wide() -> RigLimits {
    RigLimits {
        normal_max: Newton(64.0),
        shear_max: Newton(64.0),
        ..limits()
    }
}

/// Reason for which one observation at `now_s` halts the robot, under `limits` in a `stage` that began at 0 s; `None` without a halt.
fn trips(
    limits: RigLimits,
    stage: MotionStage,
    observation: &Observation,
    now_s: f64,
) -> Option<Trip> {
    let mut supervisor = Supervisor::new(limits, Arc::new(Halts::default()));
    supervisor.watch(stage, 0.0);
    supervisor.observe(observation, now_s).err()
}

/// Reason for which `force`, in N, halts the robot; `None` without a halt.
fn pushed(limits: RigLimits, stage: MotionStage, force: [f64; 3]) -> Option<Trip> {
    let wrench = Wrench {
        force: force.map(Newton),
        ..Wrench::default()
    };
    trips(limits, stage, &Observation::Force(wrench, at(0.0)), 0.0)
}

/// Reason for which a tip at `place`, which was sent to `target`, halts the robot; both in mm. `None` without a halt.
fn placed(stage: MotionStage, place: [f64; 3], target: [f64; 3]) -> Option<Trip> {
    let observation = Observation::Pose {
        pose: pose_at(place),
        stamp: at(0.0),
        target: pose_at(target),
    };
    trips(limits(), stage, &observation, 0.0)
}

fn pose_at([x, y, z]: [f64; 3]) -> Pose {
    let [x, y, z] = [x, y, z].map(Millimetre);
    Pose {
        position: Point { x, y, z },
        ..Pose::default()
    }
}

/// Vectors of length `size` along the axis `axis`, in the positive and the negative direction.
fn along(axis: usize, size: f64) -> [[f64; 3]; 2] {
    [size, -size].map(|size| {
        let mut vector = [0.0; 3];
        vector[axis] = size;
        vector
    })
}

const TOUCHING: MotionStage = MotionStage::Press { height_mm: 0.0 };
const STAGES: [MotionStage; 2] = [TOUCHING, MotionStage::Search];

#[test]
fn no_limit_halts_a_tip_that_was_lifted_as_asked_and_the_same_way_into_the_gel_does() {
    let threshold_n = 0.1;
    let force_n = 1.0;
    let stages = [
        TOUCHING,
        MotionStage::Search,
        MotionStage::Travel { threshold_n },
        MotionStage::Retreat { force_n },
    ];
    for lift_mm in [10.0, 30.0] {
        for stage in stages {
            let lifted = [0.0, 0.0, -lift_mm];
            assert_eq!(placed(stage, lifted, lifted), None, "{stage:?}");
        }
        let pressed = [0.0, 0.0, lift_mm];
        let trip = placed(TOUCHING, pressed, pressed);
        assert!(matches!(trip, Some(Trip::Depth { .. })), "{trip:?}");
    }
}

#[test]
fn a_normal_force_on_the_limit_passes_and_the_next_number_halts_pressing_and_pulling() {
    for stage in STAGES {
        for on in along(2, 2.0) {
            assert_eq!(pushed(limits(), stage, on), None, "{on:?}");
        }
        for beyond in along(2, 2.0_f64.next_up()) {
            let trip = pushed(limits(), stage, beyond);
            let [_, _, force_n] = beyond;
            let limit_n = 2.0;
            assert_eq!(trip, Some(Trip::NormalForce { force_n, limit_n }));
        }
    }
}

#[test]
fn a_shear_force_on_the_limit_passes_and_one_beyond_halts_along_each_axis_and_between_them() {
    for stage in STAGES {
        for axis in [0, 1] {
            for on in along(axis, 0.3125) {
                assert_eq!(pushed(limits(), stage, on), None, "{on:?}");
            }
            for beyond in along(axis, 0.3125_f64.next_up()) {
                let trip = pushed(limits(), stage, beyond);
                assert!(matches!(trip, Some(Trip::ShearForce { .. })), "{beyond:?}");
            }
        }
        // 3, 4, 5: the root is exact.
        for (x, y) in [(0.1875, 0.25), (-0.25, 0.1875), (0.25, -0.1875)] {
            assert_eq!(pushed(limits(), stage, [x, y, 0.0]), None);
            let trip = pushed(limits(), stage, [x * 1.000_001, y, 0.0]);
            let Some(Trip::ShearForce { force_n, limit_n }) = trip else {
                panic!("{x} {y}: {trip:?}");
            };
            assert!((force_n - 0.3125).abs() < 1e-6, "{force_n}");
            assert_eq!(limit_n.to_bits(), 0.3125_f64.to_bits());
        }
        // Two equal components, each far below the limit.
        let equal = |share: f64| {
            let part = share * 0.3125 * std::f64::consts::FRAC_1_SQRT_2;
            [part, -part, 0.0]
        };
        assert_eq!(pushed(limits(), stage, equal(0.999)), None);
        let trip = pushed(limits(), stage, equal(1.001));
        assert!(matches!(trip, Some(Trip::ShearForce { .. })), "{trip:?}");
    }
}

#[test]
fn a_force_at_saturation_halts_along_each_axis_and_one_below_it_does_not() {
    for axis in 0..3 {
        for on in along(axis, 16.0) {
            let trip = pushed(wide(), TOUCHING, on);
            assert_eq!(trip, Some(Trip::Saturated { force_n: 16.0 }), "{on:?}");
            let unknown = RigLimits {
                saturation: None,
                ..wide()
            };
            assert_eq!(pushed(unknown, TOUCHING, on), None, "{on:?}");
        }
        for below in along(axis, 16.0_f64.next_down()) {
            assert_eq!(pushed(wide(), TOUCHING, below), None, "{below:?}");
        }
    }
}

#[test]
fn a_force_at_the_threshold_of_contact_passes_in_the_air_and_the_next_number_is_a_collision() {
    let air = MotionStage::Travel { threshold_n: 0.125 };
    for on in along(2, 0.125) {
        assert_eq!(pushed(limits(), air, on), None, "{on:?}");
    }
    for beyond in along(2, 0.125_f64.next_up()) {
        let [_, _, force_n] = beyond;
        let trip = pushed(limits(), air, beyond);
        let is_in_air = true;
        assert_eq!(trip, Some(Trip::UnexpectedContact { force_n, is_in_air }));
    }
    let sheared = pushed(limits(), air, [1.0, 0.0, 0.0]);
    assert!(matches!(sheared, Some(Trip::ShearForce { .. })));
    let deaf = MotionStage::Travel { threshold_n: 8.0 };
    let pressed = pushed(limits(), deaf, [0.0, 0.0, 4.0]);
    assert!(matches!(pressed, Some(Trip::NormalForce { .. })));
}

#[test]
fn a_force_on_the_way_back_may_be_that_of_the_halt_or_of_the_limit_and_the_margin_more() {
    for (force_n, highest) in [(4.0, 4.0 + 0.05), (0.5, 2.0 + 0.05)] {
        let back = MotionStage::Retreat { force_n };
        assert_eq!(pushed(limits(), back, [0.0, 0.0, highest]), None);
        let risen = highest.next_up();
        let trip = pushed(limits(), back, [0.0, 0.0, risen]);
        let expected = Trip::UnexpectedContact {
            force_n: risen,
            is_in_air: false,
        };
        assert_eq!(trip, Some(expected));
        // A sticky gel pulls and keeps shear. Neither stops the tip from leaving.
        assert_eq!(pushed(limits(), back, [8.0, 0.0, -8.0]), None);
    }
}

#[test]
fn a_force_may_be_fifty_milliseconds_old_and_no_longer() {
    let force = Observation::Force(Wrench::default(), at(0.0));
    for (observation, is_pose) in [(force, false), (pose(0.0, 0.0, 0.0), true)] {
        assert_eq!(trips(limits(), TOUCHING, &observation, 0.05), None);
        let age_s = 0.05_f64.next_up();
        let expected = match is_pose {
            true => Trip::StalePose { age_s },
            false => Trip::StaleForce { age_s },
        };
        let trip = trips(limits(), TOUCHING, &observation, age_s);
        assert_eq!(trip, Some(expected));
    }
}

#[test]
fn silence_counts_from_when_the_last_force_was_true_and_from_the_watch_before_one() {
    let age_s = 0.05_f64.next_up();
    let stale = Some(Trip::StaleForce { age_s });
    let silence = Observation::Silence;
    assert_eq!(trips(limits(), TOUCHING, &silence, 0.05), None);
    assert_eq!(trips(limits(), TOUCHING, &silence, age_s), stale);

    let mut supervisor = Supervisor::new(limits(), Arc::new(Halts::default()));
    supervisor.watch(TOUCHING, 0.0);
    // It arrives at 1/32 s and was measured at 1/64 s, the last sign of life of the transducer.
    let (valid_s, now_s) = (0.015_625, 0.031_25);
    let force = Observation::Force(Wrench::default(), at(valid_s));
    assert_eq!(supervisor.observe(&force, now_s), Ok(()));
    assert_eq!(supervisor.observe(&silence, valid_s + 0.049), Ok(()));
    let late = supervisor.observe(&silence, valid_s + 0.051);
    assert!(matches!(late, Err(Trip::StaleForce { .. })));
    supervisor.release(TOUCHING, 1.0);
    assert_eq!(supervisor.observe(&silence, 1.049), Ok(()));
}

/// Reason for which the second of two normal forces in N halts the robot, if any. The first is at `start_s`, the second `span_s` later.
fn stepped(start_s: f64, forces_n: [f64; 2], span_s: f64) -> Option<Trip> {
    let mut supervisor = Supervisor::new(wide(), Arc::new(Halts::default()));
    supervisor.watch(TOUCHING, start_s);
    let [first, second] = forces_n.map(force);
    let first = Observation::Force(first, at(start_s));
    assert_eq!(supervisor.observe(&first, start_s), Ok(()));
    let second = Observation::Force(second, at(start_s + span_s));
    supervisor.observe(&second, start_s + span_s).err()
}

#[test]
fn a_force_may_rise_or_fall_by_two_hundred_newton_a_second_and_no_faster() {
    // 1/128 s at 200 N/s: exact at any clock time.
    let (span_s, change_n) = (0.007_812_5, 1.562_5);
    for start_s in [0.0, 1.0] {
        let steps = [[0.0, change_n], [change_n, 0.0], [0.0, -change_n]];
        for forces_n in steps.into_iter().chain([[1.0, 1.0 + change_n]]) {
            assert_eq!(stepped(start_s, forces_n, span_s), None, "{forces_n:?}");
        }
        for faster in along(2, change_n.next_up()) {
            let trip = stepped(start_s, [0.0, faster[2]], span_s);
            let Some(Trip::ForceRate { rate_n_s }) = trip else {
                panic!("{trip:?}");
            };
            assert!(rate_n_s > 200.0 && rate_n_s < 200.000_1, "{rate_n_s}");
        }
    }
}

#[test]
fn two_forces_nearer_than_five_milliseconds_have_no_rate() {
    assert_eq!(stepped(0.0, [0.0, 8.0], 0.005_f64.next_down()), None);
    let trip = stepped(0.0, [0.0, 8.0], 0.005);
    assert!(matches!(trip, Some(Trip::ForceRate { .. })), "{trip:?}");
}

#[test]
fn a_limit_that_is_passed_is_named_before_the_rate_at_which_it_was() {
    let trip = stepped(0.0, [0.0, 70.0], 0.007_812_5);
    assert!(matches!(trip, Some(Trip::Saturated { .. })), "{trip:?}");
}

#[test]
fn a_tip_may_be_as_deep_as_the_limit_and_its_overshoot_and_no_deeper() {
    let deepest = 1.0 + limits().overshoot.healthy_mm;
    let at_depth = |depth: f64| placed(TOUCHING, [0.0, 0.0, depth], [0.0, 0.0, depth]);
    assert_eq!(at_depth(deepest), None);
    let depth_mm = deepest.next_up();
    let limit_mm = 1.0;
    assert_eq!(at_depth(depth_mm), Some(Trip::Depth { depth_mm, limit_mm }));
    // Counted from the contact, and only in contact.
    let place = [0.0, 0.0, 1.25];
    let above = MotionStage::Press { height_mm: 0.25 };
    assert_eq!(placed(above, place, place), None);
    let below = MotionStage::Press { height_mm: -0.25 };
    assert!(placed(below, place, place).is_some());
    assert_eq!(placed(MotionStage::Search, place, place), None);
}

#[test]
fn a_tip_may_be_half_a_millimetre_from_its_target_in_any_direction_and_no_farther() {
    for axis in 0..3 {
        for on in along(axis, 0.5) {
            assert_eq!(placed(MotionStage::Search, on, [0.0; 3]), None, "{on:?}");
        }
        for beyond in along(axis, 0.5_f64.next_up()) {
            let trip = placed(MotionStage::Search, beyond, [0.0; 3]);
            let distance_mm = 0.5_f64.next_up();
            assert_eq!(trip, Some(Trip::Diverged { distance_mm }), "{beyond:?}");
        }
    }
    let target = [1.0, -2.0, 0.75];
    let directions = [
        [0.6, 0.8, 0.0],
        [0.6, 0.0, -0.8],
        [0.0, -0.8, 0.6],
        [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0],
    ];
    for direction in directions {
        let from_target = |way: f64| {
            let axes = [0, 1, 2].map(|axis| target[axis] + way * direction[axis]);
            placed(MotionStage::Search, axes, target)
        };
        assert_eq!(from_target(0.499_999), None, "{direction:?}");
        let trip = from_target(0.500_001);
        let Some(Trip::Diverged { distance_mm }) = trip else {
            panic!("{direction:?}: {trip:?}");
        };
        assert!((distance_mm - 0.500_001).abs() < 1e-9, "{distance_mm}");
    }
}

#[test]
fn a_tip_may_rest_on_each_limit_and_on_nothing_beyond_it() {
    let supervisor = Supervisor::new(limits(), Arc::new(Halts::default()));
    let rests = |depth_mm: f64, force: [f64; 3]| {
        let wrench = Wrench {
            force: force.map(Newton),
            ..Wrench::default()
        };
        supervisor.lets_rest(depth_mm, &wrench)
    };
    let deepest = 1.0 + limits().overshoot.healthy_mm;
    assert!(rests(deepest, [0.1875, -0.25, 2.0]));
    assert!(rests(deepest, [0.1875, 0.25, -2.0]));
    assert!(!rests(deepest.next_up(), [0.0; 3]));
    for axis in 0..3 {
        let limit: f64 = if axis == 2 { 2.0 } else { 0.3125 };
        for on in along(axis, limit) {
            assert!(rests(0.0, on), "{on:?}");
        }
        for beyond in along(axis, limit.next_up()) {
            assert!(!rests(0.0, beyond), "{beyond:?}");
        }
    }
    assert!(!rests(0.0, [0.25, 0.25, 0.0]));
}
