//! Reference networks in double precision and plain code: channels before rows, one loop per dimension.

#![allow(
    dead_code,
    reason = "each suite that shares this file uses a part of it"
)]

use std::collections::BTreeMap;

use taceva_network::{Architecture, Body, Depth, Network, PlainLayer, Pooling};

/// Tensors by name, in double precision.
pub(crate) type Tensors = BTreeMap<String, Vec<f64>>;

/// The tensors of a network.
pub(crate) fn tensors(network: &Network) -> Tensors {
    let tensors = network.tensors().into_iter();
    tensors
        .map(|tensor| {
            (
                tensor.name,
                tensor.values.into_iter().map(f64::from).collect(),
            )
        })
        .collect()
}

/// Moments of the batch or running moments.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Moments {
    Batch,
    Running,
}

/// Pictures in double precision, shape `[count, channels, height, width]`.
#[derive(Clone)]
struct Batch {
    count: usize,
    channels: usize,
    height: usize,
    width: usize,
    values: Vec<f64>,
}

impl Batch {
    fn zeros(count: usize, channels: usize, height: usize, width: usize) -> Batch {
        let values = vec![0.0; count * channels * height * width];
        Batch {
            count,
            channels,
            height,
            width,
            values,
        }
    }

    fn at(&self, image: usize, channel: usize, y: usize, x: usize) -> usize {
        ((image * self.channels + channel) * self.height + y) * self.width + x
    }
}

/// Index, along one dimension, of the input pixel that output `position` reads at kernel position `tap`. `None` outside the picture.
fn met(position: usize, stride: usize, tap: usize, padding: usize, length: usize) -> Option<usize> {
    let at = (position * stride + tap).checked_sub(padding)?;
    (at < length).then_some(at)
}

fn convolve(input: &Batch, weights: &[f64], kernel: usize, stride: usize) -> Batch {
    let outputs = weights.len() / (input.channels * kernel * kernel);
    let (height, width) = (
        (input.height - 1) / stride + 1,
        (input.width - 1) / stride + 1,
    );
    let mut output = Batch::zeros(input.count, outputs, height, width);
    for image in 0..input.count {
        for channel in 0..outputs {
            for from in 0..input.channels {
                for row in 0..kernel {
                    for column in 0..kernel {
                        let weight = weights
                            [((channel * input.channels + from) * kernel + row) * kernel + column];
                        for y in 0..height {
                            let Some(from_y) = met(y, stride, row, kernel / 2, input.height) else {
                                continue;
                            };
                            for x in 0..width {
                                let Some(from_x) = met(x, stride, column, kernel / 2, input.width)
                                else {
                                    continue;
                                };
                                let to = output.at(image, channel, y, x);
                                output.values[to] +=
                                    weight * input.values[input.at(image, from, from_y, from_x)];
                            }
                        }
                    }
                }
            }
        }
    }
    output
}

fn normalise(mut batch: Batch, tensors: &Tensors, name: &str, moments: Moments) -> Batch {
    let tensor = |part: &str| &tensors[&format!("{name}.{part}")];
    let pixels = batch.height * batch.width;
    for channel in 0..batch.channels {
        let places: Vec<usize> = (0..batch.count)
            .flat_map(|image| {
                let first = batch.at(image, channel, 0, 0);
                first..first + pixels
            })
            .collect();
        let count = places.len() as f64;
        let (mean, variance) = match moments {
            Moments::Running => (
                tensor("running_mean")[channel],
                tensor("running_var")[channel],
            ),
            Moments::Batch => {
                let mean = places.iter().map(|&at| batch.values[at]).sum::<f64>() / count;
                let squares = places.iter().map(|&at| (batch.values[at] - mean).powi(2));
                (mean, squares.sum::<f64>() / count)
            }
        };
        for at in places {
            let value = (batch.values[at] - mean) / (variance + 1e-5).sqrt();
            batch.values[at] = value * tensor("weight")[channel] + tensor("bias")[channel];
        }
    }
    batch
}

fn relu(mut batch: Batch) -> Batch {
    batch
        .values
        .iter_mut()
        .for_each(|value| *value = value.max(0.0));
    batch
}

