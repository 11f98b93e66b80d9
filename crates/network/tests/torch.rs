//! Comparison with PyTorch, with the same weights and pictures. `benches/peers/torch_golden.py` made the expected numbers.

use std::collections::BTreeMap;

use crate::draws::{doubles, filled, singles, unit};
use serde::Deserialize;
use taceva_network::{
    Architecture, Augmentation, Depth, LabelScaling, Labels, Loss, Optimizer, Picture, Recipe,
    Samples, Schedule, Trainer,
};

#[derive(Deserialize)]
struct Golden {
    outputs: BTreeMap<String, Vec<f64>>,
    gradients: BTreeMap<String, Batch>,
    training: BTreeMap<String, Course>,
}

#[derive(Deserialize)]
struct Batch {
    loss: f64,
    /// Norm of each gradient, and its scalar product with uniform draws minus ½.
    gradients: BTreeMap<String, [f64; 2]>,
}

#[derive(Deserialize)]
struct Course {
    losses: Vec<f64>,
    /// Largest deviation of PyTorch's single precision from its double precision, relative to the first loss.
    stray: f64,
}

fn golden() -> Golden {
    serde_json::from_str(include_str!("golden/torch.json")).expect("the golden numbers")
}

fn architecture(name: &str, input: Picture) -> Architecture {
    match name {
        "resnet10" => Architecture::residual(Depth::Ten, input, 6),
        "resnet18" => Architecture::residual(Depth::Eighteen, input, 6),
        "resnet34" => Architecture::residual(Depth::ThirtyFour, input, 6),
        "plain" => Architecture::five_layers(input, 6),
        _ => panic!("{name} is no network of the golden numbers"),
    }
}

const PICTURE: Picture = Picture {
    height: 45,
    width: 38,
    channels: 3,
};

#[test]
fn predictions_are_pytorch_s() {
    for (name, seed) in [
        ("resnet10", 1),
        ("resnet18", 2),
        ("resnet34", 3),
        ("plain", 4),
    ] {
        let network = filled(&architecture(name, PICTURE), seed);
        let mut found = vec![0.0; 12];
        let pictures = singles(seed + 1000, 2 * PICTURE.len());
        network
            .predictor()
            .predict(&pictures, &mut found)
            .expect("finite");
        let expected = &golden().outputs[name];
        let size = expected
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for (found, expected) in found.iter().zip(expected) {
            // Rounding errors of single precision through up to 36 layers, with running moments folded into weights.
            let error = (found - expected).abs() / size;
            assert!(error < 2e-5, "{name}: {found}, PyTorch {expected}");
        }
    }
}

#[test]
fn losses_and_gradients_are_pytorch_s() {
    let cases = [
        ("resnet18", Loss::SquaredError, 10_000),
        ("resnet34", Loss::Huber { delta: 1.0 }, 20_000),
        ("resnet10", Loss::CrossEntropy, 30_000),
        ("plain", Loss::SquaredError, 40_000),
    ];
    for (name, loss, seed) in cases {
        let mut network = filled(&architecture(name, PICTURE), seed);
        let values = doubles(seed + 2000, 4 * 6);
        let labels = match loss {
            Loss::CrossEntropy => Labels::Classes(&[0, 5, 3, 3]),
            _ => Labels::Values(&values),
        };
        let pictures = singles(seed + 1000, 4 * PICTURE.len());
        let samples = Samples {
            pictures: &pictures,
            labels,
        };
        let found = network.gradients(samples, loss).expect("finite");
        let expected = &golden().gradients[name];
        assert!(
            (found.loss / expected.loss - 1.0).abs() < 1e-5,
            "{name}: {}",
            found.loss
        );
        assert_eq!(found.tensors.len(), expected.gradients.len());
        for ((seed, tensor), (expected_name, digest)) in
            (seed + 3000..).zip(&found.tensors).zip(&expected.gradients)
        {
            assert_eq!(&tensor.name, expected_name);
            let values = || tensor.values.iter().copied().map(f64::from);
            let norm = values().map(|value| value * value).sum::<f64>().sqrt();
            let draws = (0_u64..).map(|at| unit(seed, at) - 0.5);
            let product: f64 = values().zip(draws).map(|(value, draw)| value * draw).sum();
            let size = digest[0];
            // Moments of the last stage average eight numbers, which magnifies rounding errors.
            assert!(
                (norm - size).abs() < 1e-3 * size,
                "{name} {expected_name}: norm {norm}, PyTorch {size}"
            );
            let width = (tensor.values.len() as f64 / 12.0).sqrt();
            let bound = 1e-3 * size * width.max(1.0) / (tensor.values.len() as f64).sqrt() * 6.0;
            assert!(
                (product - digest[1]).abs() < bound,
                "{name} {expected_name}: product {product}, PyTorch {}",
                digest[1]
            );
        }
    }
}

#[test]
fn two_hundred_steps_go_as_pytorch_s() {
    let side = Picture {
        height: 48,
        width: 48,
        channels: 3,
    };
    let momentum = Optimizer::Sgd {
        momentum: 0.9,
        weight_decay: 1e-4,
    };
    let cases = [
        ("resnet18", Loss::SquaredError, momentum, 50_000),
        (
            "plain",
            Loss::Huber { delta: 1.0 },
            Optimizer::ADAM_W,
            60_000,
        ),
    ];
    for (name, loss, optimizer, seed) in cases {
        let course = &golden().training[name];
        let network = filled(&architecture(name, side), seed);
        let (pictures, labels) = (
            singles(seed + 1000, 8 * side.len()),
            doubles(seed + 2000, 8 * 6),
        );
        let recipe = Recipe {
            epochs: 200,
            batch: 8,
            optimizer,
            rate: 3e-4,
            schedule: Schedule::Constant,
            loss,
            class_weights: Vec::new(),
            scaling: LabelScaling::None,
            augmentation: Augmentation::default(),
            patience: None,
            seed: 0,
        };
        let samples = Samples {
            pictures: &pictures,
            labels: Labels::Values(&labels),
        };
        let mut trainer = Trainer::of(network, &recipe, samples, None).expect("a training");
        for (step, expected) in course.losses.iter().enumerate() {
            let found = trainer
                .step()
                .expect("finite")
                .expect("a step is left")
                .loss;
            // Rounding differs from PyTorch's, so the limit is four times the deviation of PyTorch's own single precision.
            let error = (found - expected).abs() / course.losses[0];
            assert!(
                error < 4.0 * course.stray + 1e-6,
                "{name}, step {step}: {found}, PyTorch {expected}, its single precision strays by {}",
                course.stray
            );
        }
        assert!(trainer.is_finished());
    }
}
