//! Tests that `grbl-streamer`, a public client of GRBL, works with the emulated machine.

use taceva_wire::grbl::Emulator;
use taceva_wire::{Arm, BenchOptions, WallBench};

use super::python;

#[test]
fn the_public_client_reads_settings_and_offsets_and_moves_by_words_without_blanks() {
    let Some(python) = python::with("grbl_streamer") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let machine = Emulator::start(&bench).expect("a machine");
    let selector = machine.selector();
    let port = selector.trim_start_matches("gcode/grbl:port=").to_owned();
    let said = python::run(&python, include_str!("grbl.py"), &[port]);
    let expected = ["True True", "True True True", "True (300.0, 1.0, 270.0) []"];
    assert_eq!(said, expected);
    let truth = bench.truth();
    assert!((truth.tip_mm[2] + 18.7).abs() < 1e-3, "{truth:?}");
}
