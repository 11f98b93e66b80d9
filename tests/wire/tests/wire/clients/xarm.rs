//! Tests that `xarm-python-sdk`, UFACTORY's own client, works with the emulated arm.

use std::sync::Arc;

use taceva_needs::{Need, skip};
use taceva_wire::control::Control;
use taceva_wire::xarm::{Emulator, Ports};
use taceva_wire::{Arm, BenchOptions, WallBench, WireError};

use super::{address, python};

fn moves_and_stops(last: u8, firmware: [u32; 3], report: &str) {
    let Some(python) = python::with("xarm") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let host = address(last);
    let ports = Ports {
        host,
        firmware,
        ..Ports::USUAL
    };
    let _arm = match Emulator::start(&bench, ports) {
        Ok(arm) => arm,
        Err(error @ WireError::Listen { .. }) => return skip(Need::PublicClients, error),
        Err(error) => panic!("{error}"),
    };
    let script = include_str!("xarm.py");
    let said = python::run(&python, script, &[host.to_string(), report.to_owned()]);
    let expected = [
        "serial XF13000007",
        "enabled 0 0 0",
        "at 0 300.0 0.0 271.3 180.0 0.0 0.0",
        "moved 0",
        "relative 0",
        "at 0 300.0 0.0 258.0 180.0 0.0 0.0",
        "well (0, 2) (0, [0, 0])",
        "stopped True True",
        "refused True",
        "state 4",
    ];
    assert_eq!(said, expected);
    // The arm stands at the position of the client's stop: 5 mm/s for 0.3 s above its start.
    let truth = bench.truth();
    assert!(!truth.is_moving);
    let risen_mm = -6.7 - truth.tip_mm[2];
    assert!((0.5..4.0).contains(&risen_mm), "{truth:?}");
}

#[test]
fn the_public_client_moves_and_stops_the_arm_with_rich_reports() {
    moves_and_stops(1, [2, 7, 0], "rich");
}

#[test]
fn the_public_client_moves_and_stops_the_arm_with_reports_of_status() {
    moves_and_stops(2, [2, 7, 0], "normal");
}

#[test]
fn the_public_client_moves_and_stops_an_arm_of_old_firmware() {
    moves_and_stops(3, [1, 10, 0], "rich");
}

fn moves_by_tool_and_joints(last: u8, firmware: [u32; 3]) {
    let Some(python) = python::with("xarm") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let host = address(last);
    let ports = Ports {
        host,
        firmware,
        ..Ports::USUAL
    };
    let arm: Arc<dyn Arm> = match Emulator::start(&bench, ports) {
        Ok(arm) => Arc::new(arm),
        Err(error @ WireError::Listen { .. }) => return skip(Need::PublicClients, error),
        Err(error) => panic!("{error}"),
    };
    let control = Control::start(&bench, Some(arm), host, 0).expect("a port");
    let port = control.address().port().to_string();
    let script = include_str!("xarm_motions.py");
    let said = python::run(&python, script, &[host.to_string(), port]);
    let expected = [
        "serial 0 XF13000007",
        "checked 0 0",
        // The boundary of safety.
        "checked 1 35",
        "stays 0 300.0 0.0 271.3 180.0 0.0 0.0",
        "tool 0 0 300.0 0.0 270.0 180.0 0.0 0.0",
        "turned 0 0 300.0 0.0 270.0 180.0 0.0 -10.0",
        "rotation 0 0 300.0 0.0 265.0 180.0 0.0 0.0",
        "by 0 0 300.0 2.0 264.0 180.0 0.0 0.0",
        "vector 0 300.0 2.0 264.0 180.0 0.0 0.0",
        "joint 0",
        "swung True 5.0",
        "back 0 0 300.0 2.0 264.0 180.0 0.0 0.0",
        "slow 0 True",
        // An emergency stop, as the client calls it, before any report of the error.
        "collided -9 0",
        "refused 1",
        "reads 0 (0, [31, 0])",
    ];
    assert_eq!(said, expected);
}

#[test]
fn the_public_client_moves_by_tool_and_joints_checks_and_learns_of_a_collision() {
    moves_by_tool_and_joints(6, [2, 7, 0]);
}

#[test]
fn the_public_client_does_so_with_an_arm_of_old_firmware() {
    moves_by_tool_and_joints(7, [1, 10, 0]);
}
