//! Tests of late stops, late reports, and a silent connection for stops.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{ErrorKind, Robot};
use taceva_wire::Device;
use taceva_wire::xarm::{Emulator, Port, Ports};

use super::setup::setup;
use crate::waiting::gate::{Gate, halted_while_shut};
use crate::waiting::setup::Setup;
use crate::waiting::support::{PATIENCE, lower, speed};

/// Starts an emulated arm behind a gate that can hold connections. Returns both, and the opened driver.
fn behind_a_gate(holds: fn(usize) -> bool) -> (Setup<Emulator>, Arc<Gate>, Box<dyn Robot>) {
    let setup = setup(Ports::ANY);
    let address = setup.emulator.address(Port::Command);
    let (gate, port) = Gate::before(address, holds);
    let direct = format!(";port={};", address.port());
    let gated = setup
        .arguments()
        .replace(&direct, &format!(";port={port};"));
    assert_ne!(gated, setup.arguments());
    let arm = setup.opened(&gated).expect("a robot");
    (setup, gate, arm)
}

/// Time after which a sent command counts as lost. If the machine paused for that long, the test is repeated.
const LOST_AFTER: Duration = Duration::from_secs(2);
const TRIES: u32 = 5;

#[test]
fn a_halt_does_not_end_before_every_stop_was_obeyed_so_that_none_ends_the_motion_after_it() {
    // The second connection is the one for stops.
    for _ in 0..TRIES {
        let (setup, gate, mut arm) = behind_a_gate(|number| number == 1);
        let (home, _) = arm.pose(PATIENCE).expect("a pose");
        let shut = halted_while_shut(&gate, &setup.bench, &mut *arm);
        // The stop connection is abandoned and replaced; the stop is still pending on the first one.
        gate.wait_for(3);
        match arm.clear_halt(PATIENCE) {
            Err(error) => assert_eq!(error.kind(), ErrorKind::Timeout, "{error}"),
            Ok(()) => {
                assert!(shut.elapsed() > LOST_AFTER, "a stop is under way");
                continue;
            }
        }
        gate.shut(false);
        let ended = (0..100).find(|_| arm.clear_halt(PATIENCE).is_ok());
        assert!(ended.is_some(), "it answers again");
        let moved = arm.move_to(home, speed(50.0), PATIENCE);
        moved.expect("no stop comes any more");
        return;
    }
    panic!("this machine stands still for seconds");
}

#[test]
fn a_motion_waits_for_the_connection_by_which_it_would_be_stopped() {
    let (setup, gate, mut arm) = behind_a_gate(|number| number > 0);
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    gate.shut(true);
    // The connection failed its test and is replaced: nothing moves until the new one answers.
    gate.wait_for(3);
    let way_mm = setup.bench.truth().way_mm;
    let refused = arm.move_to(lower(home, 1.0), speed(20.0), PATIENCE);
    assert_eq!(
        refused.expect_err("no stop would reach it").kind(),
        ErrorKind::Timeout
    );
    assert!(setup.bench.truth().way_mm <= way_mm);
    let opening = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(100));
        gate.shut(false);
    });
    let moved = arm.move_to(lower(home, 1.0), speed(20.0), PATIENCE);
    moved.expect("it answers while that is waited for");
    opening.join().expect("no panic");
}

#[test]
fn a_late_report_of_a_stop_that_has_ended_breaks_no_motion_off() {
    let setup = setup(Ports::ANY);
    setup
        .bench
        .set_lag(Device::Robot, Duration::from_millis(40));
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    for round in 0..20 {
        // Between its two commands each call leaves the controller in a state that needs to be made ready, and a report may show it.
        for _ in 0..10 {
            arm.clear_halt(PATIENCE).expect("no halt is under way");
        }
        let target = lower(home, f64::from(round % 2));
        let moved = arm.move_to(target, speed(50.0), PATIENCE);
        moved.unwrap_or_else(|error| panic!("round {round}: {error}"));
    }
}
