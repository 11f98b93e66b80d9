//! Images per second of training steps and of predictions in other frameworks of Rust: ResNet-18, six outputs, batches of 32 (and
//! single pictures), single precision, SGD with momentum on squared errors, as `cargo bench -p taceva-network` measures it.
//!
//! usage: cargo run --release [-- SIDE [THREADS [REPEATS]]]; without arguments 64, one thread, 5 repeats. On a machine with other
//! work pin all sides to the same processor (`taskset -c 0`) and run them in turn.

mod burn_resnet;
mod candle_resnet;

use std::process::Command;
use std::time::Instant;

use rustix::time::{ClockId, clock_gettime};

const BATCH: usize = 32;
const OUTPUTS: usize = 6;
const RATE: f64 = 1e-3;
const MOMENTUM: f64 = 0.9;
const DECAY: f64 = 1e-4;

/// The environment variable from which both frameworks read the number of threads.
const THREADS: &str = "RAYON_NUM_THREADS";

/// ResNet-18 in a framework.
trait Framework {
    /// Makes a step with a whole batch and gives its loss.
    fn step(&mut self) -> f32;

    /// A function that predicts the first `count` pictures of the batch, by running moments: `[count, OUTPUTS]`.
    fn predictor(&self) -> impl Fn(usize) -> Vec<f32>;
}

/// The pictures and their labels.
struct Samples {
    side: usize,
    /// `[BATCH, 3, side, side]`.
    pictures: Vec<f32>,
    /// `[BATCH, OUTPUTS]`.
    labels: Vec<f32>,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let word =
        |place: usize, otherwise: &str| words.get(place).map_or(otherwise, |word| word).to_owned();
    let threads = word(1, "1");
    if std::env::var(THREADS).ok().as_ref() != Some(&threads) {
        // Asked when a process begins, so it is begun anew.
        let program = std::env::current_exe().expect("a program has a path");
        let again = Command::new(program)
            .args(&words)
            .env(THREADS, &threads)
            .status();
        assert!(again.expect("it ran before").success());
        return;
    }
    let side = word(0, "64").parse().expect("SIDE is a number");
    let repeats = word(2, "5").parse().expect("REPEATS is a number");
    let numbers = |count: usize| (0..count).map(|at| (at % 251) as f32 / 251.0).collect();
    let samples = Samples {
        side,
        pictures: numbers(BATCH * 3 * side * side),
        labels: numbers(BATCH * OUTPUTS),
    };
    measure(
        "burn 0.21, flex",
        burn_resnet::Burn::new(&samples),
        side,
        repeats,
    );
    let candle = candle_resnet::Candle::new(&samples).expect("a network");
    measure("candle 0.11", candle, side, repeats);
}

fn measure(name: &str, mut framework: impl Framework, side: usize, repeats: usize) {
    let tell = |what: &str, images: usize, (busy, wall): (f64, f64)| {
        let (busy, wall) = (images as f64 / busy, images as f64 / wall);
        println!(
            "{name:<16} {what:<12} {side}² {busy:8.2} images per processor second {wall:8.2} images/s"
        );
    };
    let first = framework.step();
    let mut last = first;
    tell("training", BATCH, best(repeats, || last = framework.step()));
    assert!(last < first, "a loss of {first} became {last}");
    let predict = framework.predictor();
    tell("inference", BATCH, best(repeats, || drop(predict(BATCH))));
    tell("one picture", 1, best(4 * repeats, || drop(predict(1))));
}

/// The least processor and wall seconds of `work`, after one warm-up.
fn best(repeats: usize, mut work: impl FnMut()) -> (f64, f64) {
    work();
    let (mut busy, mut wall) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..repeats {
        let (start, start_busy) = (Instant::now(), processor_seconds());
        work();
        busy = busy.min(processor_seconds() - start_busy);
        wall = wall.min(start.elapsed().as_secs_f64());
    }
    (busy, wall)
}

fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
