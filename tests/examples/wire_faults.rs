//! Plays every fault of the wire bench TIMES times (default 100) on BENCHES benches at once: `wire_faults [TIMES] [NAME] [BENCHES]`. NAME
//! selects the cases whose name begins with it; `all` selects every case.
//!
//! `wire_faults TIMES kill` kills one study TIMES times instead.
//!
//! Exits with 1 if an outcome was forbidden, a robot moved too long after a fault, or more than one halt in 1000 was late. Printed times depend on
//! the machine and its load. Each row states the load.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use taceva_tests::wire::LateCounts;
use taceva_tests::wire::faults::{CASES, Case, Outcome, play, play_kills};

const SEED: u64 = 20_261_123;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let times = arguments.next().map_or(Ok(100), |times| times.parse())?;
    let name = arguments.next().filter(|name| name != "all");
    let name = name.unwrap_or_default();
    let benches: usize = arguments.next().map_or(Ok(1), |benches| benches.parse())?;
    if name == "kill" {
        let presses = play_kills(times, SEED)?;
        println!("killed {times} times: {presses} presses, each recorded once");
        return Ok(ExitCode::SUCCESS);
    }
    println!(
        "| fault | times | studies | ended | in motion, median | 99.9 % | most | allowed | turns late | halts | driver calls within | at rest within | halts late | load |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    let cases: Vec<&Case> = CASES
        .iter()
        .filter(|case| case.name.starts_with(&name))
        .collect();
    let (next, is_well) = (AtomicUsize::new(0), AtomicBool::new(true));
    // Each bench has its own gel, devices and program: studies mostly wait for motion.
    thread::scope(|scope| {
        for _ in 0..benches {
            scope.spawn(|| {
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if !played(case, times) {
                        is_well.store(false, Ordering::Relaxed);
                    }
                }
            });
        }
    });
    Ok(match is_well.into_inner() {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    })
}

/// Plays one case and prints its row. Returns true if no outcome was forbidden.
fn played(case: &Case, times: usize) -> bool {
    let result = play(case, times, SEED);
    let allowed = match case.outcome {
        Outcome::Stopped(most_ms) | Outcome::MayEnd(Some(most_ms)) => format!("{most_ms} ms"),
        Outcome::Unharmed | Outcome::MayEnd(None) => "–".to_owned(),
        Outcome::Left => "0 mm after".to_owned(),
    };
    let halts = &result.halts;
    let load = result
        .load
        .map_or("unknown".to_owned(), |load| format!("{load:.1}"));
    println!(
        "| {} | {} | {} | {} | {:.1} ms | {:.1} ms | {:.1} ms | {allowed} | {} | {} | {:.1} ms | {:.1} ms | {} | {load} |",
        case.name,
        result.times,
        result.studies,
        result.ended,
        result.median_ms(),
        result.most_but_one_in_1000_ms(),
        result.most_ms(),
        by_cause(&result.late),
        halts.halts,
        halts.call_ms,
        halts.rest_ms,
        by_cause(&halts.late)
    );
    for broken in &result.broken {
        println!("{broken}");
    }
    result.broken.is_empty()
}

/// Counts of late events by their cause: the kernel, the program, a device, or unknown.
fn by_cause(late: &LateCounts) -> String {
    let LateCounts {
        kernel,
        program,
        device,
        unknown,
    } = late;
    format!("kernel {kernel}, program {program}, device {device}, unknown {unknown}")
}
