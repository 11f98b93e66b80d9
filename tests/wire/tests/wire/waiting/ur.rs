//! Tests of `ur/rtde` with the emulated controller, over sockets.

use std::net::Ipv4Addr;
use std::time::Duration;

use taceva_core::{Deadline, ErrorKind, Factory, Rig};
use taceva_drivers::ur::rtde::UrFactory;
use taceva_wire::ur::Emulator;
use taceva_wire::{Arm, ArmFault, BenchOptions, Device, FaultKind, WallBench};

use crate::waiting::expiring::die_moving;
use crate::waiting::gate::{Gate, halted_while_shut};
use crate::waiting::setup::Setup;
use crate::waiting::support::{PATIENCE, inject, lower, moved, speed};

fn setup() -> Setup<Emulator> {
    let factory = UrFactory::new().expect("a factory");
    let start = |bench: &_| Emulator::start(bench, Ipv4Addr::LOCALHOST, [0, 0]);
    Setup::new(factory, start)
}

#[test]
fn the_suite_passes() {
    setup().passes_the_suite();
}

#[test]
fn a_controller_without_an_output_is_refused_by_the_name_of_the_output_and_its_version() {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let open = |version: [u32; 2]| {
        let emulator = Emulator::of_version(&bench, Ipv4Addr::LOCALHOST, [0, 0], version);
        let emulator = emulator.expect("a controller");
        let factory = UrFactory::new().expect("a factory");
        let selector = emulator.selector();
        let (_, arguments) = selector.split_once(':').expect("arguments");
        let args = factory.descriptor().args(arguments).expect("good");
        factory
            .open(&args, &mut Rig::new())
            .map(|arm| arm.settings())
    };
    let error = open([3, 8]).expect_err("it lacks an output");
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    let said = error.to_string();
    for words in ["`safety_status_bits` (since 3.10 and 5.4)", "3.8.0"] {
        assert!(said.contains(words), "{said}");
    }
    for (version, expected) in [([3, 15], "3.15.0"), ([5, 11], "5.11.0")] {
        let settings = open(version).expect("it has all");
        assert_eq!(settings["firmware"], expected);
    }
}

#[test]
fn a_reduced_speed_slider_is_a_warning_with_its_remedy_and_no_setting_that_a_resumed_recording_must_have()
 {
    let setup = setup();
    let arm = setup.open();
    let settings = arm.settings();
    assert_eq!(arm.warnings(), Vec::<String>::new());
    setup.emulator.set_slider(0.7);
    // The reports of the next 100 ms state it.
    std::thread::sleep(Duration::from_millis(100));
    assert_eq!(arm.settings(), settings);
    let warnings = arm.warnings();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    for words in ["is at 70 %", "set it to 100 % on the pendant"] {
        assert!(warnings[0].contains(words), "{warnings:?}");
    }
}

#[test]
fn a_press_reaches_the_gel_where_the_driver_sent_it() {
    let setup = setup();
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    assert!((home.position.z.0 - 271.3).abs() < 1e-6, "{home:?}");
    assert!((home.rotation.x.0.abs() - 180.0).abs() < 1e-6, "{home:?}");
    arm.move_to(lower(home, 20.6), speed(60.0), PATIENCE)
        .expect("it arrives");
    let truth = setup.bench.truth();
    assert!((truth.tip_mm[2] - 0.6).abs() < 2e-6, "{truth:?}");
    assert!(truth.force_n[2] > 0.1, "{truth:?}");
}

#[test]
fn an_arm_whose_speed_slider_is_down_moves_slower_and_arrives() {
    let setup = setup();
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    setup.emulator.set_slider(0.25);
    let began = std::time::Instant::now();
    arm.move_to(lower(home, 4.0), speed(20.0), PATIENCE)
        .expect("it arrives");
    // 0.2 s at full speed.
    assert!(began.elapsed() > Duration::from_millis(750));
    assert!((setup.bench.truth().tip_mm[2] + 16.0).abs() < 0.01);
}

#[test]
fn a_halt_stops_the_arm_at_once_and_no_program_begins_after_it() {
    let setup = setup();
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    for _ in 0..20 {
        let handle = arm.halt_handle();
        let halting = std::thread::spawn(move || handle.halt());
        let moved = arm.move_to(lower(home, 1.0), speed(5.0), PATIENCE);
        halting.join().expect("halted").expect("it is sent");
        let moved = match moved {
            Ok(_) => arm.move_to(home, speed(5.0), PATIENCE),
            halted => halted,
        };
        assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
        std::thread::sleep(Duration::from_millis(30));
        assert!(!setup.bench.truth().is_moving);
        arm.clear_halt(PATIENCE).expect("nothing else is wrong");
        arm.move_to(home, speed(50.0), PATIENCE)
            .expect("it arrives");
    }
}

/// Time after which an unanswered stop counts as lost. If the machine paused for that long, the test is repeated.
const LOST_AFTER: Duration = Duration::from_secs(2);
const TRIES: u32 = 5;

#[test]
fn a_stop_that_is_late_is_waited_for_so_that_it_ends_no_motion_after_the_halt() {
    assert!(
        (0..TRIES).any(|_| a_late_stop_is_waited_for()),
        "this machine stands still for seconds"
    );
}

