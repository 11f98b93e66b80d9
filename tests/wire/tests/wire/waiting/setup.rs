//! Setup of an emulated robot over a gel without noise, and tests that every robot must pass.

use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_conformance::{self as conformance, Trial};
use taceva_core::{DriverError, ErrorKind, Factory, Rig, Robot, RobotWatch};
use taceva_wire::{Arm, BenchOptions, WallBench, WireError};

use crate::waiting::support::{PATIENCE, lower, speed};

/// An emulated robot with its simulated gel and its driver. `E` is the type of the emulator.
pub(crate) struct Setup<E> {
    pub(crate) bench: WallBench,
    pub(crate) emulator: E,
    factory: Box<dyn Factory<dyn Robot>>,
    arguments: String,
}

impl<E> Setup<E> {
    /// Starts an emulated robot for the driver of `factory`. `arguments` returns the driver arguments for the emulator.
    pub(crate) fn with_arguments(
        factory: impl Factory<dyn Robot> + 'static,
        start: impl FnOnce(&WallBench) -> Result<E, WireError>,
        arguments: impl FnOnce(&E) -> String,
    ) -> Setup<E> {
        let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
        let emulator = start(&bench).expect("a robot");
        Setup {
            bench,
            arguments: arguments(&emulator),
            emulator,
            factory: Box::new(factory),
        }
    }

    /// Driver arguments of this robot.
    pub(crate) fn arguments(&self) -> &str {
        &self.arguments
    }

    /// Opens the driver with `arguments`.
    pub(crate) fn opened(&self, arguments: &str) -> Result<Box<dyn Robot>, DriverError> {
        let args = self.factory.descriptor().args(arguments).expect("good");
        self.factory.open(&args, &mut Rig::new())
    }

    /// Opens the driver of this robot; may fail.
    pub(crate) fn try_open(&self) -> Result<Box<dyn Robot>, DriverError> {
        self.opened(&self.arguments)
    }

    /// Opens the driver of this robot.
    pub(crate) fn open(&self) -> Box<dyn Robot> {
        self.try_open().expect("a robot")
    }

    /// Tests that the driver passes the suite of all robots.
    pub(crate) fn passes_the_suite(&self) {
        let trial = Trial::with_arguments(self.arguments.clone());
        let report = conformance::robot(&*self.factory, &trial);
        assert!(report.passed(), "{report}");
    }

    /// Tests that a halt from another thread stops the robot within `most`. The robot stays halted until the halt is cleared, and keeps its position.
    pub(crate) fn is_halted_within(&self, most: Duration) {
        let mut robot = self.open();
        let (home, _) = robot.pose(PATIENCE).expect("a pose");
        let handle = robot.halt_handle();
        let bench = self.bench.clone();
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
        let moved = robot.move_to(lower(home, 15.0), speed(5.0), PATIENCE);
        assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
        let took = halting.join().expect("halted");
        assert!(took < most, "{took:?}");
        let refused = robot.move_to(home, speed(5.0), PATIENCE);
        assert_eq!(refused.expect_err("latched").kind(), ErrorKind::Interrupted);
        robot.clear_halt(PATIENCE).expect("nothing else is wrong");
        assert!(!self.bench.truth().is_moving);
        robot
            .move_to(home, speed(20.0), PATIENCE)
            .expect("it arrives");
        let (back, _) = robot.pose(PATIENCE).expect("a pose");
        let apart_mm = back.position.z.0 - home.position.z.0;
        assert!(apart_mm.abs() < 0.02, "{apart_mm}");
    }

    /// Tests that another thread can observe a motion of the robot. Returns the robot and its watch handle.
    pub(crate) fn is_seen_to_move(&self) -> (Box<dyn Robot>, Arc<dyn RobotWatch>) {
        let mut robot = self.open();
        let watch = robot.watch_handle().expect("a robot that reports");
        let (home, _) = robot.pose(PATIENCE).expect("a pose");
        let seen = std::thread::scope(|scope| {
            let moving = scope.spawn(|| robot.move_to(lower(home, 10.0), speed(20.0), PATIENCE));
            let mut seen = Vec::new();
            while !moving.is_finished() {
                let (pose, stamp) = watch.pose(PATIENCE).expect("a report");
                seen.push((stamp.valid_s, pose.position.z.0));
            }
            moving.join().expect("no panic").expect("it arrives");
            seen
        });
        assert!(seen.is_sorted_by(|one, other| one.0 < other.0), "{seen:?}");
        let between =
            |(_, z): &&(f64, f64)| *z < home.position.z.0 - 1.0 && *z > home.position.z.0 - 9.0;
        // Half a second of motion at a hundred reports per second; a busy machine skips some.
        assert!(seen.iter().filter(between).count() >= 5, "{seen:?}");
        (robot, watch)
    }
}

impl<E: Arm> Setup<E> {
    /// Starts a robot for the driver of `factory`, with the arguments of its emulator.
    pub(crate) fn new(
        factory: impl Factory<dyn Robot> + 'static,
        start: impl FnOnce(&WallBench) -> Result<E, WireError>,
    ) -> Setup<E> {
        Setup::with_arguments(factory, start, |emulator| {
            let selector = emulator.selector();
            let (_, arguments) = selector.split_once(':').expect("a driver and arguments");
            arguments.to_owned()
        })
    }
}
