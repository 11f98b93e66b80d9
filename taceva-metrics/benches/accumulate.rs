//! Time per pair of exact sums, compared with a rounding loop, and time of whole evaluations with clusters.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use taceva_core::{Batch, Channel, Channels, Column, FieldSet, Labels};
use taceva_metrics::{
    Evaluator, MetricPlan, PairSpec, PairSums, Paired, Stream, Streams, catalogue,
};

fn main() {
    divan::main();
}

const ROWS: usize = 1 << 16;
const BATCH_ROWS: usize = 1024;
const BATCHES: usize = 64;
/// Presses at one location, as in a calibration of 400 points.
const PRESSES: usize = 4;

/// Numbers from a fixed seed, spread like forces or positions.
fn column(seed: u64, rows: usize, low: f64, width: f64) -> Vec<f64> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
        low + width * f64::from((state >> 33) as u32) / f64::from(1u32 << 31)
    };
    (0..rows).map(|_| next()).collect()
}

fn pairs() -> Paired<Vec<f64>> {
    let reference = column(1, ROWS, -12.5, 25.0);
    let noise = column(2, ROWS, -0.3, 0.6);
    Paired {
        estimate: reference
            .iter()
            .zip(noise)
            .map(|(y, noise)| y + noise)
            .collect(),
        reference,
    }
}

#[divan::bench]
fn naive_mae(bencher: Bencher<'_, '_>) {
    let pairs = pairs();
    bencher.counter(ItemsCount::new(ROWS)).bench_local(|| {
        let rows = black_box(&pairs.reference).iter().zip(&pairs.estimate);
        rows.map(|(y, estimate)| (y - estimate).abs()).sum::<f64>()
    });
}

#[divan::bench]
fn exact_mae(bencher: Bencher<'_, '_>) {
    exact(bencher, Streams::of(&[Stream::Absolute]), None);
}

#[divan::bench]
fn exact_mae_r2_smape(bencher: Bencher<'_, '_>) {
    let streams = [
        Stream::Absolute,
        Stream::Squared,
        Stream::Truth,
        Stream::TruthSquared,
        Stream::Symmetric,
    ];
    exact(bencher, Streams::of(&streams), None);
}

#[divan::bench]
fn exact_all_streams_and_gate(bencher: Bencher<'_, '_>) {
    exact(bencher, Streams::ALL, Some(0.02));
}

fn exact(bencher: Bencher<'_, '_>, streams: Streams, gate: Option<f64>) {
    let pairs = pairs();
    bencher.counter(ItemsCount::new(ROWS)).bench_local(|| {
        let mut sums = PairSums::new(PairSpec::new(streams).with_gate(gate));
        let estimates = pairs.estimate.chunks(BATCH_ROWS);
        for (estimate, reference) in estimates.zip(pairs.reference.chunks(BATCH_ROWS)) {
            sums.update(black_box(Paired {
                estimate,
                reference,
            }));
        }
        sums
    });
}

/// Benchmark of six channels with every stream. Items are rows times channels.
#[divan::bench(args = [0, 40, 4000])]
fn six_channels_by_location(bencher: Bencher<'_, '_>, locations: usize) {
    let channels = Channels::new(Channel::SIX).expect("six channels");
    let plan = MetricPlan::new(&catalogue::ALL, channels.clone(), FieldSet::PAIRS);
    let batches: Vec<Batch> = (0..BATCHES)
        .map(|batch| {
            let columns = |kind: u64| {
                let seeds = (0..6).map(|channel| kind + 2 * channel + 12 * batch as u64);
                seeds
                    .map(|seed| Column::full(column(seed, BATCH_ROWS, -1.0, 2.0)))
                    .collect()
            };
            let points = (locations > 0).then(|| {
                let mut points = Labels::default();
                for row in batch * BATCH_ROWS..(batch + 1) * BATCH_ROWS {
                    points.push(&format!("point {}", row / PRESSES % locations));
                }
                points
            });
            Batch::from_columns(channels.clone(), columns(0), columns(1), points)
        })
        .collect();
    let pairs = BATCHES * BATCH_ROWS * channels.len();
    bencher.counter(ItemsCount::new(pairs)).bench_local(|| {
        let mut evaluator = Evaluator::new(&plan);
        for batch in black_box(&batches) {
            evaluator.update(batch).expect("the plan's channels");
        }
        evaluator
    });
}

/// Benchmark of the scores of six channels with intervals: all metrics, 32 clusters.
#[divan::bench]
fn finish_six_channels(bencher: Bencher<'_, '_>) {
    let channels = Channels::new(Channel::SIX).expect("six channels");
    let plan = MetricPlan::new(&catalogue::ALL, channels.clone(), FieldSet::PAIRS);
    let mut points = Labels::default();
    (0..BATCH_ROWS).for_each(|row| points.push(&format!("point {}", row / PRESSES)));
    let columns = |kind: u64| {
        let seeds = (0..6).map(|channel| kind + 2 * channel);
        seeds
            .map(|seed| Column::full(column(seed, BATCH_ROWS, -1.0, 2.0)))
            .collect()
    };
    let batch = Batch::from_columns(channels, columns(0), columns(1), Some(points));
    let evaluator = || {
        let mut evaluator = Evaluator::new(&plan);
        evaluator.update(&batch).expect("the plan's channels");
        evaluator
    };
    bencher
        .with_inputs(evaluator)
        .bench_local_values(|evaluator| evaluator.finish());
}
