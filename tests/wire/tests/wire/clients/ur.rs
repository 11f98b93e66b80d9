//! `ur-rtde`, a public client of Universal Robots, with the emulated controller.

use taceva_needs::{Need, skip};
use taceva_wire::ur::{Emulator, USUAL_PORTS};
use taceva_wire::{BenchOptions, WallBench, WireError};

use super::{address, python};

#[test]
fn the_public_client_sees_the_emulated_arm() {
    let Some(python) = python::with("rtde_receive") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let host = address(5);
    let _arm = match Emulator::start(&bench, host, USUAL_PORTS) {
        Ok(arm) => arm,
        Err(error @ WireError::Listen { .. }) => return skip(Need::PublicClients, error),
        Err(error) => panic!("{error}"),
    };
    let said = python::run(&python, include_str!("ur.py"), &[host.to_string()]);
    assert_eq!(said, ["0.3 0.0 0.2713 3.1416 0.0 0.0", "7 1"]);
}
