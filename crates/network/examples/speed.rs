//! Images per second of training steps and of predictions on a GPU: ResNet-18, six outputs, squared errors, SGD with momentum.
//!
//! `cargo run --release -p taceva-network --features cuda --example speed [-- KIND [SIDE [BATCH [STEPS]]]]`; defaults: `cuda`, 64, 32 and 50. Times
//! are wall-clock times. Pictures are uploaded from main memory, as in a training. `benches/peers/torch_network.py --device cuda` measures PyTorch in
//! the same way.

#![expect(
    clippy::print_stdout,
    reason = "a program that prints its measurements"
)]

use std::error::Error;
use std::time::Instant;

use taceva_network::{
    Architecture, Depth, LabelScaling, Labels, Loss, Network, Optimizer, Picture, Recipe, Samples,
    Schedule, Snapshot, Trainer,
};
use taceva_network::{Gpu, GpuKind};

const OUTPUTS: usize = 6;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let kind = words.next().unwrap_or("cuda".into());
    let kind = GpuKind::ALL.into_iter().find(|known| known.name() == kind);
    let kind = kind.ok_or("expected `cuda` or `wgpu`")?;
    let mut number = |usual: usize| words.next().map_or(Ok(usual), |word| word.parse());
    let (side, batch, steps) = (number(64)?, number(32)?, number(50)?);
    let gpu = Gpu::find(kind)?;

    let input = Picture {
        height: side,
        width: side,
        channels: 3,
    };
    let pictures: Vec<f32> = (0_u16..)
        .map(|at| f32::from(at % 251) / 251.0)
        .take(batch * input.len())
        .collect();
    let labels: Vec<f64> = (0..batch * OUTPUTS).map(|at| (at % 17) as f64).collect();
    let samples = Samples {
        pictures: &pictures,
        labels: Labels::Values(&labels),
    };
    let recipe = Recipe {
        epochs: u64::MAX / 2,
        batch,
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
    let network = Network::new(&Architecture::residual(Depth::Eighteen, input, OUTPUTS), 1)?;
    let trainer = Trainer::of(network.clone(), &recipe, samples, None)?;
    let mut trainer = trainer.on(|snapshot, recipe| gpu.engine(snapshot, recipe))?;
    println!("{gpu}, {side}², batches of {batch}, {steps} of each");

    // Warm-up: kernels are chosen and compiled at first use. Each step reads its outputs, so it waits for the whole step before.
    let start = Instant::now();
    for _ in 0..3 {
        trainer.step()?;
    }
    println!("first three steps {:9.1} s", start.elapsed().as_secs_f64());
    let per_second = |start: Instant| (batch * steps) as f64 / start.elapsed().as_secs_f64();
    let start = Instant::now();
    for _ in 0..steps {
        trainer.step()?;
    }
    println!("training  {:9.1} images/s", per_second(start));

    let moments = Vec::new();
    let mut engine = gpu.engine(&Snapshot { network, moments }, &recipe)?;
    let mut outputs = vec![0.0; batch * OUTPUTS];
    engine.predict(&pictures, &mut outputs)?;
    let start = Instant::now();
    for _ in 0..steps {
        engine.predict(&pictures, &mut outputs)?;
    }
    println!("inference {:9.1} images/s", per_second(start));
    Ok(())
}
