//! Compares each built and available kind of GPU with the CPU engine. Without a GPU, the tests print a message and skip.

#![cfg(any(feature = "cuda", feature = "wgpu"))]

use crate::draws::{doubles, filled, singles};
use taceva_needs::{Need, skip};
use taceva_network::{
    Architecture, Augmentation, Depth, Jitter, LabelScaling, Labels, Loss, NamedTensor, Network,
    NetworkError, Optimizer, Picture, Recipe, Samples, Schedule, Snapshot, Trainer,
};
use taceva_network::{Gpu, GpuKind};

const PICTURE: Picture = Picture {
    height: 45,
    width: 38,
    channels: 3,
};

/// Every available GPU, or only the kind that the environment variable `TACEVA_GPU` names.
#[expect(clippy::print_stderr, reason = "a test says where it ran")]
fn gpus() -> Vec<Gpu> {
    let only = std::env::var("TACEVA_GPU").ok();
    if let Some(only) = &only {
        let is_known = GpuKind::ALL.iter().any(|kind| kind.name() == only);
        assert!(is_known, "TACEVA_GPU={only}: expected `cuda` or `wgpu`");
    }
    let built = GpuKind::ALL.into_iter().filter(|kind| {
        kind.check_built().is_ok() && only.as_ref().is_none_or(|only| kind.name() == only)
    });
    let found = built.filter_map(|kind| match Gpu::find(kind) {
        Ok(gpu) => {
            eprintln!("on {gpu}");
            Some(gpu)
        }
        Err(reason) => {
            skip(Need::Gpu, reason);
            None
        }
    });
    found.collect()
}

fn architecture(name: &str) -> Architecture {
    match name {
        "resnet10" => Architecture::residual(Depth::Ten, PICTURE, 6),
        "resnet18" => Architecture::residual(Depth::Eighteen, PICTURE, 6),
        "plain" => Architecture::five_layers(PICTURE, 6),
        _ => panic!("{name} is no network of these tests"),
    }
}

fn recipe(loss: Loss, optimizer: Optimizer) -> Recipe {
    Recipe {
        epochs: 20,
        batch: 8,
        optimizer,
        rate: 3e-4,
        schedule: Schedule::Constant,
        loss,
        class_weights: Vec::new(),
        scaling: LabelScaling::None,
        augmentation: Augmentation::default(),
        patience: None,
        seed: 1,
    }
}

const MOMENTUM: Optimizer = Optimizer::Sgd {
    momentum: 0.9,
    weight_decay: 1e-4,
};

/// Eight pictures and their labels.
fn eight(seed: u64) -> (Vec<f32>, Vec<f64>) {
    (
        singles(seed, 8 * PICTURE.len()),
        doubles(seed + 1000, 8 * 6),
    )
}

fn samples<'a>((pictures, labels): &'a (Vec<f32>, Vec<f64>)) -> Samples<'a> {
    Samples {
        pictures,
        labels: Labels::Values(labels),
    }
}

/// The same training on the CPU and on `gpu`.
fn both<'a>(
    gpu: &Gpu,
    network: &Network,
    recipe: &Recipe,
    eight: &'a (Vec<f32>, Vec<f64>),
) -> [Trainer<'a>; 2] {
    let begin = || Trainer::of(network.clone(), recipe, samples(eight), None).expect("a training");
    let there = begin().on(|snapshot, recipe| gpu.engine(snapshot, recipe));
    [begin(), there.expect("a training on a device")]
}

/// Prints the deviation from the CPU's value, and fails unless it is below `bound`.
#[expect(clippy::print_stderr, reason = "a test says what it found")]
fn assert_below(error: f64, bound: f64, what: &str) {
    eprintln!("{what}: {error:.1e} of {bound:.0e}");
    assert!(error < bound, "{what}: {error:e}, not below {bound:e}");
}

/// Maximum of `errors`; NaN if one is NaN.
fn worst(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, |most, error| {
        if error > most || error.is_nan() {
            error
        } else {
            most
        }
    })
}

/// Norm of the difference of two lists of numbers, relative to the norm of the second.
fn distance(found: &[f32], expected: &[f32]) -> f64 {
    let length = |numbers: &mut dyn Iterator<Item = f64>| {
        numbers.map(|number| number * number).sum::<f64>().sqrt()
    };
    let pairs = found.iter().zip(expected);
    let apart = length(&mut pairs.map(|(a, b)| f64::from(*a) - f64::from(*b)));
    apart / length(&mut expected.iter().copied().map(f64::from))
}

