//! Motion that ends by itself where its host falls silent.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use taceva_core::{EXPIRES, ErrorKind, Factory, Rig};
use taceva_drivers::XarmFactory;
use taceva_wire::xarm::Ports;
use taceva_wire::{Device, FaultKind, WallBench};

use super::setup::setup;
use crate::support::{PATIENCE, inject, lower, speed};

/// What the machine may take beyond, on which other tests run: an arm that goes on for as long as it is looked at goes on for longer.
const SLACK: Duration = Duration::from_millis(200);
/// How the host that is going to die is told which arm it moves, and how.
const ARM: &str = "TACEVA_WIRE_DYING_HOST_ARM";
const IS_EXPIRING: &str = "TACEVA_WIRE_DYING_HOST_EXPIRES";

/// Waits until the arm has moved for a while.
fn wait_for_motion(bench: &WallBench) {
    let until = Instant::now() + Duration::from_secs(10);
    let before = bench.truth().in_motion;
    while bench.truth().in_motion - before < Duration::from_millis(200) {
        assert!(Instant::now() < until, "it never moved");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn it_ends_where_it_was_sent_and_lines_follow_it() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let down = lower(home, 10.0);
    let expiring = arm.expiring_motion().expect("firmware of today");
    expiring
        .move_expiring(down, speed(20.0), PATIENCE)
        .expect("it arrives");
    let (seen, _) = arm.pose(PATIENCE).expect("a pose");
    assert!(
        (seen.position.z.0 - down.position.z.0).abs() < 1e-4,
        "{seen:?}"
    );
    let truth = setup.bench.truth();
    assert!((truth.way_mm - 10.0).abs() < 0.01, "straight: {truth:?}");
    arm.move_to(home, speed(50.0), PATIENCE).expect("a line");
    // A short way is a line, and one of no length too.
    for _ in 0..2 {
        let expiring = arm.expiring_motion().expect("firmware of today");
        expiring
            .move_expiring(lower(home, 1.0), speed(20.0), PATIENCE)
            .expect("it arrives");
    }
}

#[test]
fn a_controller_that_does_not_know_how_long_a_velocity_holds_gets_none() {
    let setup = setup(Ports {
        firmware: [1, 9, 9],
        ..Ports::ANY
    });
    assert!(setup.open().expiring_motion().is_none());
}

#[test]
fn a_halt_stops_it_and_stays() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let handle = arm.halt_handle();
    std::thread::scope(|scope| {
        let halting = scope.spawn(|| {
            wait_for_motion(&setup.bench);
            handle.halt().expect("it is sent");
            setup.bench.truth().way_mm
        });
        let expiring = arm.expiring_motion().expect("firmware of today");
        let moved = expiring.move_expiring(lower(home, 15.0), speed(5.0), PATIENCE);
        assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
        let halted_mm = halting.join().expect("halted");
        std::thread::sleep(Duration::from_millis(300));
        let way_mm = setup.bench.truth().way_mm - halted_mm;
        // One that did not hear it goes on by 1.5 mm.
        assert!(way_mm < 0.5, "it went on by {way_mm} mm");
    });
    let refused = arm.move_to(home, speed(5.0), PATIENCE);
    assert_eq!(refused.expect_err("halted").kind(), ErrorKind::Interrupted);
    arm.clear_halt(PATIENCE).expect("nothing else is wrong");
    arm.move_to(home, speed(50.0), PATIENCE)
        .expect("it takes positions again");
}

#[test]
fn a_link_that_falls_silent_lets_the_arm_stand_though_no_stop_is_confirmed() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    std::thread::scope(|scope| {
        let silence = scope.spawn(|| {
            wait_for_motion(&setup.bench);
            inject(&setup.bench, Device::Robot, FaultKind::Silent, 1_000);
            let before = setup.bench.truth().in_motion;
            std::thread::sleep(Duration::from_millis(500));
            setup.bench.truth().in_motion - before
        });
        let expiring = arm.expiring_motion().expect("firmware of today");
        let moved = expiring.move_expiring(lower(home, 15.0), speed(5.0), PATIENCE);
        assert!(moved.is_err());
        let went_on = silence.join().expect("it was silent");
        assert!(went_on <= EXPIRES + SLACK, "{went_on:?}");
    });
}

/// A host of its own process, which is killed while it moves the arm: for how long the arm goes on within 0.6 s.
fn goes_on_without_host(is_expiring: bool) -> Duration {
    let setup = setup(Ports::ANY);
    let mut host = Command::new(std::env::current_exe().expect("a test knows where it is"));
    host.args(["--exact", "xarm::expiring::the_host_that_dies"])
        .env(ARM, setup.arguments())
        .env(IS_EXPIRING, is_expiring.to_string())
        .stdout(Stdio::null());
    let mut host = host.spawn().expect("it runs itself again");
    wait_for_motion(&setup.bench);
    host.kill().expect("it was running");
    host.wait().expect("it ends");
    let before = setup.bench.truth().in_motion;
    std::thread::sleep(Duration::from_millis(600));
    setup.bench.truth().in_motion - before
}

/// Moves the arm that it is told of, until somebody kills it; a test of nothing where it is told of none.
#[test]
fn the_host_that_dies() {
    let Ok(arguments) = std::env::var(ARM) else {
        return;
    };
    let factory = XarmFactory::new().expect("a factory");
    let args = factory.descriptor().args(&arguments).expect("good");
    let mut arm = factory.open(&args, &mut Rig::new()).expect("an arm");
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let down = lower(home, 15.0);
    let is_expiring = std::env::var(IS_EXPIRING).is_ok_and(|is| is == "true");
    let moved = match arm.expiring_motion().filter(|_| is_expiring) {
        Some(expiring) => expiring.move_expiring(down, speed(5.0), PATIENCE),
        None => arm.move_to(down, speed(5.0), PATIENCE),
    };
    panic!("it was to be killed before: {moved:?}");
}

#[test]
fn an_arm_whose_host_dies_stands_within_a_fifth_of_a_second_and_one_on_a_line_goes_on() {
    let expiring = goes_on_without_host(true);
    assert!(expiring <= EXPIRES + SLACK, "{expiring:?}");
    let line = goes_on_without_host(false);
    assert!(line > Duration::from_millis(500), "{line:?}");
}
