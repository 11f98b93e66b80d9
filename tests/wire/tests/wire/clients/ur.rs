//! `ur-rtde`, a public client of Universal Robots, with the emulated controller.

use std::sync::Arc;

use taceva_needs::{Need, skip};
use taceva_wire::control::Control;
use taceva_wire::ur::{Emulator, USUAL_PORTS};
use taceva_wire::{Arm, BenchOptions, WallBench, WireError};

use super::{address, python};

/// Checks the readings of the client from an arm of `version` whose speed slider is at 50 %.
fn read(last: u8, version: [u32; 2], polyscope: &str) {
    let Some(python) = python::with("rtde_receive") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let host = address(last);
    let arm = match Emulator::of_version(&bench, host, USUAL_PORTS, version) {
        Ok(arm) => Arc::new(arm),
        Err(error @ WireError::Listen { .. }) => return skip(Need::PublicClients, error),
        Err(error) => panic!("{error}"),
    };
    arm.set_slider(0.5);
    let arm: Arc<dyn Arm> = arm;
    let control = Control::start(&bench, Some(arm), host, 0).expect("a port");
    let port = control.address().port().to_string();
    let said = python::run(&python, include_str!("ur.py"), &[host.to_string(), port]);
    let dashboard = format!("{polyscope} Robotmode: RUNNING False");
    let expected = [
        "0.3 0.0 0.2713 3.1416 0.0 0.0",
        "7 1 0.5",
        dashboard.as_str(),
        "Safetystatus: NORMAL",
        "Safetystatus: PROTECTIVE_STOP",
        "Safetystatus: NORMAL",
    ];
    assert_eq!(said, expected);
}

#[test]
fn the_public_client_sees_an_e_series_arm_and_its_dashboard() {
    read(5, [5, 11], "5.11.0.108249");
}

#[test]
fn the_public_client_sees_an_older_arm_and_its_dashboard() {
    read(8, [3, 15], "3.15.0.108249");
}