fn assert_near(found: &[NamedTensor], expected: &[NamedTensor], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let mut apart = found.iter().zip(expected).map(|(found, expected)| {
        assert_eq!(
            (&found.name, &found.shape),
            (&expected.name, &expected.shape)
        );
        (distance(&found.values, &expected.values), &found.name)
    });
    let first = apart.next().expect("a network has tensors");
    let (most, name) = apart.fold(first, |most, next| {
        if next.0 > most.0 || next.0.is_nan() {
            next
        } else {
            most
        }
    });
    assert_below(most, tolerance, &format!("{what}, furthest {name}"));
}

#[test]
fn predictions_are_those_of_the_processor() {
    for gpu in gpus() {
        for (name, seed) in [("plain", 1), ("resnet10", 2), ("resnet18", 3)] {
            let network = filled(&architecture(name), seed);
            let pictures = singles(seed + 1000, 3 * PICTURE.len());
            let [mut expected, mut found] = [vec![0.0; 18], vec![0.0; 18]];
            let finite = network.predictor().predict(&pictures, &mut expected);
            finite.expect("finite");
            let recipe = recipe(Loss::SquaredError, MOMENTUM);
            let moments = Vec::new();
            let mut engine = gpu
                .engine(&Snapshot { network, moments }, &recipe)
                .expect("an engine");
            engine.predict(&pictures, &mut found).expect("finite");
            let size = expected
                .iter()
                .fold(0.0_f64, |most, value| most.max(value.abs()));
            let pairs = found.iter().zip(&expected);
            let error = worst(pairs.map(|(found, expected)| (found - expected).abs() / size));
            assert_below(error, 1e-4, &format!("{gpu}, {name}: predictions"));
        }
    }
}

#[test]
fn a_step_has_the_loss_the_gradients_and_the_weights_of_the_processor() {
    let cases = [
        ("plain", Loss::Huber { delta: 1.0 }, 10),
        ("resnet10", Loss::SquaredError, 20),
        ("resnet18", Loss::SquaredError, 30),
    ];
    for gpu in gpus() {
        for (name, loss, seed) in cases {
            let (network, eight) = (filled(&architecture(name), seed), eight(seed));
            let [mut here, mut there] = both(&gpu, &network, &recipe(loss, MOMENTUM), &eight);
            let step = |trainer: &mut Trainer<'_>| {
                let step = trainer.step().expect("finite").expect("a step is left");
                let tensors = trainer.checkpoint().expect("at hand").tensors;
                let is_moment = |tensor: &NamedTensor| tensor.name.starts_with("moment.");
                let (moments, weights): (Vec<_>, Vec<_>) = tensors.into_iter().partition(is_moment);
                (step.loss, moments, weights)
            };
            let (expected, found) = (step(&mut here), step(&mut there));
            let what = format!("{gpu}, {name}");
            let error = (found.0 / expected.0 - 1.0).abs();
            assert_below(error, 1e-5, &format!("{what}: loss"));
            // After one step, the velocity is the gradient plus the decay. Moments of the last stage average few numbers, which magnifies rounding
            // errors.
            assert_near(&found.1, &expected.1, 2e-3, &format!("{what}: gradients"));
            assert_near(&found.2, &expected.2, 1e-5, &format!("{what}: weights"));
        }
    }
}

#[test]
fn twenty_steps_go_as_on_the_processor_and_the_network_predicts_the_same_there_and_here() {
    let cases = [
        ("plain", Loss::Huber { delta: 1.0 }, Optimizer::ADAM_W, 40),
        ("resnet10", Loss::SquaredError, MOMENTUM, 50),
    ];
    for gpu in gpus() {
        for (name, loss, optimizer, seed) in cases {
            let (network, eight) = (filled(&architecture(name), seed), eight(seed));
            let recipe = recipe(loss, optimizer);
            let [mut here, mut there] = both(&gpu, &network, &recipe, &eight);
            let mut first = None;
            let errors = (0..20).map(|_| {
                let [expected, found] = [&mut here, &mut there].map(|trainer| {
                    let made = trainer.step().expect("finite");
                    made.expect("a step is left").loss
                });
                (found - expected).abs() / *first.get_or_insert(expected)
            });
            let error = worst(errors);
            assert_below(error, 1e-3, &format!("{gpu}, {name}: twenty losses"));
            let checkpoint = there.checkpoint().expect("at hand");
            let mut found = vec![0.0; 8 * 6];
            let trained = there.finish().expect("at hand").network;
            let moments = Vec::new();
            let snapshot = Snapshot {
                network: trained.clone(),
                moments,
            };
            let mut engine = gpu.engine(&snapshot, &recipe).expect("an engine");
            engine.predict(&eight.0, &mut found).expect("finite");
            let mut expected = found.clone();
            let mut predictor = trained.predictor();
            predictor.predict(&eight.0, &mut expected).expect("finite");
            let pairs = found.iter().zip(&expected);
            let error = worst(pairs.map(|(found, expected)| (found - expected).abs()));
            assert_below(error, 1e-4, &format!("{gpu}, {name}: there and here"));
            // A checkpoint made on the GPU can be read on the CPU, bit by bit.
            let again = Trainer::resume(checkpoint.clone(), samples(&eight), None);
            let again = again.expect("its own checkpoint").checkpoint();
            assert_eq!(again.expect("at hand"), checkpoint);
        }
    }
}

