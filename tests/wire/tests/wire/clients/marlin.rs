//! Tests that `printrun`, a public client of printers, works with the emulated printer.

use std::time::{Duration, Instant};

use taceva_wire::marlin::{Emulator, Firmware};
use taceva_wire::{Arm, BenchOptions, WallBench};

use super::python;

#[test]
fn a_job_of_the_public_client_is_made_although_one_line_comes_damaged() {
    let Some(python) = python::with("printrun.printcore") else {
        return;
    };
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let printer = Emulator::start(&bench, Firmware::StopsAtOnce).expect("a printer");
    let selector = printer.selector();
    let port = selector.trim_start_matches("gcode/marlin:port=").to_owned();
    let said = python::run(&python, include_str!("marlin.py"), &[port]);
    // Online; the job ended, one line was damaged; it was asked for again, and no line was unknown.
    assert_eq!(said, ["True", "False 1", "True False"]);
    let until = Instant::now() + Duration::from_secs(10);
    // 251.3 mm is the height of the gel; the damaged line went to 240 mm. The tip stands for a moment between both motions.
    let apart_mm = || (bench.truth().tip_mm[2] + 19.7).abs();
    while apart_mm() > 1e-3 && Instant::now() < until {
        std::thread::sleep(Duration::from_millis(20));
    }
    let truth = bench.truth();
    assert!(apart_mm() < 1e-3, "{truth:?}");
    assert!(truth.deepest_mm < -18.0, "{truth:?}");
}
