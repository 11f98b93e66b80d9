//! Shares of 95 % intervals that contain the score expected for endless data, as a table for `docs/coverage.md`.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

#[path = "../tests/tasks/simulated.rs"]
mod simulated;

use simulated::{Cluster, Held, Strokes};

/// Number of simulated recordings for each row of the table.
const RUNS: u32 = 1000;

fn main() {
    println!("| slip | strokes | score | expected | by stroke | by frame |");
    println!("|---|---|---|---|---|---|");
    for rate in [0.05, 0.3, 0.5] {
        for strokes in [20, 40] {
            let strokes = Strokes { rate, strokes };
            let by_stroke = strokes.held(Cluster::Stroke, RUNS);
            let by_frame = strokes.held(Cluster::Frame, RUNS);
            for (at, metric) in simulated::METRICS.iter().enumerate() {
                println!(
                    "| {rate} | {} | {metric} | {:.4} | {} | {} |",
                    strokes.strokes,
                    strokes.expected()[at],
                    shown(by_stroke[at]),
                    shown(by_frame[at])
                );
            }
        }
    }
}

/// Share as text, with the number of runs without an interval; a dash if no interval was computed.
fn shown(held: Held) -> String {
    match (held.intervals, RUNS - held.intervals) {
        (0, _) => "–".to_owned(),
        (_, 0) => format!("{:.3}", held.share()),
        (_, without) => format!("{:.3} ({without} without an interval)", held.share()),
    }
}
