//! Measures ten million rows. The table states the times of the curves of a ranking, of one sort of its scores, and of a confusion matrix.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use taceva_core::random::SplitMix64;
use taceva_tasks::{Classes, Ranking, TaskError};

const ROWS: u32 = 10_000_000;

fn main() -> Result<(), TaskError> {
    let mut random = SplitMix64::new(1);
    let scores: Vec<f64> = (0..ROWS).map(|_| random.unit()).collect();
    let is_positive: Vec<bool> = scores.iter().map(|score| random.unit() < *score).collect();

    let mut sorted = scores.clone();
    let sort = timed(|| sorted.sort_unstable_by(f64::total_cmp));
    black_box(&sorted);
    let mut ranking = Ranking::default();
    let mut pushed = Ok(());
    let rank = timed(|| {
        pushed = ranking.push_rows("all", &scores, &is_positive);
        black_box(ranking.scores());
    });
    pushed?;
    println!("| 10,000,000 rows | time |");
    println!("|---|---|");
    println!("| sorted once | {:.2} s |", sort.as_secs_f64());
    println!(
        "| `roc_auc` and `average_precision` | {:.2} s, {:.2} of sorting |",
        rank.as_secs_f64(),
        rank.as_secs_f64() / sort.as_secs_f64()
    );

    let truth: Vec<u32> = is_positive.iter().map(|truth| u32::from(*truth)).collect();
    let predicted: Vec<u32> = scores.iter().map(|score| u32::from(*score > 0.5)).collect();
    let mut classes = Classes::new(["no_slip", "slip"], Some("slip"))?;
    let mut pushed = Ok(());
    let count = timed(|| pushed = classes.push_positions("all", &truth, &predicted));
    pushed?;
    black_box(&classes);
    let millions = f64::from(ROWS) / 1e6 / count.as_secs_f64();
    println!(
        "| confusion | {:.3} s, {millions:.0} million rows a second |",
        count.as_secs_f64()
    );
    Ok(())
}

/// Duration of `work`.
fn timed(work: impl FnOnce()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}