#[test]
fn a_training_put_aside_goes_on_and_the_best_epoch_is_kept() {
    for gpu in gpus() {
        let (learnt, held) = (eight(60), eight(70));
        let recipe = Recipe {
            epochs: 6,
            batch: 4,
            augmentation: Augmentation {
                brightness: 0.1,
                noise: 0.05,
                jitter: Jitter {
                    pixels: 2,
                    label_per_pixel: Vec::new(),
                },
            },
            scaling: LabelScaling::Standard,
            ..recipe(Loss::Huber { delta: 1.0 }, Optimizer::ADAM_W)
        };
        let begin = || {
            let kept = Some(samples(&held));
            Trainer::new(&architecture("plain"), &recipe, samples(&learnt), kept)
        };
        let expected = begin().expect("a training").run().expect("finite");
        let on = |trainer: Trainer<'_>| -> Vec<f64> {
            let mut trainer = trainer
                .on(|snapshot, recipe| gpu.engine(snapshot, recipe))
                .expect("a training on a device");
            let mut losses = Vec::new();
            while let Some(step) = trainer.step().expect("finite") {
                losses.extend(step.epoch.and_then(|epoch| epoch.validation_loss));
            }
            let trained = trainer.finish().expect("at hand");
            assert!(trained.state.best.is_some());
            losses
        };
        let whole = on(begin().expect("a training"));
        let mut stopped = begin()
            .expect("a training")
            .on(|snapshot, recipe| gpu.engine(snapshot, recipe))
            .expect("a training on a device");
        for _ in 0..5 {
            stopped.step().expect("finite");
        }
        let checkpoint = stopped.checkpoint().expect("at hand");
        let resumed = Trainer::resume(checkpoint, samples(&learnt), Some(samples(&held)));
        let rest = on(resumed.expect("its own checkpoint"));
        let epochs = expected.state.epochs.iter();
        let epochs: Vec<f64> = epochs.filter_map(|epoch| epoch.validation_loss).collect();
        assert_eq!((whole.len(), rest.len()), (6, 4));
        let pairs = whole.iter().zip(&epochs);
        let pairs = pairs.chain(rest.iter().zip(&epochs[2..]));
        let error = worst(pairs.map(|(found, expected)| (found - expected).abs() / expected));
        assert_below(error, 1e-2, &format!("{gpu}: a training resumed"));
    }
}

#[test]
fn a_loss_that_is_not_finite_names_its_step_and_leaves_the_best() {
    for gpu in gpus() {
        let (learnt, held) = (eight(80), eight(90));
        let recipe = Recipe {
            epochs: 50,
            rate: 1e30,
            ..recipe(Loss::SquaredError, MOMENTUM)
        };
        let kept = Some(samples(&held));
        let trainer = Trainer::new(&architecture("plain"), &recipe, samples(&learnt), kept);
        let trainer = trainer.expect("a training");
        let trainer = trainer.on(|snapshot, recipe| gpu.engine(snapshot, recipe));
        let mut trainer = trainer.expect("a training on a device");
        let error = loop {
            match trainer.step() {
                Ok(made) => assert!(made.is_some(), "such a rate breaks any training"),
                Err(error) => break error,
            }
        };
        let named = matches!(
            error,
            NetworkError::LossNotFinite { .. } | NetworkError::WeightNotFinite { .. }
        );
        assert!(named, "{gpu}: {error}");
        assert_eq!(trainer.step().expect_err("broken"), error);
        if trainer.state().best.is_some() {
            trainer.finish().expect("the best epoch is kept");
        }
    }
}
