//! Compares trainings with two algorithms (forms) of convolutions. A network trains from the same seeds in both forms on pictures of a blob, whose
//! position and size are the labels. Losses and held-out scores are printed beside their spread over seeds.
//!
//! `cargo run --release -p taceva-network --example forms [-- NETWORK [SEEDS [STEPS [SIDE [THREADS]]]]]`; defaults: `resnet18`, 5, 200, 32 and 1.
//! NETWORK is `resnet10`, `resnet18`, `resnet34` or `cnn`; `cnn` gives equal results, because none of its convolutions has a second form. SIDE is the
//! side of pictures, pixels. THREADS trainings run in parallel, each on one thread. Pictures are generated; no file is read.

#![expect(
    clippy::print_stdout,
    reason = "a program that prints its measurements"
)]

#[path = "forms/blobs.rs"]
mod blobs;
#[path = "forms/comparison.rs"]
mod comparison;

use std::error::Error;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use blobs::Blobs;
use comparison::{Course, print};
use taceva_network::{
    Architecture, ConvolutionForm, Depth, Isa, NetworkError, Picture, Recipe, Trainer,
};

/// Number of training samples, and of held-out samples.
const LEARNT: usize = 320;
const HELD_OUT: usize = 160;

const FORMS: [ConvolutionForm; 2] = [ConvolutionForm::Direct, ConvolutionForm::Winograd];

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let name = words.next().unwrap_or("resnet18".into());
    let mut number = |usual: usize| words.next().map_or(Ok(usual), |word| word.parse());
    let (seeds, steps, side, threads) = (number(5)?, number(200)?, number(32)?, number(1)?);
    let input = Picture {
        height: side,
        width: side,
        channels: 1,
    };
    let architecture = match name.as_str() {
        "resnet10" => Architecture::residual(Depth::Ten, input, blobs::LABELS.len()),
        "resnet18" => Architecture::residual(Depth::Eighteen, input, blobs::LABELS.len()),
        "resnet34" => Architecture::residual(Depth::ThirtyFour, input, blobs::LABELS.len()),
        "cnn" => Architecture::five_layers(input, blobs::LABELS.len()),
        _ => return Err(format!("`{name}`: expected resnet10, resnet18, resnet34 or cnn").into()),
    };
    if seeds < 2 || steps == 0 || threads == 0 {
        return Err("expected SEEDS of at least 2, STEPS and THREADS of at least 1".into());
    }
    println!(
        "{name}, {side}², {seeds} seeds, {steps} steps of 32, {LEARNT} samples and {HELD_OUT} held out, {threads} trainings at a time, {}",
        Isa::detect()
    );
    let parts = [Blobs::draw(1, LEARNT, side), Blobs::draw(2, HELD_OUT, side)];
    // Task order: both forms of one seed, then the next seed.
    let tasks = 0..seeds * FORMS.len();
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut courses = Vec::new();
        loop {
            let task = next.fetch_add(1, Ordering::Relaxed);
            if !tasks.contains(&task) {
                return Ok(courses);
            }
            let form = FORMS[task % FORMS.len()];
            let seed = (task / FORMS.len()) as u64 + 1;
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
            let course = pool
                .map_err(|error| error.to_string())?
                .install(|| train(&architecture, (form, seed), steps, &parts));
            courses.push(course.map_err(|error| error.to_string())?);
        }
    };
    let all = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        let done = workers.into_iter().map(|worker| worker.join());
        done.map(|courses| courses.unwrap_or(Err("a training panicked".into())))
            .collect::<Result<Vec<Vec<Course>>, String>>()
    })?;
    let mut all: Vec<Course> = all.into_iter().flatten().collect();
    // A fixed order, so sums over seeds do not depend on which thread finished first.
    all.sort_by_key(|course| course.seed);
    print(FORMS, &all, steps);
    Ok(())
}

/// Trains from `seed` in one form and scores the held-out samples.
fn train(
    architecture: &Architecture,
    (form, seed): (ConvolutionForm, u64),
    steps: usize,
    [learnt, held_out]: &[Blobs; 2],
) -> Result<Course, NetworkError> {
    let start = Instant::now();
    let recipe = Recipe {
        seed,
        ..Recipe::default()
    };
    let recipe = Recipe {
        // The learning rate reaches zero at the end of the last epoch, possibly a few steps after the last step.
        epochs: steps.div_ceil(LEARNT / recipe.batch) as u64,
        ..recipe
    };
    let trainer = Trainer::new(architecture, &recipe, learnt.samples(), None)?;
    let mut trainer = trainer.in_form(form)?;
    let mut losses = Vec::with_capacity(steps);
    while losses.len() < steps {
        losses.extend(trainer.step()?.map(|step| step.loss));
    }
    let trained = trainer.finish()?;
    let mut found = vec![0.0; HELD_OUT * blobs::LABELS.len()];
    let mut predictor = trained.network.predictor_in(form);
    predictor.predict(&held_out.pictures, &mut found)?;
    for (at, value) in found.iter_mut().enumerate() {
        *value = trained.scale.unscaled(at % blobs::LABELS.len(), *value);
    }
    Ok(Course {
        form,
        seed,
        losses,
        scores: held_out.determination(&found),
        seconds: start.elapsed().as_secs_f64(),
    })
}
