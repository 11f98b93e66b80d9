//! Compares every kind of layer with a plain network in double precision: outputs, and gradients by finite differences.

use crate::common::plain::{self, Moments, Tensors};
use crate::draws::{doubles, filled, singles, unit};
use taceva_network::{
    Architecture, Body, Depth, Isa, Labels, Loss, Network, Picture, PlainLayer, Pooling, Samples,
};

/// Networks that together have every layer, every stride, odd and even sides, and both kinds of pooling.
fn architectures() -> Vec<Architecture> {
    let layer = |channels, kernel, stride| PlainLayer {
        channels,
        kernel,
        stride,
    };
    let plain = |input, layers, pooling| Architecture {
        input,
        body: Body::Plain { layers, pooling },
        outputs: 3,
    };
    let picture = |height, width, channels| Picture {
        height,
        width,
        channels,
    };
    vec![
        plain(
            picture(9, 8, 2),
            vec![layer(16, 3, 1), layer(32, 3, 2), layer(16, 1, 1)],
            Pooling::Flatten,
        ),
        plain(
            picture(5, 6, 1),
            vec![layer(16, 3, 1), layer(48, 3, 1), layer(16, 3, 1)],
            Pooling::Flatten,
        ),
        plain(
            picture(11, 14, 1),
            vec![layer(48, 5, 2), layer(16, 5, 1), layer(80, 3, 2)],
            Pooling::Average,
        ),
        plain(
            picture(7, 7, 3),
            vec![layer(16, 7, 3), layer(16, 3, 3)],
            Pooling::Average,
        ),
        Architecture::residual(Depth::Ten, picture(33, 17, 2), 3),
    ]
}

const BATCH: usize = 4;

fn pictures(architecture: &Architecture) -> Vec<f32> {
    singles(77, BATCH * architecture.input.len())
}

fn on_each_isa(network: &Network) -> impl Iterator<Item = (Isa, Network)> {
    let sets = Isa::available().into_iter();
    sets.map(|isa| (isa, network.clone().on(isa).expect("available")))
}

#[test]
fn predictions_are_those_of_a_plain_network() {
    for architecture in architectures() {
        let network = filled(&architecture, 5);
        let pictures = pictures(&architecture);
        let tensors = plain::tensors(&network);
        let expected = plain::outputs(&architecture, &tensors, &pictures, Moments::Running);
        let size = expected
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        for (isa, network) in on_each_isa(&network) {
            let mut found = vec![0.0; expected.len()];
            network
                .predictor()
                .predict(&pictures, &mut found)
                .expect("finite");
            for (found, expected) in found.iter().zip(&expected) {
                let error = (found - expected).abs() / size;
                assert!(
                    error < 1e-5,
                    "{isa} {architecture:?}: {found}, expected {expected}"
                );
            }
        }
    }
}

/// Loss of a plain network, in double precision.
fn plain_loss(
    architecture: &Architecture,
    tensors: &Tensors,
    pictures: &[f32],
    loss: Loss,
    labels: &[f64],
) -> f64 {
    let outputs = plain::outputs(architecture, tensors, pictures, Moments::Batch);
    match loss {
        Loss::SquaredError => {
            let squares = outputs
                .iter()
                .zip(labels)
                .map(|(output, label)| (output - label).powi(2));
            squares.sum::<f64>() / labels.len() as f64
        }
        Loss::Huber { delta } => {
            let each = outputs.iter().zip(labels).map(|(output, label)| {
                let distance = (output - label).abs();
                if distance < delta {
                    distance * distance / 2.0
                } else {
                    delta * (distance - delta / 2.0)
                }
            });
            each.sum::<f64>() / labels.len() as f64
        }
        Loss::CrossEntropy => {
            let rows = outputs.chunks(architecture.outputs).zip(CLASSES);
            let each = rows.map(|(row, class)| {
                let sum: f64 = row.iter().map(|output| output.exp()).sum();
                sum.ln() - row[class as usize]
            });
            each.sum::<f64>() / BATCH as f64
        }
    }
}

const CLASSES: [u32; BATCH] = [2, 0, 1, 2];

#[test]
fn gradients_are_those_of_finite_differences() {
    let losses = [
        Loss::SquaredError,
        Loss::SquaredError,
        Loss::Huber { delta: 0.3 },
        Loss::CrossEntropy,
        Loss::SquaredError,
    ];
    for (architecture, loss) in architectures().into_iter().zip(losses) {
        let network = filled(&architecture, 6);
        let (pictures, labels) = (pictures(&architecture), doubles(78, BATCH * 3));
        let samples = Samples {
            pictures: &pictures,
            labels: match loss {
                Loss::CrossEntropy => Labels::Classes(&CLASSES),
                _ => Labels::Values(&labels),
            },
        };
        let mut tensors = plain::tensors(&network);
        let expected_loss = plain_loss(&architecture, &tensors, &pictures, loss, &labels);
        let gradients: Vec<_> = on_each_isa(&network)
            .map(|(isa, mut network)| (isa, network.gradients(samples, loss).expect("finite")))
            .collect();
        for (isa, found) in &gradients {
            assert!(
                (found.loss / expected_loss - 1.0).abs() < 1e-5,
                "{isa} {architecture:?}"
            );
        }
        for (number, tensor) in gradients[0].1.tensors.iter().enumerate() {
            // Only a few values of each tensor: each costs two passes of the plain network.
            let count = if matches!(architecture.body, Body::Plain { .. }) {
                6
            } else {
                1
            };
            for draw in 0..count {
                let length = tensor.values.len() as f64;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a place of the tensor"
                )]
                let place = (unit(1000 + number as u64, draw) * length) as usize;
                let mut beside = |step: f64| {
                    let values = tensors.get_mut(&tensor.name).expect("the same names");
                    let kept = values[place];
                    values[place] += step;
                    let loss = plain_loss(&architecture, &tensors, &pictures, loss, &labels);
                    tensors.get_mut(&tensor.name).expect("the same names")[place] = kept;
                    loss
                };
                // The step is wide enough for double precision, and narrow enough to cross few corners of ReLU.
                let step = 1e-6;
                let slope = (beside(step) - beside(-step)) / (2.0 * step);
                for (isa, found) in &gradients {
                    let values = &found.tensors[number].values;
                    let squares = values.iter().map(|value| f64::from(*value).powi(2));
                    let size = (squares.sum::<f64>() / length).sqrt();
                    let error = (f64::from(values[place]) - slope).abs();
                    assert!(
                        error <= 2e-3 * (size + slope.abs()) + 1e-9,
                        "{isa} {architecture:?} {} {place}: {}, expected {slope}",
                        tensor.name,
                        values[place]
                    );
                }
            }
        }
    }
}
