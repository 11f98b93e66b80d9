//! Tests of `gcode/marlin` with the emulated printer, through a pseudo-terminal.

use std::time::Duration;

use taceva_core::{Deadline, ErrorKind};
use taceva_drivers::gcode::marlin::MarlinFactory;
use taceva_wire::marlin::{Emulator, Firmware};
use taceva_wire::{Arm, ArmFault};

use crate::waiting::setup::Setup;
use crate::waiting::support::{PATIENCE, lower, moved, speed};

pub(crate) fn setup() -> Setup<Emulator> {
    of(Firmware::StopsAtOnce)
}

fn of(firmware: Firmware) -> Setup<Emulator> {
    let factory = MarlinFactory::new().expect("a factory");
    Setup::new(factory, |bench| Emulator::start(bench, firmware))
}

#[test]
fn the_suite_passes() {
    setup().passes_the_suite();
}

#[test]
fn an_emulated_printer_reports_that_it_is_one() {
    assert!(setup().open().is_emulated());
}

#[test]
fn the_firmware_of_a_printer_is_a_setting() {
    assert_eq!(setup().open().settings()["firmware"], "Marlin 2.1 emulated");
}

#[test]
fn a_press_reaches_the_gel_and_a_turn_is_refused() {
    setup().presses_and_does_not_turn();
}

#[test]
fn a_line_that_arrives_damaged_is_sent_again_and_no_more_than_four_times() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    setup.emulator.damage(2);
    let arrived = printer.move_to(lower(home, 20.6), speed(20.0), PATIENCE);
    arrived.expect("it arrives");
    let truth = setup.bench.truth();
    assert!((truth.tip_mm[2] - 0.6).abs() < 1e-4, "{truth:?}");
    setup.emulator.damage(100);
    let refused = printer.move_to(home, speed(20.0), PATIENCE);
    let said = refused.expect_err("a broken cable").to_string();
    assert!(said.contains("arrived damaged 4 times"), "{said}");
    assert!(!setup.bench.truth().is_moving);
    setup.emulator.damage(0);
    let arrived = printer.move_to(home, speed(20.0), PATIENCE);
    arrived.expect("the cable is replaced");
}

#[test]
fn a_printer_that_restarted_is_a_fault_and_moves_nothing() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    let arrived = printer.move_to(lower(home, 2.0), speed(20.0), PATIENCE);
    arrived.expect("it arrives");
    setup.emulator.restart();
    let before = setup.bench.truth();
    let refused = printer.move_to(home, speed(20.0), PATIENCE);
    let error = refused.expect_err("its position is lost");
    assert_eq!(error.kind(), ErrorKind::DeviceFault, "{error}");
    let said = error.to_string();
    assert!(
        said.contains("line 1 instead of 4") && said.contains("home it by hand"),
        "{said}"
    );
    let bits = |at: [f64; 3]| at.map(f64::to_bits);
    assert_eq!(bits(setup.bench.truth().tip_mm), bits(before.tip_mm));
}

#[test]
fn a_halt_stops_the_printer_at_once_and_it_goes_on_afterwards() {
    setup().is_halted_within(Duration::from_millis(100));
}

#[test]
fn an_error_of_the_firmware_ends_the_motion_and_nothing_is_cleared() {
    let setup = setup();
    let mut printer = setup.open();
    let (moved, _) = moved(&setup.bench, &mut *printer, || {
        setup.emulator.suffer(ArmFault::Collision);
    });
    assert_eq!(moved.kind(), ErrorKind::DeviceFault, "{moved}");
    assert!(moved.to_string().contains("kill() called"), "{moved}");
    let cleared = printer.clear_halt(PATIENCE).expect_err("it stays killed");
    assert_eq!(cleared.kind(), ErrorKind::Timeout, "{cleared}");
    assert!(!setup.bench.truth().is_moving);
}

#[test]
fn an_error_that_the_firmware_said_at_rest_is_met_by_the_next_motion() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    setup.emulator.suffer(ArmFault::Collision);
    // The printer reports the fault once, while nobody reads.
    std::thread::sleep(Duration::from_millis(100));
    let moved = printer.move_to(lower(home, 1.0), speed(5.0), PATIENCE);
    let moved = moved.expect_err("killed");
    assert_eq!(moved.kind(), ErrorKind::DeviceFault, "{moved}");
    assert!(moved.to_string().contains("kill() called"), "{moved}");
}

#[test]
fn a_motion_that_is_given_up_is_stopped_and_the_next_one_arrives() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    for _ in 0..3 {
        let brief = Deadline::after(Duration::from_millis(300));
        let moved = printer.move_to(lower(home, 15.0), speed(5.0), brief);
        assert_eq!(moved.expect_err("too brief").kind(), ErrorKind::Timeout);
        assert!(!setup.bench.truth().is_moving);
        let (stopped, _) = printer.pose(PATIENCE).expect("a pose");
        let lower_mm = home.position.z.0 - stopped.position.z.0;
        assert!((0.5..5.0).contains(&lower_mm), "{lower_mm}");
        printer
            .move_to(home, speed(20.0), PATIENCE)
            .expect("it arrives");
        let (back, _) = printer.pose(PATIENCE).expect("a pose");
        assert!((back.position.z.0 - home.position.z.0).abs() < 0.02);
    }
}

#[test]
fn a_motion_whose_wait_is_lost_is_stopped_and_does_not_count_as_ended() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    setup.emulator.lose("M400");
    let moved = printer.move_to(lower(home, 15.0), speed(1.0), PATIENCE);
    let error = moved.expect_err("nothing says when it rests");
    assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
    let truth = setup.bench.truth();
    assert!(!truth.is_moving, "{truth:?}");
}

#[test]
fn firmware_without_an_echo_is_refused_by_that_command() {
    let refused = of(Firmware::WithoutEcho).try_open().map(drop);
    let said = refused.expect_err("refused").to_string();
    assert!(said.contains("`M118` was refused"), "{said}");
}

#[test]
fn firmware_that_stops_in_turn_is_refused() {
    let refused = of(Firmware::StopsInTurn)
        .try_open()
        .map(drop)
        .expect_err("refused");
    assert_eq!(refused.kind(), ErrorKind::Unsupported);
    assert!(
        refused.to_string().contains("EMERGENCY_PARSER"),
        "{refused}"
    );
}

#[test]
fn a_printer_that_falls_silent_on_its_way_is_stopped() {
    setup().is_held_once_silent_for(7_000);
}

#[test]
fn what_is_no_printer_is_refused() {
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
