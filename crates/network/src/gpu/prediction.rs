//! Prediction with running moments folded into the weights, so that only convolutions remain.

use burn_tensor::backend::Backend;
use burn_tensor::{Tensor, TensorData};

use crate::gpu::passes::{Head, Normed, Pass, Passes};
use crate::gpu::products::Products;
use crate::gpu::weights::{Layout, Weights, numbers};
use crate::{Network, Picture};

/// Number of pictures per batch.
const BATCH: usize = 256;

/// Weights prepared for prediction.
#[derive(Clone, Debug)]
pub(crate) struct Prediction<B: Backend> {
    learnt: Vec<Tensor<B, 1>>,
    /// Folded weights and bias of each convolution, stored at the index of the convolution's weights.
    folded: Vec<Option<(Tensor<B, 1>, Tensor<B, 1>)>>,
}

impl<B: Products> Prediction<B> {
    pub(crate) fn new(passes: &Passes<B>, layout: &Layout, weights: &Weights<B>) -> Self {
        let learnt: Vec<_> = layout
            .learnt
            .iter()
            .map(|slice| slice.of(&weights.learnt))
            .collect();
        let mut folded = vec![None; learnt.len()];
        for normed in passes.normed() {
            let running = |position: usize| layout.running[position].of(&weights.running);
            let [outputs, ..] = normed.shape;
            let root = (running(normed.variance) + Network::NORM_EPSILON).sqrt();
            let scale = learnt[normed.gain].clone() / root;
            let shift = learnt[normed.bias].clone() - running(normed.mean) * scale.clone();
            let kernels = learnt[normed.weight].clone().reshape(normed.shape);
            let kernels = kernels * scale.reshape([outputs, 1, 1, 1]);
            let count = normed.shape.into_iter().product::<usize>();
            folded[normed.weight] = Some((kernels.reshape([count]), shift));
        }
        Prediction { learnt, folded }
    }

    /// Predicts the outputs for `pictures` of size `picture`, and writes them to `into`.
    pub(crate) fn run(
        &self,
        passes: &Passes<B>,
        picture: Picture,
        pictures: &[f32],
        into: &mut [f64],
        device: &B::Device,
    ) {
        let samples = pictures.len() / picture.len();
        let outputs = into.len() / samples.max(1);
        let batches = pictures.chunks(BATCH * picture.len());
        for (pictures, into) in batches.zip(into.chunks_mut((BATCH * outputs).max(1))) {
            let pictures = pictures_on(picture, pictures.to_vec(), device);
            let found = passes.run(pictures, &mut &*self);
            for (place, output) in into.iter_mut().zip(numbers(found)) {
                *place = f64::from(output);
            }
        }
    }
}

impl<B: Products> Pass<B, B> for &Prediction<B> {
    fn normed(&mut self, normed: &Normed<B>, pictures: Tensor<B, 4>) -> Tensor<B, 4> {
        let (kernels, bias) = self.folded[normed.weight]
            .clone()
            .expect("every convolution was folded");
        let [outputs, ..] = normed.shape;
        let given = normed.convolution.forward(pictures, kernels);
        given + bias.reshape([1, 1, 1, outputs])
    }

    fn weighted(&self, head: &Head<B>, features: Tensor<B, 4>) -> Tensor<B, 4> {
        head.convolution.forward(features, self.learnt(head.weight))
    }

    fn learnt(&self, position: usize) -> Tensor<B, 1> {
        self.learnt[position].clone()
    }
}

/// Uploads `values` as pictures to the device.
///
/// # Shapes
/// `values` and the result: `[samples, height, width, channels]`.
pub(crate) fn pictures_on<B: Backend>(
    picture: Picture,
    values: Vec<f32>,
    device: &B::Device,
) -> Tensor<B, 4> {
    let Picture {
        height,
        width,
        channels,
    } = picture;
    let samples = values.len() / picture.len();
    let shape = [samples, height, width, channels];
    Tensor::from_data(TensorData::new(values, shape), device)
}
