//! What every robot promises, and what this one does.

use std::time::Instant;

use taceva_core::ErrorKind;
use taceva_drivers::XarmFactory;
use taceva_drivers::conformance::{self, Trial};
use taceva_wire::Base;
use taceva_wire::xarm::{Port, Ports};

use super::setup::setup;
use crate::support::{PATIENCE, lower, speed};

fn passes(ports: Ports) {
    let setup = setup(ports);
    let factory = XarmFactory::new().expect("a factory");
    let trial = Trial::with_arguments(setup.arguments());
    let report = conformance::robot(&factory, &trial);
    assert!(report.passed(), "{report}");
}

#[test]
fn the_suite_passes_with_reports_of_today() {
    passes(Ports::ANY);
}

#[test]
fn the_suite_passes_with_the_layout_of_old_firmware() {
    passes(Ports {
        firmware: [1, 10, 0],
        ..Ports::ANY
    });
}

#[test]
fn the_suite_passes_where_the_controller_reports_nothing_and_is_asked() {
    passes(Ports {
        pose: None,
        status: None,
        ..Ports::ANY
    });
}

#[test]
fn another_thread_sees_the_arm_move() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let watch = arm.watch_handle().expect("an arm that reports");
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let seen = std::thread::scope(|scope| {
        let moving = scope.spawn(|| arm.move_to(lower(home, 10.0), speed(20.0), PATIENCE));
        let mut seen = Vec::new();
        while !moving.is_finished() {
            let (pose, stamp) = watch.pose(PATIENCE).expect("a report");
            seen.push((stamp.valid_s, pose.position.z.0));
        }
        moving.join().expect("no panic").expect("it arrives");
        seen
    });
    assert!(seen.is_sorted_by(|one, other| one.0 < other.0), "{seen:?}");
    let between =
        |(_, z): &&(f64, f64)| *z < home.position.z.0 - 1.0 && *z > home.position.z.0 - 9.0;
    // Half a second of motion, a hundred reports a second; a busy machine skips some.
    assert!(seen.iter().filter(between).count() >= 5, "{seen:?}");
    drop(arm);
    let gone = watch.pose(PATIENCE).expect_err("the arm is gone");
    assert_eq!(gone.kind(), ErrorKind::Disconnected);
}

#[test]
fn a_press_reaches_the_gel_where_the_driver_sent_it() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    assert!((home.position.z.0 - 271.3).abs() < 1e-4, "{home:?}");
    assert!((home.rotation.x.0 - 180.0).abs() < 1e-4, "{home:?}");
    arm.move_to(lower(home, 18.0), speed(100.0), PATIENCE)
        .expect("it arrives");
    arm.move_to(lower(home, 20.6), speed(20.0), PATIENCE)
        .expect("it arrives");
    let truth = setup.bench.truth();
    let [x, y, z] = truth.tip_mm;
    let expected = Base::to_sensor([300.0, 0.0, 250.7]);
    for (found, expected) in [x, y, z].into_iter().zip(expected) {
        // What float32 leaves of 300 mm.
        assert!((found - expected).abs() < 2e-5, "{truth:?}");
    }
    assert!(truth.force_n[2] > 0.1, "{truth:?}");
}

#[test]
fn a_halt_during_a_motion_stops_the_arm_at_once_and_stays() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let handle = arm.halt_handle();
    let bench = setup.bench.clone();
    let halting = std::thread::spawn(move || {
        while !bench.truth().is_moving {
            std::thread::yield_now();
        }
        let called = Instant::now();
        handle.halt().expect("it is sent");
        while bench.truth().is_moving {
            assert!(called.elapsed().as_millis() < 500, "it moves on");
        }
        called.elapsed()
    });
    let moved = arm.move_to(lower(home, 15.0), speed(5.0), PATIENCE);
    assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
    let took = halting.join().expect("halted");
    assert!(took.as_millis() < 50, "{took:?}");
    let refused = arm.move_to(home, speed(5.0), PATIENCE);
    assert_eq!(refused.expect_err("halted").kind(), ErrorKind::Interrupted);
    arm.clear_halt(PATIENCE).expect("nothing else is wrong");
    arm.move_to(home, speed(50.0), PATIENCE)
        .expect("it arrives");
}

#[test]
fn two_programs_may_look_at_one_arm() {
    let setup = setup(Ports::ANY);
    let mut arms = [setup.open(), setup.open()];
    let [one, other] = arms.each_mut().map(|arm| arm.pose(PATIENCE));
    assert_eq!(one.expect("a pose").0, other.expect("a pose").0);
    assert_ne!(setup.arm.address(Port::Rich).port(), 0);
}
