//! `gcode/grbl` against the emulated machine, through a pseudo-terminal.

use std::time::{Duration, Instant};

use taceva_core::{DriverError, ErrorKind, Factory, Rig, Robot};
use taceva_drivers::GrblFactory;
use taceva_drivers::conformance::{self, Trial};
use taceva_wire::grbl::Emulator;
use taceva_wire::{Arm, ArmFault, BenchOptions, Device, Fault, FaultKind, WallBench};

use crate::support::{PATIENCE, lower, speed};

struct Setup {
    bench: WallBench,
    machine: Emulator,
}

fn setup() -> Setup {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let machine = Emulator::start(&bench).expect("a machine");
    Setup { bench, machine }
}

fn opened(arguments: &str) -> Result<Box<dyn Robot>, DriverError> {
    let factory = GrblFactory::new().expect("a factory");
    let args = factory.descriptor().args(arguments).expect("good");
    factory.open(&args, &mut Rig::new())
}

impl Setup {
    fn arguments(&self) -> String {
        let selector = self.machine.selector();
        let (_, arguments) = selector.split_once(':').expect("a driver and arguments");
        arguments.to_owned()
    }

    fn open(&self) -> Box<dyn Robot> {
        opened(&self.arguments()).expect("a machine")
    }
}

#[test]
fn the_suite_passes() {
    let setup = setup();
    let factory = GrblFactory::new().expect("a factory");
    let trial = Trial::with_arguments(setup.arguments());
    let report = conformance::robot(&factory, &trial);
    assert!(report.passed(), "{report}");
}

#[test]
fn a_press_reaches_the_gel_and_a_turn_is_refused() {
    let setup = setup();
    let mut machine = setup.open();
    let (home, _) = machine.pose(PATIENCE).expect("a pose");
    machine
        .move_to(lower(home, 20.6), speed(20.0), PATIENCE)
        .expect("it arrives");
    let truth = setup.bench.truth();
    assert!((truth.tip_mm[2] - 0.6).abs() < 1e-4, "{truth:?}");
    assert!(truth.force_n[2] > 0.1, "{truth:?}");
    let mut turned = home;
    turned.rotation.z.0 = 10.0;
    let refused = machine.move_to(turned, speed(5.0), PATIENCE);
    assert_eq!(refused.expect_err("a turn").kind(), ErrorKind::OutOfRange);
}

#[test]
fn a_halt_stops_the_machine_at_once_and_its_end_loses_no_place() {
    let setup = setup();
    let mut machine = setup.open();
    let (home, _) = machine.pose(PATIENCE).expect("a pose");
    let handle = machine.halt_handle();
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
    let moved = machine.move_to(lower(home, 15.0), speed(5.0), PATIENCE);
    assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
    let took = halting.join().expect("halted");
    assert!(took.as_millis() < 100, "{took:?}");
    machine.clear_halt(PATIENCE).expect("nothing else is wrong");
    assert!(!setup.bench.truth().is_moving);
    machine
        .move_to(home, speed(20.0), PATIENCE)
        .expect("it arrives");
}

#[test]
fn an_alarm_is_a_fault_that_nobody_but_a_person_ends() {
    let setup = setup();
    let mut machine = setup.open();
    let (home, _) = machine.pose(PATIENCE).expect("a pose");
    setup.machine.suffer(ArmFault::Collision);
    let moved = machine.move_to(lower(home, 1.0), speed(5.0), PATIENCE);
    let moved = moved.expect_err("alarm");
    assert_eq!(moved.kind(), ErrorKind::DeviceFault);
    assert!(moved.to_string().contains("in alarm"), "{moved}");
    let cleared = machine.clear_halt(PATIENCE).expect_err("alarm");
    assert_eq!(cleared.kind(), ErrorKind::DeviceFault);
}

#[test]
fn a_machine_that_falls_silent_on_its_way_is_held() {
    let setup = setup();
    let mut machine = setup.open();
    let (home, _) = machine.pose(PATIENCE).expect("a pose");
    let moved = std::thread::scope(|scope| {
        scope.spawn(|| {
            while !setup.bench.truth().is_moving {
                std::thread::yield_now();
            }
            setup.bench.inject(Fault {
                device: Device::Robot,
                kind: FaultKind::Silent,
                lasts: Duration::from_secs(2),
            });
        });
        machine.move_to(lower(home, 18.0), speed(5.0), PATIENCE)
    });
    assert_eq!(moved.expect_err("silent").kind(), ErrorKind::Timeout);
    assert!(!setup.bench.truth().is_moving);
}

#[test]
fn what_is_no_machine_is_refused() {
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
