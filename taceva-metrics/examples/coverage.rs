//! How often 95 % intervals hold the score of infinitely many samples, in simulated presses.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

#[path = "../tests/support/simulated.rs"]
mod simulated;

use std::ops::Range;
use std::thread;

use simulated::{CORRELATION, Coverage, Design, METRICS, Method, coverage, expected};
use taceva_metrics::BootstrapEnds;

const DESIGNS: [Design; 3] = [
    Design {
        locations: 400,
        presses: 4,
    },
    Design {
        locations: 46,
        presses: 1,
    },
    Design {
        locations: 12,
        presses: 20,
    },
];
const RUNS: u32 = 1500;

fn main() {
    let threads = thread::available_parallelism().map_or(1, |threads| threads.get());
    println!(
        "Simulated presses, not measurements: the sizes of errors at one location correlate by {CORRELATION}; {RUNS} runs a row."
    );
    let expected: Vec<String> = METRICS
        .iter()
        .zip(expected())
        .map(|(metric, value)| format!("{metric} {value:.5}"))
        .collect();
    println!("Expected of infinitely many: {}.\n", expected.join(", "));
    println!(
        "| locations × presses | interval | {} |",
        METRICS.join(" | ")
    );
    println!("|---|---|{}", "---|".repeat(METRICS.len()));
    for design in DESIGNS {
        for method in Method::ALL {
            let found = in_parallel(threads, |runs| coverage(design, method, runs));
            let cells: Vec<String> = found.into_iter().map(cell).collect();
            println!(
                "| {} × {} | {} | {} |",
                design.locations,
                design.presses,
                name(method),
                cells.join(" | ")
            );
        }
    }
}

/// The sum over all runs; it is the same for any number of threads.
fn in_parallel(
    threads: usize,
    coverage: impl Fn(Range<u32>) -> [Coverage; 3] + Sync,
) -> [Coverage; 3] {
    let share = RUNS.div_ceil(u32::try_from(threads).unwrap_or(RUNS).max(1));
    let starts = (0..RUNS).step_by(share as usize);
    let coverage = &coverage;
    thread::scope(|scope| {
        let threads: Vec<_> = starts
            .map(|start| scope.spawn(move || coverage(start..(start + share).min(RUNS))))
            .collect();
        let mut sum = [Coverage::default(); 3];
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
        Method::Bootstrap(BootstrapEnds::Percentile) => "Poisson bootstrap by point, percentile",
        Method::Bootstrap(_) => "Poisson bootstrap by point, normal",
    }
}

fn cell(coverage: Coverage) -> String {
    match RUNS - coverage.intervals {
        0 => format!("{:.3}", coverage.share()),
        without => format!("{:.3} ({without} without an interval)", coverage.share()),
    }
}
