//! `gcode/marlin` against the emulated printer, through a pseudo-terminal.

use std::time::{Duration, Instant};

use taceva_core::{Deadline, DriverError, ErrorKind, Factory, Rig, Robot};
use taceva_drivers::MarlinFactory;
use taceva_drivers::conformance::{self, Trial};
use taceva_wire::marlin::{Emulator, Firmware};
use taceva_wire::{Arm, ArmFault, BenchOptions, Device, Fault, FaultKind, WallBench};

use crate::support::{PATIENCE, lower, speed};

struct Setup {
    bench: WallBench,
    printer: Emulator,
}

fn setup() -> Setup {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let printer = Emulator::start(&bench, Firmware::StopsAtOnce).expect("a printer");
    Setup { bench, printer }
}

fn opened(arguments: &str) -> Result<Box<dyn Robot>, DriverError> {
    let factory = MarlinFactory::new().expect("a factory");
    let args = factory.descriptor().args(arguments).expect("good");
    factory.open(&args, &mut Rig::new())
}

impl Setup {
    fn arguments(&self) -> String {
        let selector = self.printer.selector();
        let (_, arguments) = selector.split_once(':').expect("a driver and arguments");
        arguments.to_owned()
    }

    fn open(&self) -> Box<dyn Robot> {
        opened(&self.arguments()).expect("a printer")
    }
}

#[test]
fn the_suite_passes() {
    let setup = setup();
    let factory = MarlinFactory::new().expect("a factory");
    let trial = Trial::with_arguments(setup.arguments());
    let report = conformance::robot(&factory, &trial);
    assert!(report.passed(), "{report}");
}

#[test]
fn a_press_reaches_the_gel_and_a_turn_is_refused() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    printer
        .move_to(lower(home, 20.6), speed(20.0), PATIENCE)
        .expect("it arrives");
    let truth = setup.bench.truth();
    assert!((truth.tip_mm[2] - 0.6).abs() < 1e-4, "{truth:?}");
    assert!(truth.force_n[2] > 0.1, "{truth:?}");
    let mut turned = home;
    turned.rotation.z.0 = 10.0;
    let refused = printer.move_to(turned, speed(5.0), PATIENCE);
    assert_eq!(refused.expect_err("a turn").kind(), ErrorKind::OutOfRange);
}

#[test]
fn a_halt_stops_the_printer_at_once_and_it_goes_on_afterwards() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    let handle = printer.halt_handle();
    let bench = setup.bench.clone();
    let halting = std::thread::spawn(move || {
        while !bench.truth().is_moving {
            std::thread::yield_now();
        }
        let called = Instant::now();
        handle.halt().expect("it is sent");
        while bench.truth().is_moving {
            assert!(called.elapsed().as_millis() < 500, "it moves on");
        }
        called.elapsed()
    });
    let moved = printer.move_to(lower(home, 15.0), speed(5.0), PATIENCE);
    assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
    let took = halting.join().expect("halted");
    assert!(took.as_millis() < 100, "{took:?}");
    printer.clear_halt(PATIENCE).expect("nothing else is wrong");
    assert!(!setup.bench.truth().is_moving);
    printer
        .move_to(home, speed(20.0), PATIENCE)
        .expect("it arrives");
}

#[test]
fn an_error_of_the_firmware_ends_the_motion_and_nothing_is_cleared() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    let moved = std::thread::scope(|scope| {
        scope.spawn(|| {
            while !setup.bench.truth().is_moving {
                std::thread::yield_now();
            }
            setup.printer.suffer(ArmFault::Collision);
        });
        printer.move_to(lower(home, 10.0), speed(5.0), PATIENCE)
    });
    let moved = moved.expect_err("killed");
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
    setup.printer.suffer(ArmFault::Collision);
    // It is said once, and nobody listens.
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
fn firmware_that_stops_in_turn_is_refused() {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let printer = Emulator::start(&bench, Firmware::StopsInTurn).expect("a printer");
    let selector = printer.selector();
    let (_, arguments) = selector.split_once(':').expect("a driver and arguments");
    let refused = opened(arguments).map(drop).expect_err("refused");
    assert_eq!(refused.kind(), ErrorKind::Unsupported);
    assert!(
        refused.to_string().contains("EMERGENCY_PARSER"),
        "{refused}"
    );
}

#[test]
fn a_printer_that_falls_silent_on_its_way_is_stopped() {
    let setup = setup();
    let mut printer = setup.open();
    let (home, _) = printer.pose(PATIENCE).expect("a pose");
    let moved = std::thread::scope(|scope| {
        scope.spawn(|| {
            while !setup.bench.truth().is_moving {
                std::thread::yield_now();
            }
            setup.bench.inject(Fault {
                device: Device::Robot,
                kind: FaultKind::Silent,
                lasts: Duration::from_secs(7),
            });
        });
        printer.move_to(lower(home, 18.0), speed(5.0), PATIENCE)
    });
    assert_eq!(moved.expect_err("silent").kind(), ErrorKind::Timeout);
    assert!(!setup.bench.truth().is_moving);
}

#[test]
fn what_is_no_printer_is_refused() {
    let file = tempfile::NamedTempFile::new().expect("a file");
    let path = file.path().display();
    let kind = |arguments: &str| match opened(arguments) {
        Ok(_) => panic!("opened {arguments}"),
        Err(error) => error.kind(),
    };
    assert_eq!(kind(&format!("port={path}")), ErrorKind::InvalidArgument);
    assert_eq!(kind("port=/dev/no-such-line"), ErrorKind::NotFound);
    assert_eq!(kind("port=/dev/null"), ErrorKind::InvalidArgument);
}
