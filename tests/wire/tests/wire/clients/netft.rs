//! `NetFT`, a public client of ATI's boxes, with the emulated one.

use taceva_needs::{Need, skip};
use taceva_wire::netft::{Emulator, USUAL_PORT};
use taceva_wire::{BenchOptions, WallBench, WireError};

use super::{address, python};

#[test]
fn the_public_client_reads_the_emulated_box() {
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
    let said = python::run(&python, include_str!("netft.py"), &[host.to_string()]);
    assert_eq!(said, ["6 True", "True"]);
}