/// Delays a stop on its connection, and tests that motions wait for it. Returns false if the machine paused for longer than [`LOST_AFTER`].
fn a_late_stop_is_waited_for() -> bool {
    let setup = setup();
    // The second script connection is the one for stops.
    let address = setup.emulator.script_address();
    let (gate, port) = Gate::before(address, |number| number == 1);
    let direct = format!("script_port={}", address.port());
    let gated = setup
        .arguments()
        .replace(&direct, &format!("script_port={port}"));
    assert_ne!(gated, setup.arguments());
    let mut arm = setup.opened(&gated).expect("a robot");
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let shut = halted_while_shut(&gate, &setup.bench, &mut *arm);
    // The stop after the motion, on the same connection, has stopped it.
    assert!(!setup.bench.truth().is_moving);
    arm.clear_halt(PATIENCE).expect("nothing else is wrong");
    let way_mm = setup.bench.truth().way_mm;
    let soon = Deadline::after(Duration::from_millis(300));
    let refused = arm.move_to(home, speed(50.0), soon);
    if shut.elapsed() > LOST_AFTER {
        return false;
    }
    assert_eq!(
        refused.expect_err("a stop is under way").kind(),
        ErrorKind::Timeout
    );
    assert!(setup.bench.truth().way_mm <= way_mm, "nothing moves");
    gate.shut(false);
    arm.move_to(home, speed(50.0), PATIENCE)
        .expect("no stop comes any more");
    true
}

#[test]
fn an_emergency_stop_is_a_fault_that_nobody_but_a_person_ends() {
    let setup = setup();
    let (error, took) = moved(&setup.bench, &mut *setup.open(), || {
        setup.emulator.suffer(ArmFault::EmergencyStop)
    });
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
    assert!(
        error.to_string().contains("the emergency stop was pressed"),
        "{error}"
    );
    assert_eq!(error.fault(), Some(taceva_core::Fault::EmergencyStop));
    assert!(took < Duration::from_millis(700), "{took:?}");
    let mut arm = setup.open();
    let (at, _) = arm.pose(PATIENCE).expect("a pose");
    let moved = arm.move_to(lower(at, 1.0), speed(5.0), PATIENCE);
    assert_eq!(moved.expect_err("a fault").kind(), ErrorKind::DeviceFault);
    let cleared = arm.clear_halt(PATIENCE);
    assert_eq!(cleared.expect_err("a fault").kind(), ErrorKind::DeviceFault);
    assert!(!setup.bench.truth().is_moving);
}

#[test]
fn a_collision_is_a_protective_stop() {
    let setup = setup();
    let (error, _) = moved(&setup.bench, &mut *setup.open(), || {
        setup.emulator.suffer(ArmFault::Collision)
    });
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
    assert!(error.to_string().contains("a protective stop"), "{error}");
    assert_eq!(error.fault(), Some(taceva_core::Fault::Collision));
}

#[test]
fn states_that_stop_stop_the_arm() {
    let setup = setup();
    let (error, _) = moved(&setup.bench, &mut *setup.open(), || {
        inject(&setup.bench, Device::Robot, FaultKind::Silent, 1_000);
    });
    assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
    assert!(!setup.bench.truth().is_moving);
}

#[test]
fn a_pose_that_is_no_number_is_a_fault() {
    let setup = setup();
    let mut arm = setup.open();
    inject(&setup.bench, Device::Robot, FaultKind::NotANumber, 2_000);
    let fault = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(10));
        arm.pose(PATIENCE).err()
    });
    assert_eq!(fault.expect("no number").kind(), ErrorKind::DeviceFault);
}

#[test]
fn an_arm_that_goes_away_is_disconnected() {
    let setup = setup();
    let mut arm = setup.open();
    drop(setup);
    let posed = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(20));
        arm.pose(PATIENCE).err()
    });
    assert_eq!(posed.expect("gone").kind(), ErrorKind::Disconnected);
    let handle = arm.halt_handle();
    let halted = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(20));
        handle.halt().err()
    });
    assert_eq!(halted.expect("gone").kind(), ErrorKind::Disconnected);
}

#[test]
fn another_thread_sees_the_arm_move_and_its_faults() {
    let setup = setup();
    let (arm, watch) = setup.is_seen_to_move();
    setup.emulator.suffer(ArmFault::Collision);
    let found = std::iter::repeat_with(|| watch.pose(PATIENCE)).find_map(Result::err);
    let found = found.expect("the fault is reported");
    assert_eq!(
        found.fault(),
        Some(taceva_core::Fault::Collision),
        "{found}"
    );
    drop(arm);
    let gone = watch.pose(PATIENCE).expect_err("the arm is gone");
    assert_eq!(gone.kind(), ErrorKind::Disconnected);
}

#[test]
fn an_expiring_motion_ends_where_it_was_sent_and_lines_follow_it() {
    setup().ends_where_it_was_sent();
}

#[test]
fn a_halt_stops_an_expiring_motion_and_stays() {
    setup().is_halted_while_it_expires();
}

#[test]
fn states_that_fall_silent_let_an_expiring_motion_stand() {
    setup().stands_where_its_link_falls_silent();
}

/// Moves the arm that the environment names, until another process kills this one. Does nothing if the environment names no arm.
#[test]
fn the_host_that_dies() {
    die_moving(&UrFactory::new().expect("a factory"));
}

#[test]
fn an_arm_whose_host_is_killed_stands_within_the_expiry_and_one_on_a_line_goes_on() {
    setup().stands_where_its_host_dies("waiting::ur::the_host_that_dies");
}