fn pool(input: &Batch) -> Batch {
    let (height, width) = ((input.height - 1) / 2 + 1, (input.width - 1) / 2 + 1);
    let mut output = Batch::zeros(input.count, input.channels, height, width);
    output.values.fill(f64::NEG_INFINITY);
    for image in 0..input.count {
        for channel in 0..input.channels {
            for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
                let to = output.at(image, channel, y, x);
                for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column)))
                {
                    let from = (
                        met(y, 2, row, 1, input.height),
                        met(x, 2, column, 1, input.width),
                    );
                    let (Some(from_y), Some(from_x)) = from else {
                        continue;
                    };
                    let value = input.values[input.at(image, channel, from_y, from_x)];
                    output.values[to] = output.values[to].max(value);
                }
            }
        }
    }
    output
}

fn block(input: &Batch, tensors: &Tensors, name: &str, stride: usize, moments: Moments) -> Batch {
    let part = |input: &Batch, convolution: &str, norm: &str, kernel, stride| {
        let weights = &tensors[&format!("{name}.{convolution}.weight")];
        let norm = format!("{name}.{norm}");
        normalise(
            convolve(input, weights, kernel, stride),
            tensors,
            &norm,
            moments,
        )
    };
    let middle = relu(part(input, "conv1", "bn1", 3, stride));
    let mut sum = part(&middle, "conv2", "bn2", 3, 1);
    let past = if tensors.contains_key(&format!("{name}.downsample.0.weight")) {
        part(input, "downsample.0", "downsample.1", 1, stride)
    } else {
        input.clone()
    };
    sum.values
        .iter_mut()
        .zip(past.values)
        .for_each(|(sum, past)| *sum += past);
    relu(sum)
}

/// Outputs of the network of `architecture` with these tensors for `pictures`.
///
/// # Shapes
/// `pictures`: `[count, height, width, channels]`; the outputs: `[count, outputs]`.
pub(crate) fn outputs(
    architecture: &Architecture,
    tensors: &Tensors,
    pictures: &[f32],
    moments: Moments,
) -> Vec<f64> {
    let picture = architecture.input;
    let count = pictures.len() / picture.len();
    let mut batch = Batch::zeros(count, picture.channels, picture.height, picture.width);
    for (position, &value) in pictures.iter().enumerate() {
        let (pixel, channel) = (position / picture.channels, position % picture.channels);
        let (image, pixel) = (
            pixel / (picture.height * picture.width),
            pixel % (picture.height * picture.width),
        );
        let to = batch.at(image, channel, pixel / picture.width, pixel % picture.width);
        batch.values[to] = f64::from(value);
    }
    let pooling = match &architecture.body {
        Body::Residual(depth) => {
            let raw = convolve(&batch, &tensors["conv1.weight"], 7, 2);
            batch = pool(&relu(normalise(raw, tensors, "bn1", moments)));
            let blocks = match depth {
                Depth::Ten => [1, 1, 1, 1],
                Depth::Eighteen => [2, 2, 2, 2],
                Depth::ThirtyFour => [3, 4, 6, 3],
            };
            for (stage, blocks) in blocks.into_iter().enumerate() {
                for number in 0..blocks {
                    let name = format!("layer{}.{number}", stage + 1);
                    let stride = if stage > 0 && number == 0 { 2 } else { 1 };
                    batch = block(&batch, tensors, &name, stride, moments);
                }
            }
            Pooling::Average
        }
        Body::Plain { layers, pooling } => {
            for (position, &PlainLayer { kernel, stride, .. }) in layers.iter().enumerate() {
                let name = format!("features.{position}");
                let raw = convolve(
                    &batch,
                    &tensors[&format!("{name}.0.weight")],
                    kernel,
                    stride,
                );
                batch = relu(normalise(raw, tensors, &format!("{name}.1"), moments));
            }
            *pooling
        }
    };
    let mut outputs = Vec::new();
    for image in 0..count {
        let pixels = || (0..batch.height).flat_map(|y| (0..batch.width).map(move |x| (y, x)));
        let value = |(y, x), channel| batch.values[batch.at(image, channel, y, x)];
        let features: Vec<f64> = match pooling {
            Pooling::Average => (0..batch.channels)
                .map(|channel| {
                    let sum: f64 = pixels().map(|pixel| value(pixel, channel)).sum();
                    sum / (batch.height * batch.width) as f64
                })
                .collect(),
            Pooling::Flatten => pixels()
                .flat_map(|pixel| (0..batch.channels).map(move |channel| (pixel, channel)))
                .map(|(pixel, channel)| value(pixel, channel))
                .collect(),
        };
        for (row, bias) in tensors["fc.weight"]
            .chunks(features.len())
            .zip(&tensors["fc.bias"])
        {
            let products = row
                .iter()
                .zip(&features)
                .map(|(weight, feature)| weight * feature);
            outputs.push(bias + products.sum::<f64>());
        }
    }
    outputs
}
