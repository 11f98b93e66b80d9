//! Plays seeds of the fault simulation: `faults [COUNT] [FIRST]`, by default 1,000 from seed 0.
//!
//! Exits with 1 and prints the failing seeds if an invariant was violated or a kind of fault hardly occurred. `faults 1 SEED` repeats one
//! seed.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::error::Error;
use std::process::ExitCode;
use std::thread;

use taceva_simulation::simulation::{Checks, FaultCounts, FaultKind, SimulationReport, simulate};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (count, first) = (number(1_000)?, number(0)?);
    let workers = thread::available_parallelism().map_or(1, |workers| workers.get() as u64);
    let reports: Vec<SimulationReport> = thread::scope(|scope| {
        let threads: Vec<_> = (0..workers)
            .map(|worker| {
                let seeds = (first..first + count).skip(usize::try_from(worker).unwrap_or(0));
                let seeds = seeds.step_by(usize::try_from(workers).unwrap_or(1));
                scope.spawn(move || seeds.map(simulate).collect::<Vec<_>>())
            })
            .collect();
        threads
            .into_iter()
            .flat_map(|thread| thread.join().unwrap_or_default())
            .collect()
    });
    Ok(summary(&reports, count))
}

fn summary(reports: &[SimulationReport], count: u64) -> ExitCode {
    let mut struck = FaultCounts::default();
    let mut checks = Checks::default();
    let (mut processes, mut simulated_s) = (0_u64, 0.0);
    for report in reports {
        struck.add(&report.struck);
        checks.join(&report.checks);
        processes += u64::from(report.processes);
        simulated_s += report.simulated_s;
    }
    println!(
        "simulated rigs: {} of {count} seeds, {processes} processes, {:.1} h of simulated time",
        reports.len(),
        simulated_s / 3600.0
    );
    let mut all_struck = true;
    for kind in FaultKind::ALL {
        let seeds = reports
            .iter()
            .filter(|report| report.struck.of(kind) > 0)
            .count();
        println!(
            "  {:<16} struck {:>8} calls in {seeds:>6} seeds",
            kind.name(),
            struck.of(kind)
        );
        // A rare fault was hardly tested.
        all_struck &= seeds as u64 >= count / 100;
    }
    println!(
        "  {} motions within limits, greatest force {:.3} of the stated limit",
        checks.motions, checks.greatest_force
    );
    println!(
        "  {} halts after a hazard, slowest {:.1} ms",
        checks.halts,
        checks.slowest_halt_s * 1e3
    );
    println!("  {} samples compared with the truth", checks.samples);
    println!(
        "  {} presses interrupted by silence and repeated",
        checks.redone
    );
    let failing: Vec<&SimulationReport> = reports
        .iter()
        .filter(|report| !report.violations.is_empty())
        .collect();
    for report in failing.iter().take(10) {
        println!("seed {}: {}", report.seed, report.violations[0]);
    }
    println!("violations: {} seeds", failing.len());
    if !all_struck {
        println!("a kind of fault occurred in fewer than 1 % of the seeds");
    }
    if failing.is_empty() && all_struck && reports.len() as u64 == count {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
