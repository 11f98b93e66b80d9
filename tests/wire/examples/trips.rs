//! How long it takes from a force above its limit until the arm stands, over sockets: `cargo run -p taceva-wire --example trips -- 100`.
//!
//! One uninterrupted motion of 5 mm/s into the gel; a thread reads the transducer 200 times a second and halts the arm at 0.5 N. What is printed
//! is of this machine as busy as it is, and of an arm that has no braking way.

use std::error::Error;
use std::net::Ipv4Addr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use taceva_core::{Deadline, ErrorKind, Millimetre, Pose, Rig, Speed};
use taceva_drivers::{Drivers, open};
use taceva_wire::{Arm, BenchOptions, WallBench, sri, xarm};

const LIMIT_N: f64 = 0.5;
/// Between two readings.
const PERIOD: Duration = Duration::from_millis(5);
const PHASES: u32 = 16;
const PATIENCE: Deadline = Deadline::after(Duration::from_secs(20));

/// `pose` at a height above the gel, in mm; below 0 in it.
fn at(pose: Pose, height_mm: f64) -> Pose {
    let mut at = pose;
    at.position.z = Millimetre(251.3 + height_mm);
    at
}

#[expect(
    clippy::print_stdout,
    reason = "an example that prints what it measured"
)]
fn main() -> Result<(), Box<dyn Error>> {
    let trips: u32 = std::env::args()
        .nth(1)
        .map_or(Ok(20), |count| count.parse())?;
    let bench = WallBench::start(&BenchOptions::noisy(7))?;
    let arm = xarm::Emulator::start(&bench, xarm::Ports::ANY)?;
    let force = sri::Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0)?;
    let drivers = Drivers::builtin()?;
    let mut rig = Rig::new();
    let mut robot = open(&drivers.robots, &arm.selector().parse()?, &mut rig)?;
    let mut transducer = open(&drivers.forces, &force.selector().parse()?, &mut rig)?;
    let (home, _) = robot.pose(PATIENCE)?;
    transducer.start(PATIENCE)?;
    let [fast, slow] = [Speed::try_new(50.0)?, Speed::try_new(5.0)?];
    let mut took_ms = Vec::new();
    let mut deepest_mm: f64 = 0.0;
    for trip in 0..trips {
        robot.move_to(at(home, 0.3), fast, PATIENCE)?;
        if let Some(tare) = transducer.tare() {
            tare.zero(PATIENCE)?;
        }
        // The limit is passed at another moment between two readings each time.
        std::thread::sleep(PERIOD * (trip % PHASES) / PHASES);
        bench.watch(Some(LIMIT_N));
        let handle = robot.halt_handle();
        let is_over = AtomicBool::new(false);
        let moved = std::thread::scope(|scope| {
            scope.spawn(|| {
                while !is_over.load(Ordering::Acquire) {
                    // The transducer is mounted as the base frame lies: what presses into the gel points down.
                    let reading = transducer.read(PATIENCE);
                    if reading.is_ok_and(|(wrench, _)| -wrench.force[2].0 > LIMIT_N) {
                        let _ = handle.halt();
                        return;
                    }
                }
            });
            let moved = robot.move_to(at(home, -1.0), slow, PATIENCE);
            is_over.store(true, Ordering::Release);
            moved
        });
        if !moved.is_err_and(|error| error.kind() == ErrorKind::Interrupted) {
            return Err("a trip that was not halted".into());
        }
        let truth = bench.truth();
        // A reading that errs upwards halts the arm before the limit is truly passed.
        let took = match (truth.passed, truth.stopped) {
            (Some(passed), Some(stopped)) => stopped.saturating_sub(passed),
            _ => Duration::ZERO,
        };
        took_ms.push(took.as_secs_f64() * 1e3);
        deepest_mm = deepest_mm.max(truth.deepest_mm);
        robot.clear_halt(PATIENCE)?;
        robot.move_to(at(home, 5.0), fast, PATIENCE)?;
    }
    took_ms.sort_by(f64::total_cmp);
    let last = took_ms.len().saturating_sub(1);
    let share = |percent: usize| took_ms[last * percent / 100];
    println!(
        "{trips} trips: limit passed to arm stopped, median {:.1} ms, 90 % {:.1} ms, most {:.1} ms; deepest {deepest_mm:.3} mm",
        share(50),
        share(90),
        took_ms[last]
    );
    Ok(())
}
