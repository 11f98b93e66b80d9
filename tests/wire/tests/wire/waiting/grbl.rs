//! Tests of `gcode/grbl` with the emulated machine, through a pseudo-terminal.

use std::time::Duration;

use taceva_core::ErrorKind;
use taceva_drivers::gcode::grbl::GrblFactory;
use taceva_wire::grbl::Emulator;
use taceva_wire::{Arm, ArmFault};

use crate::waiting::setup::Setup;
use crate::waiting::support::{PATIENCE, lower, speed};

pub(crate) fn setup() -> Setup<Emulator> {
    let factory = GrblFactory::new().expect("a factory");
    Setup::new(factory, Emulator::start)
}

#[test]
fn the_suite_passes() {
    setup().passes_the_suite();
}

#[test]
fn the_version_of_a_machine_is_a_setting() {
    assert_eq!(setup().open().settings()["firmware"], "1.1h.20190825");
}

#[test]
fn a_machine_in_the_hold_of_an_earlier_run_states_its_version_and_keeps_its_place() {
    let setup = setup();
    let mut machine = setup.open();
    machine.halt_handle().halt().expect("sent");
    let (held, _) = machine.pose(PATIENCE).expect("a pose");
    drop(machine);
    let mut again = setup.open();
    assert_eq!(again.settings()["firmware"], "1.1h.20190825");
    let (found, _) = again.pose(PATIENCE).expect("a pose");
    assert_eq!(found, held);
}

#[test]
fn a_press_reaches_the_gel_and_a_turn_is_refused() {
    setup().presses_and_does_not_turn();
}

#[test]
fn a_halt_stops_the_machine_at_once_and_its_end_loses_no_place() {
    setup().is_halted_within(Duration::from_millis(100));
}

#[test]
fn an_alarm_is_a_fault_that_nobody_but_a_person_ends() {
    let setup = setup();
    let mut machine = setup.open();
    let (home, _) = machine.pose(PATIENCE).expect("a pose");
    setup.emulator.suffer(ArmFault::Collision);
    let moved = machine.move_to(lower(home, 1.0), speed(5.0), PATIENCE);
    let moved = moved.expect_err("alarm");
    assert_eq!(moved.kind(), ErrorKind::DeviceFault);
    assert!(moved.to_string().contains("in alarm"), "{moved}");
    let cleared = machine.clear_halt(PATIENCE).expect_err("alarm");
    assert_eq!(cleared.kind(), ErrorKind::DeviceFault);
}

#[test]
fn a_machine_that_falls_silent_on_its_way_is_held() {
    setup().is_held_once_silent_for(2_000);
}

#[test]
fn what_is_no_machine_is_refused() {
    setup().refuses_what_is_no_line();
}

#[cfg(target_os = "linux")]
#[test]
fn a_line_that_another_program_has_open_without_a_lock_is_warned_of() {
    setup().warns_of_another_that_has_it_open();
}

#[test]
fn a_line_that_another_program_has_is_refused_as_busy() {
    setup().is_busy_while_another_has_it();
}
