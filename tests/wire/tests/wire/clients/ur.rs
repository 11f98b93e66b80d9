//! Tests that `ur-rtde`, a public client of Universal Robots, works with the emulated controller.

use std::sync::Arc;

use taceva_needs::{Need, skip};
use taceva_wire::control::Control;
use taceva_wire::ur::{Emulator, USUAL_PORTS};
use taceva_wire::{Arm, BenchOptions, WallBench, WireError};

use super::{address, python};

/// Output lines of the Python `script` with an emulated arm of `version`. Its speed slider is at `slider`, and `registers` is an argument of the
/// script. `None` without `module`, or if the ports are in use.
fn said(
    module: &str,
    script: &str,
    last: u8,
    version: [u32; 2],
    slider: f64,
    registers: &str,
) -> Option<Vec<String>> {
    let python = python::with(module)?;
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let host = address(last);
    let arm = match Emulator::of_version(&bench, host, USUAL_PORTS, version) {
        Ok(arm) => Arc::new(arm),
        Err(error @ WireError::Listen { .. }) => {
            skip(Need::PublicClients, error);
            return None;
        }
        Err(error) => panic!("{error}"),
    };
    arm.set_slider(slider);
    let arm: Arc<dyn Arm> = arm;
    let control = Control::start(&bench, Some(arm), host, 0).expect("a port");
    let port = control.address().port().to_string();
    Some(python::run(
        &python,
        script,
        &[host.to_string(), port, registers.to_owned()],
    ))
}

/// Checks the readings of the client from an arm of `version`.
fn read(last: u8, version: [u32; 2], polyscope: &str) {
    let script = include_str!("ur.py");
    let Some(said) = said("rtde_receive", script, last, version, 0.5, "lower") else {
        return;
    };
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

/// Checks the motions that the client commands through its script on an arm of `version`. `registers` selects the `lower` or `upper` registers.
fn control(last: u8, version: [u32; 2], registers: &str) {
    let script = include_str!("ur_control.py");
    let Some(said) = said("rtde_control", script, last, version, 1.0, registers) else {
        return;
    };
    let expected = [
        // Connected, the program runs, power and program in the status.
        "True True 3",
        "True 0.3 0.002 0.268 3.1416 0.0 0.0",
        "True 0.302 -0.004 0.268 3.1416 0.0 0.0",
        "True 0.3 0.002 0.268 3.1416 0.0 0.0",
        "True 0.302 -0.004 0.268 3.1416 0.0 0.0",
        "0.0 0.0 0.0 0.0 0.0 0.0",
        // A motion under way, and after its stop.
        "True True False",
        "False True True",
        // A velocity, and after its stop.
        "True",
        "False True True",
        "True True",
        // Followed targets.
        "True 0.301 0.0 0.267 3.1416 0.0 0.0",
        // A path, then one that is stopped.
        "True 0.3 0.002 0.268 3.1416 0.0 0.0",
        "True True",
        "False True",
        // A collision, and after its end.
        "True",
        "False False True",
        "True",
        "True 0.3 0.0 0.2713 3.1416 0.0 0.0",
        "False 1",
    ];
    assert_eq!(said, expected);
}

#[test]
fn the_public_client_moves_the_speed_slider_and_sets_outputs_of_an_arm() {
    let script = include_str!("ur_io.py");
    let Some(said) = said("rtde_io", script, 24, [5, 11], 1.0, "lower") else {
        return;
    };
    assert_eq!(said, ["True True True", "0.25", "True", "1.0"]);
}

#[test]
fn the_public_client_sees_an_e_series_arm_and_its_dashboard() {
    read(5, [5, 11], "5.11.0.108249");
}

#[test]
fn the_public_client_sees_an_older_arm_and_its_dashboard() {
    read(8, [3, 15], "3.15.0.108249");
}

#[test]
fn the_public_client_moves_and_stops_an_e_series_arm_by_its_script_on_the_controller() {
    control(21, [5, 11], "lower");
}

#[test]
fn the_public_client_moves_and_stops_an_older_arm_by_its_script_on_the_controller() {
    control(22, [3, 15], "lower");
}

#[test]
fn the_public_client_moves_and_stops_an_arm_by_the_upper_registers() {
    control(23, [5, 11], "upper");
}
