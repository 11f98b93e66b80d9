//! Tests that `NetFT` and `pynetft`, public clients of ATI's boxes, work with the emulated box.

use taceva_needs::{Need, skip};
use taceva_wire::control::Control;
use taceva_wire::netft::{Emulator, USUAL_PORT};
use taceva_wire::{BenchOptions, WallBench, WireError};

use super::{address, python};

#[test]
fn the_public_client_reads_the_emulated_box_and_gets_no_older_record_under_load() {
    let Some(python) = python::with("NetFT") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let host = address(4);
    let _box = match Emulator::start(&bench, host, USUAL_PORT, 0) {
        Ok(emulator) => emulator,
        Err(error @ WireError::Listen { .. }) => return skip(Need::PublicClients, error),
        Err(error) => panic!("{error}"),
    };
    let control = Control::start(&bench, None, host, 0).expect("a port");
    let port = control.address().port().to_string();
    let said = python::run(&python, include_str!("netft.py"), &[host.to_string(), port]);
    assert_eq!(said, ["6 True", "True", "True True"]);
}

#[test]
fn the_newer_public_client_reads_units_forces_and_torques_and_loses_nothing() {
    let Some(python) = python::with("pynetft") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let host = address(9);
    let emulator = Emulator::start(&bench, host, 0, 0).expect("a box");
    let control = Control::start(&bench, None, host, 0).expect("a port");
    let ports = [
        emulator.address(),
        emulator.page_address(),
        control.address(),
    ];
    let mut arguments = vec![host.to_string()];
    arguments.extend(ports.map(|address| address.port().to_string()));
    let said = python::run(&python, include_str!("pynetft.py"), &arguments);
    assert_eq!(said, ["N N-m", "True True", "True True", "0 0 0 0", "True"]);
}
