//! Images per second of training steps and of predictions: ResNet-18, six outputs, batches of 32 (and single pictures), in both forms of
//! convolutions in turn or in one of them.
//!
//! `cargo bench -p taceva-network [-- SIDE [THREADS [REPEATS]]] [winograd | direct]`; without arguments 64² and 112² on one and two threads,
//! both forms. The best of REPEATS, by processor time of all threads and by the wall clock; and how much memory training takes at most beyond
//! what the process had before, on Linux and of the first size and form alone, since a peak is one of the process.
//! `benches/peers/torch_network.py` measures PyTorch alike.

#![expect(
    clippy::print_stdout,
    reason = "a program that prints its measurements"
)]

use std::time::Instant;

use rustix::time::{ClockId, clock_gettime};
use taceva_network::{
    Architecture, ConvolutionForm, Depth, Isa, LabelScaling, Labels, Loss, Optimizer, Picture,
    Recipe, Samples, Schedule, Trainer,
};

const BATCH: usize = 32;
const OUTPUTS: usize = 6;

fn main() {
    // Cargo adds `--bench`.
    let words = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with('-'));
    let (mut numbers, mut forms): (Vec<usize>, _) = (Vec::new(), Vec::new());
    for word in words {
        match word.as_str() {
            "winograd" => forms.push(ConvolutionForm::Winograd),
            "direct" => forms.push(ConvolutionForm::Direct),
            _ => numbers.push(word.parse().expect("a number, `winograd` or `direct`")),
        }
    }
    if forms.is_empty() {
        forms = vec![ConvolutionForm::Winograd, ConvolutionForm::Direct];
    }
    let repeats = numbers.get(2).copied().unwrap_or(8);
    println!("instructions: {}", Isa::detect());
    let mut before = resident("VmRSS:");
    for side in numbers.first().map_or(vec![64, 112], |side| vec![*side]) {
        for threads in numbers.get(1).map_or(vec![1, 2], |threads| vec![*threads]) {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.expect("threads");
            for form in &forms {
                pool.install(|| measure((side, threads), *form, repeats, before.take()));
            }
        }
    }
}

/// The number of `key` in the state of this process, in MiB, where the system reports it.
fn resident(key: &str) -> Option<f64> {
    let state = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = state.lines().find_map(|line| line.strip_prefix(key))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}

fn measure(
    (side, threads): (usize, usize),
    form: ConvolutionForm,
    repeats: usize,
    before: Option<f64>,
) {
    let input = Picture {
        height: side,
        width: side,
        channels: 3,
    };
    let architecture = Architecture::residual(Depth::Eighteen, input, OUTPUTS);
    let pictures: Vec<f32> = (0_u16..)
        .map(|at| f32::from(at % 251) / 251.0)
        .take(BATCH * input.len())
        .collect();
    let labels: Vec<f64> = (0_u8..)
        .take(BATCH * OUTPUTS)
        .map(|at| f64::from(at % 17))
        .collect();
    let samples = Samples {
        pictures: &pictures,
        labels: Labels::Values(&labels),
    };
    let recipe = Recipe {
        epochs: u64::MAX / 2,
        optimizer: Optimizer::Sgd {
            momentum: 0.9,
            weight_decay: 1e-4,
        },
        rate: 1e-3,
        schedule: Schedule::Constant,
        loss: Loss::SquaredError,
        scaling: LabelScaling::MinMax,
        ..Recipe::default()
    };
    let trainer = Trainer::new(&architecture, &recipe, samples, None).expect("a training");
    let mut trainer = trainer.in_form(form).expect("room");
    let step = || {
        trainer.step().expect("finite").expect("a step is left");
    };
    let report = |what, images, times| report(what, (form, side, threads), images, times);
    report("training", BATCH, best(repeats, step));
    if let Some((peak, before)) = resident("VmHWM:").zip(before) {
        println!(
            "memory       {form:<12} {side}² {threads} threads {:9.1} MiB at most beyond the process before",
            peak - before
        );
    }

    let network = trainer.finish().expect("at hand").network;
    let mut predictor = network.predictor_in(form);
    let mut outputs = [0.0; BATCH * OUTPUTS];
    let all = || predictor.predict(&pictures, &mut outputs).expect("finite");
    report("inference", BATCH, best(repeats, all));
    let single = || {
        let picture = &pictures[..input.len()];
        predictor
            .predict(picture, &mut outputs[..OUTPUTS])
            .expect("finite");
    };
    report("one picture", 1, best(4 * repeats, single));
}

fn report(
    what: &str,
    (form, side, threads): (ConvolutionForm, usize, usize),
    images: usize,
    (busy, wall): (f64, f64),
) {
    let images = images as f64;
    println!(
        "{what:<12} {form:<12} {side}² {threads} threads {:9.1} images per processor second {:9.1} images/s",
        images / busy,
        images / wall
    );
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
