//! Coverage of 95 % intervals in simulated presses: the share of intervals that contain the score of infinitely many samples.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

#[path = "../tests/metrics/support/simulation.rs"]
mod simulation;

use std::ops::Range;
use std::thread;

use simulation::{CORRELATION, Coverage, Design, Each, METRICS, Method, coverage, expected};
use taceva_metrics::{BootstrapEnds, PoissonBootstrap};

/// Numbers of locations and of presses at each location.
const DESIGNS: [(u32, u32); 16] = [
    (5, 4),
    (6, 4),
    (8, 4),
    (10, 1),
    (10, 4),
    (10, 20),
    (12, 1),
    (12, 4),
    (12, 20),
    (20, 1),
    (20, 4),
    (32, 1),
    (32, 4),
    (46, 1),
    (46, 4),
    (400, 4),
];
/// Designs for the comparison with the other interval methods.
const COMPARED: [(u32, u32); 3] = [(12, 20), (46, 1), (400, 4)];
const RUNS: u32 = 1500;
const METHODS: [Method; 4] = [
    Method::Jackknife,
    Method::JackknifeBySample,
    Method::Bootstrap(PoissonBootstrap::DEFAULT.with_ends(BootstrapEnds::Normal)),
    Method::Bootstrap(PoissonBootstrap::DEFAULT.with_ends(BootstrapEnds::Percentile)),
];

fn main() {
    let threads = thread::available_parallelism().map_or(1, |threads| threads.get());
    println!(
        "Simulated presses, not measurements: the sizes of errors at one location correlate by {CORRELATION}; {RUNS} runs per row."
    );
    let expected: Vec<String> = METRICS
        .iter()
        .zip(expected())
        .map(|((metric, label), value)| format!("{metric} {label} {value:.5}"))
        .collect();
    println!(
        "Scores of infinitely many samples: {}.\n",
        expected.join(", ")
    );
    let names = METRICS.map(|(metric, label)| format!("{metric} {label}"));
    println!("| locations × presses | interval | {} |", names.join(" | "));
    println!("|---|---|{}", "---|".repeat(METRICS.len()));
    for (locations, presses) in DESIGNS {
        let design = Design { locations, presses };
        let is_compared = COMPARED.contains(&(locations, presses));
        let methods = METHODS.into_iter();
        for method in methods.filter(|method| is_compared || *method == Method::Jackknife) {
            let found = in_parallel(threads, |runs| coverage(design, method, runs));
            println!(
                "| {locations} × {presses} | {} | {} |",
                name(method),
                found.map(cell).join(" | ")
            );
        }
    }
}

/// Sum over all runs, independent of the number of threads.
fn in_parallel(
    threads: usize,
    coverage: impl Fn(Range<u32>) -> Each<Coverage> + Sync,
) -> Each<Coverage> {
    let share = RUNS.div_ceil(u32::try_from(threads).unwrap_or(RUNS).max(1));
    let starts = (0..RUNS).step_by(share as usize);
    let coverage = &coverage;
    thread::scope(|scope| {
        let threads: Vec<_> = starts
            .map(|start| scope.spawn(move || coverage(start..(start + share).min(RUNS))))
            .collect();
        let mut sum = Each::<Coverage>::default();
        for thread in threads {
            let part = thread.join().expect("a run does not panic");
            sum.iter_mut()
                .zip(part)
                .for_each(|(sum, part)| *sum += part);
        }
        sum
    })
}

fn name(method: Method) -> &'static str {
    match method {
        Method::Jackknife => "jackknife by point",
        Method::JackknifeBySample => "jackknife by sample",
        Method::Bootstrap(bootstrap) => match bootstrap.ends {
            BootstrapEnds::Percentile => "Poisson bootstrap by point, percentile",
            _ => "Poisson bootstrap by point, normal",
        },
    }
}

fn cell(coverage: Coverage) -> String {
    match RUNS - coverage.intervals {
        0 => format!("{:.3}", coverage.share()),
        RUNS => "–".to_owned(),
        without => format!("{:.3} ({without} without an interval)", coverage.share()),
    }
}
