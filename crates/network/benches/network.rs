//! Images per second of training steps and of predictions, for each algorithm of the convolutions (form). The network is ResNet-18 with six outputs.
//! Training uses batches of 32 pictures; predictions use batches or single pictures.
//!
//! `cargo bench -p taceva-network [-- SIDE [THREADS [REPEATS]]] [winograd | mixed | direct] [single | training]`. Without arguments it measures
//! pictures of 64² and 112² on one and two threads, in every form. `single` measures only predictions of single pictures, `training` only training
//! steps, for a profiler. It prints the best of REPEATS, by processor time of all threads and by the wall clock. For single pictures it also prints
//! the median of 4 · REPEATS, because they are so short that other programs disturb few of them. On Linux it also prints how much memory
//! the training adds at its peak. It prints this for the first size and form only, because the peak belongs to the whole process.
//! `benches/peers/torch_network.py` makes the same measurements with PyTorch.
//!
//! `cargo bench -p taceva-network -- slip [REPEATS]` measures training steps of the model `cnn` on sequences of frames, on one thread.
//! `benches/models/slip_windows.py` alternates these measurements with PyTorch.

#![expect(
    clippy::print_stdout,
    reason = "a program that prints its measurements"
)]

use std::time::Instant;

use rustix::time::{ClockId, clock_gettime};
use taceva_network::{
    Architecture, ConvolutionForm, Depth, Isa, LabelScaling, Labels, Loss, Network, Optimizer,
    Picture, Recipe, Samples, Schedule, Trainer,
};

const BATCH: usize = 32;
const OUTPUTS: usize = 6;

fn main() {
    // Cargo adds `--bench`.
    let words = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with('-'));
    let (mut numbers, mut forms): (Vec<usize>, _) = (Vec::new(), Vec::new());
    let (mut is_single, mut is_training, mut is_slip) = (false, false, false);
    for word in words {
        match word.as_str() {
            "winograd" => forms.push(ConvolutionForm::Winograd),
            "direct" => forms.push(ConvolutionForm::Direct),
            "mixed" => forms.push(ConvolutionForm::Mixed),
            "single" => is_single = true,
            "training" => is_training = true,
            "slip" => is_slip = true,
            _ => numbers.push(word.parse().expect("a number or a word of those above")),
        }
    }
    if forms.is_empty() {
        forms = ConvolutionForm::ALL.into_iter().rev().collect();
    }
    if is_slip {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let repeats = numbers.first().copied().unwrap_or(8);
        return pool.expect("a thread").install(|| measure_slip(repeats));
    }
    let repeats = numbers.get(2).copied().unwrap_or(8);
    println!("instructions: {}", Isa::detect());
    let mut before = resident("VmRSS:");
    for side in numbers.first().map_or(vec![64, 112], |side| vec![*side]) {
        for threads in numbers.get(1).map_or(vec![1, 2], |threads| vec![*threads]) {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool = pool.expect("threads");
            for form in &forms {
                let what = (*form, side, threads);
                if is_single {
                    let network = Network::new(&of_side(side), 1).expect("a network");
                    pool.install(|| measure_single(&network, what, repeats));
                    continue;
                }
                pool.install(|| {
                    let network = measure_training(what, repeats, before.take());
                    if !is_training {
                        measure_batches(&network, what, repeats);
                        measure_single(&network, what, repeats);
                    }
                });
            }
        }
    }
}

/// Value of `key` in `/proc/self/status`, MiB. `None` if the system does not report it.
fn resident(key: &str) -> Option<f64> {
    let state = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = state.lines().find_map(|line| line.strip_prefix(key))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib / 1024.0)
}

/// ResNet-18 for pictures of `side`² pixels.
fn of_side(side: usize) -> Architecture {
    let input = Picture {
        height: side,
        width: side,
        channels: 3,
    };
    Architecture::residual(Depth::Eighteen, input, OUTPUTS)
}

fn pictures(input: Picture, count: usize) -> Vec<f32> {
    (0_u16..)
        .map(|at| f32::from(at % 251) / 251.0)
        .take(count * input.len())
        .collect()
}

