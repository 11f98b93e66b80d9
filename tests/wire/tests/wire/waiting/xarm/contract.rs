//! Tests that the xArm driver meets the contract of every robot, and tests specific to this driver.

use std::time::Duration;

use taceva_core::ErrorKind;
use taceva_wire::Base;
use taceva_wire::xarm::{Port, Ports};

use super::setup::setup;
use crate::waiting::support::{PATIENCE, lower, speed};

#[test]
fn the_suite_passes_with_reports_of_today() {
    setup(Ports::ANY).passes_the_suite();
}

#[test]
fn an_emulated_arm_is_recognised_by_its_serial_number() {
    assert!(setup(Ports::ANY).open().is_emulated());
}

#[test]
fn a_speed_that_the_controller_would_change_is_refused_and_its_least_one_is_not() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let refused = arm.move_to(lower(home, 0.01), speed(0.05), PATIENCE);
    let refused = refused.expect_err("below the least");
    assert_eq!(refused.kind(), ErrorKind::OutOfRange);
    assert!(
        refused.to_string().contains("at least 0.1 mm/s"),
        "{refused}"
    );
    assert!(!setup.bench.truth().is_moving);
    arm.move_to(lower(home, 0.01), speed(0.1), PATIENCE)
        .expect("the least speed");
}

#[test]
fn a_closed_report_port_is_warned_of_because_speeds_are_then_unheld() {
    let setup = setup(Ports::ANY);
    assert_eq!(setup.open().warnings(), Vec::<String>::new());
    let rich = setup.emulator.address(Port::Rich).port();
    let arguments = setup.arguments();
    // Nothing listens on port 1.
    let closed = arguments.replace(&format!("rich_port={rich}"), "rich_port=1");
    assert_ne!(closed, arguments);
    let warnings = setup.opened(&closed).expect("an arm").warnings();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    for words in ["no complete report on port 1", "open this port"] {
        assert!(warnings[0].contains(words), "{warnings:?}");
    }
}

#[test]
fn an_arm_says_its_serial_numbers_and_its_firmware() {
    let setup = setup(Ports::ANY);
    let settings = setup.open().settings();
    for (name, expected) in [
        ("serial", "XF13000007"),
        ("control_box", "TACEVA-SIM0007"),
        ("firmware", "v2.7.0"),
    ] {
        assert_eq!(settings[name], expected, "{name}");
    }
}

#[test]
fn the_suite_passes_with_the_layout_of_old_firmware() {
    let ports = Ports {
        firmware: [1, 10, 0],
        ..Ports::ANY
    };
    setup(ports).passes_the_suite();
}

#[test]
fn the_suite_passes_where_the_controller_reports_nothing_and_is_asked() {
    let ports = Ports {
        pose: None,
        status: None,
        ..Ports::ANY
    };
    setup(ports).passes_the_suite();
}

#[test]
fn another_thread_sees_the_arm_move() {
    let (arm, watch) = setup(Ports::ANY).is_seen_to_move();
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
        // Resolution of float32 at 300 mm.
        assert!((found - expected).abs() < 2e-5, "{truth:?}");
    }
    assert!(truth.force_n[2] > 0.1, "{truth:?}");
}

#[test]
fn a_halt_during_a_motion_stops_the_arm_at_once_and_stays() {
    setup(Ports::ANY).is_halted_within(Duration::from_millis(50));
}

#[test]
fn two_programs_may_look_at_one_arm() {
    let setup = setup(Ports::ANY);
    let mut arms = [setup.open(), setup.open()];
    let [one, other] = arms.each_mut().map(|arm| arm.pose(PATIENCE));
    assert_eq!(one.expect("a pose").0, other.expect("a pose").0);
    assert_ne!(setup.emulator.address(Port::Rich).port(), 0);
}
