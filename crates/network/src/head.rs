//! Output layer of a network: pooling to features, and linear outputs of the features.

use crate::architecture::Pooling;
use crate::panel::Aligned;
use crate::picture::Picture;
use crate::planes::{Layout, Planes};
use crate::update::Update;
use taceva_core::single;

/// Linear output layer, which reads the pooled features.
#[derive(Clone, Debug)]
pub(crate) struct Head {
    pub(crate) pooling: Pooling,
    /// Weights, shape `[outputs, features]`.
    pub(crate) weights: Aligned,
    /// Bias of each output.
    pub(crate) bias: Aligned,
    /// Index (slot) of the weights among the parameter tensors of a network. The bias has the following slot.
    pub(crate) slot: usize,
}

impl Head {
    /// Number of parameter tensors (slots): weights and bias.
    pub(crate) const SLOTS: usize = 2;

    pub(crate) fn new(pooling: Pooling, picture: Picture, outputs: usize, slot: usize) -> Head {
        Head {
            pooling,
            weights: Aligned::zeros(pooling.features(picture) * outputs),
            bias: Aligned::zeros(outputs),
            slot,
        }
    }

    /// Number of outputs.
    pub(crate) fn outputs(&self) -> usize {
        self.bias.len()
    }

    /// Number of features per sample.
    pub(crate) fn features(&self) -> usize {
        self.weights.len() / self.bias.len()
    }

    /// Writes the features of the first `count` pictures to `into`.
    ///
    /// # Shapes
    /// `into`: `[pictures, features]`.
    pub(crate) fn see(&self, pictures: &Planes, count: usize, into: &mut Vec<f32>) {
        let layout = pictures.layout();
        into.clear();
        for image in pictures.first(count).chunks_exact(layout.len()) {
            let rows = (0..layout.picture.height).map(|y| &image[layout.row_range(y)]);
            match self.pooling {
                Pooling::Flatten => into.extend(rows.flatten()),
                Pooling::Average => {
                    let channels = layout.picture.channels;
                    let mut sums = vec![0.0_f64; channels];
                    for pixel in rows.flat_map(|row| row.chunks_exact(channels)) {
                        let places = sums.iter_mut().zip(pixel);
                        places.for_each(|(sum, value)| *sum += f64::from(*value));
                    }
                    let pixels = layout.picture.pixels() as f64;
                    into.extend(sums.iter().map(|sum| single(sum / pixels)));
                }
            }
        }
    }

    /// Computes outputs = bias + weights · features.
    ///
    /// # Shapes
    /// `features`: `[samples, features]`. `into`: `[samples, outputs]`.
    pub(crate) fn forward(&self, features: &[f32], into: &mut Vec<f64>) {
        into.clear();
        for features in features.chunks_exact(self.features()) {
            let rows = self.weights.chunks_exact(self.features());
            into.extend(rows.zip(&*self.bias).map(|(row, bias)| {
                // Eight independent sums, so additions do not wait for each other.
                let mut sums = [0.0_f64; 8];
                let (row, rest) = row.as_chunks::<8>();
                let (seen, seen_rest) = features.as_chunks::<8>();
                for (weights, features) in row.iter().zip(seen) {
                    for lane in 0..8 {
                        sums[lane] += f64::from(weights[lane]) * f64::from(features[lane]);
                    }
                }
                let rest = rest.iter().zip(seen_rest);
                let rest: f64 = rest.map(|(a, b)| f64::from(*a) * f64::from(*b)).sum();
                f64::from(*bias) + sums.iter().sum::<f64>() + rest
            }));
        }
    }

    /// Writes the gradient of the pictures. Calls `update` with the gradients of weights and bias.
    ///
    /// # Shapes
    /// `gradient`: `[samples, outputs]`, the output gradient. `into`: pictures without a border.
    pub(crate) fn backward(
        &mut self,
        features: &[f32],
        gradient: &[f64],
        into: &mut Planes,
        update: &mut dyn Update,
    ) {
        let (width, outputs) = (self.features(), self.outputs());
        let layout = into.layout();
        let images = into
            .first_mut(gradient.len() / outputs)
            .chunks_exact_mut(layout.len());
        for (image, gradient) in images.zip(gradient.chunks_exact(outputs)) {
            let mut passed = vec![0.0_f64; width];
            for (row, gradient) in self.weights.chunks_exact(width).zip(gradient) {
                let places = passed.iter_mut().zip(row);
                places.for_each(|(place, weight)| *place += gradient * f64::from(*weight));
            }
            self.spread(&passed, layout, image);
        }

        let mut sums = vec![0.0_f64; outputs * width];
        let mut bias = vec![0.0_f64; outputs];
        for (features, gradient) in features
            .chunks_exact(width)
            .zip(gradient.chunks_exact(outputs))
        {
            for (output, gradient) in gradient.iter().enumerate() {
                bias[output] += gradient;
                let places = sums[output * width..][..width].iter_mut().zip(features);
                places.for_each(|(sum, feature)| *sum += gradient * f64::from(*feature));
            }
        }
        let narrow = |values: Vec<f64>| -> Vec<f32> { values.into_iter().map(single).collect() };
        update.update(self.slot, &mut self.weights, &narrow(sums));
        update.update(self.slot + 1, &mut self.bias, &narrow(bias));
    }

    /// Distributes the gradient of features over the pixels of a picture.
    fn spread(&self, passed: &[f64], layout: Layout, into: &mut [f32]) {
        match self.pooling {
            Pooling::Flatten => {
                let places = into.iter_mut().zip(passed);
                places.for_each(|(place, value)| *place = single(*value));
            }
            Pooling::Average => {
                let share = 1.0 / layout.picture.pixels() as f64;
                for pixel in into.chunks_exact_mut(passed.len()) {
                    let places = pixel.iter_mut().zip(passed);
                    places.for_each(|(place, value)| *place = single(value * share));
                }
            }
        }
    }
}