/// Measured case: form of the convolutions, number of rows of a picture, and number of threads.
type What = (ConvolutionForm, usize, usize);

fn measure_training(what: What, repeats: usize, before: Option<f64>) -> Network {
    let (form, side, threads) = what;
    let architecture = of_side(side);
    let input = architecture.input;
    let pictures = pictures(input, BATCH);
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
    // Another form starts from the same state. Memory of the previous engine would count towards the peak.
    let mut trainer = match form {
        Trainer::CONVOLUTIONS => trainer,
        form => trainer.in_form(form).expect("room"),
    };
    let step = || {
        trainer.step().expect("finite").expect("a step is left");
    };
    report("training", what, BATCH, best(repeats, step));
    if let Some((peak, before)) = resident("VmHWM:").zip(before) {
        println!(
            "memory       {form:<12} {side}² {threads} threads {:9.1} MiB at most beyond the process before",
            peak - before
        );
    }

    trainer.finish().expect("at hand").network
}

/// Measures training steps of `cnn` for slip: two classes, and inputs of five consecutive grey frames with the four changes between them.
fn measure_slip(repeats: usize) {
    let input = Picture {
        height: 96,
        width: 128,
        channels: 9,
    };
    let architecture = Architecture::five_layers(input, 2);
    let pictures = pictures(input, BATCH);
    let labels: Vec<u32> = (0..2).cycle().take(BATCH).collect();
    let samples = Samples {
        pictures: &pictures,
        labels: Labels::Classes(&labels),
    };
    let recipe = Recipe {
        epochs: u64::MAX / 2,
        rate: 1e-3,
        schedule: Schedule::Constant,
        loss: Loss::CrossEntropy,
        ..Recipe::default()
    };
    let mut trainer = Trainer::new(&architecture, &recipe, samples, None).expect("a training");
    let [busy, wall] = best(repeats, || {
        trainer.step().expect("finite").expect("a step is left");
    });
    println!(
        "slip windows {} parameters {:9.1} images per processor second {:9.1} images/s",
        architecture.parameters().expect("valid"),
        BATCH as f64 / busy,
        BATCH as f64 / wall
    );
}

fn measure_batches(network: &Network, what: What, repeats: usize) {
    let mut predictor = network.predictor_in(what.0);
    let pictures = pictures(predictor.input(), BATCH);
    let mut outputs = [0.0; BATCH * OUTPUTS];
    let all = || predictor.predict(&pictures, &mut outputs).expect("finite");
    report("inference", what, BATCH, best(repeats, all));
}

fn measure_single(network: &Network, what: What, repeats: usize) {
    let mut predictor = network.predictor_in(what.0);
    let picture = pictures(predictor.input(), 1);
    let mut outputs = [0.0; OUTPUTS];
    let single = || predictor.predict(&picture, &mut outputs).expect("finite");
    let times = times(4 * repeats, single);
    for (measured, position) in [("one picture", 0), ("its median", 2 * repeats)] {
        let times = [times[0][position], times[1][position]];
        report(measured, what, 1, times);
    }
}

fn report(measured: &str, (form, side, threads): What, images: usize, [busy, wall]: [f64; 2]) {
    let images = images as f64;
    println!(
        "{measured:<12} {form:<12} {side}² {threads} threads {:9.1} images per processor second {:9.1} images/s",
        images / busy,
        images / wall
    );
}

/// Minimum processor time and wall time of `work`, in seconds, after one warm-up.
fn best(repeats: usize, work: impl FnMut()) -> [f64; 2] {
    times(repeats, work).map(|times| times[0])
}

/// Processor times and wall times of `repeats` calls of `work`, in seconds, each in ascending order. One call for warm-up precedes them.
fn times(repeats: usize, mut work: impl FnMut()) -> [Vec<f64>; 2] {
    work();
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..repeats {
        let (start, start_busy) = (Instant::now(), processor_seconds());
        work();
        times[0].push(processor_seconds() - start_busy);
        times[1].push(start.elapsed().as_secs_f64());
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times
    })
}

fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
