//! Measures the time from a force above its limit until the arm stands, over sockets: `trips [TIMES] [SPEED]`, by default 20 at 5 mm/s.
//!
//! In each trip, the tip moves into the gel. A thread reads the transducer 200 times per second and halts the arm at 0.5 N. The times depend on the
//! machine and its load; the emulated arm has no braking distance. The allowed distance is the speed times the stop time that 999 of 1,000 trips
//! keep. `chrt -f 10 target/debug/examples/trips 1000` sets the priority that docs/rig.md names.
//!
//! Exits with 1 if a trip ended without a halt. Also exits with 1 if more than 1 trip in 1,000 takes longer than 50 ms or exceeds the allowed
//! distance.

use std::error::Error;
use std::net::Ipv4Addr;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use taceva_core::{Deadline, ErrorKind, Millimetre, Pose, Rig, Speed};
use taceva_drivers::{Drivers, open};
use taceva_wire::{Arm, BenchOptions, WallBench, sri, xarm};

const LIMIT_N: f64 = 0.5;
/// Interval between readings of the transducer.
const PERIOD: Duration = Duration::from_millis(5);
const PHASES: u32 = 16;
/// Longest allowed time from the exceeded limit to a standing arm, ms.
const LATEST_MS: f64 = 50.0;
/// Interval at which the bench records the true state, ms.
const LOOK_MS: f64 = 1.0;
const PATIENCE: Deadline = Deadline::after(Duration::from_secs(20));

/// `pose` at a height above the gel, mm; negative inside it.
fn at(pose: Pose, height_mm: f64) -> Pose {
    let mut at = pose;
    at.position.z = Millimetre(251.3 + height_mm);
    at
}

#[expect(
    clippy::print_stdout,
    reason = "an example that prints what it measured"
)]
fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let trips: u32 = arguments.next().map_or(Ok(20), |count| count.parse())?;
    let speed_mm_s: f64 = arguments.next().map_or(Ok(5.0), |speed| speed.parse())?;
    let bench = WallBench::start(&BenchOptions::noisy(7))?;
    let arm = xarm::Emulator::start(&bench, xarm::Ports::ANY)?;
    let force = sri::Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0)?;
    let drivers = Drivers::builtin()?;
    let mut rig = Rig::new();
    let mut robot = open(&drivers.robots, &arm.selector().parse()?, &mut rig)?;
    let mut transducer = open(&drivers.forces, &force.selector().parse()?, &mut rig)?;
    let (home, _) = robot.pose(PATIENCE)?;
    transducer.start(PATIENCE)?;
    let [fast, slow] = [Speed::try_new(50.0)?, Speed::try_new(speed_mm_s)?];
    let mut unhalted = 0_u32;
    let (mut took_ms, mut went_mm) = (Vec::new(), Vec::new());
    for trip in 0..trips {
        robot.move_to(at(home, 0.3), fast, PATIENCE)?;
        if let Some(tare) = transducer.tare() {
            tare.zero(PATIENCE)?;
        }
        // Each trip exceeds the limit at another moment between two readings.
        std::thread::sleep(PERIOD * (trip % PHASES) / PHASES);
        bench.watch(Some(LIMIT_N));
        let handle = robot.halt_handle();
        let is_over = AtomicBool::new(false);
        let moved = std::thread::scope(|scope| {
            scope.spawn(|| {
                while !is_over.load(Ordering::Acquire) {
                    // The axes of the transducer equal the axes of the base frame: a pressing force points down.
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
            // The arm reached the end of its path first, or the trip was abandoned without readings.
            unhalted += 1;
        }
        let truth = bench.truth();
        // A reading with a positive error halts the arm before the true force exceeds the limit.
        let took = match (truth.passed, truth.stopped) {
            (Some(passed), Some(stopped)) => stopped.saturating_sub(passed),
            _ => Duration::ZERO,
        };
        took_ms.push(took.as_secs_f64() * 1e3);
        went_mm.push(truth.passed_mm.map_or(0.0, |at| truth.deepest_mm - at));
        robot.clear_halt(PATIENCE)?;
        robot.move_to(at(home, 1.0), fast, PATIENCE)?;
    }
    let [took_ms, went_mm] = [took_ms, went_mm].map(|mut all| {
        all.sort_by(f64::total_cmp);
        all
    });
    let last = took_ms.len().saturating_sub(1);
    let share = |all: &[f64], thousandths: usize| all[(last * thousandths).div_ceil(1000)];
    let [late_ms, far_mm] = [&took_ms, &went_mm].map(|all| share(all, 999));
    // The truth is observed every millisecond, so both times are late by at most that.
    let bound_mm = speed_mm_s * (late_ms + LOOK_MS) * 1e-3;
    println!("| trips | speed | | median | 99 % | 99.9 % | most |");
    println!("|---|---|---|---|---|---|---|");
    for (what, unit, all) in [
        ("stopped after", "ms", &took_ms),
        ("moved on by", "mm", &went_mm),
    ] {
        let [median, most_of, nearly_all] = [500, 990, 999].map(|part| share(all, part));
        println!(
            "| {trips} | {speed_mm_s} mm/s | {what} | {median:.3} {unit} | {most_of:.3} {unit} | {nearly_all:.3} {unit} | {:.3} {unit} |",
            all[last]
        );
    }
    println!("v·t = {bound_mm:.3} mm; {unhalted} trips ended without a halt");
    Ok(
        match unhalted == 0 && late_ms <= LATEST_MS && far_mm <= bound_mm {
            true => ExitCode::SUCCESS,
            false => ExitCode::FAILURE,
        },
    )
}
