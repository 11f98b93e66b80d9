//! One step of training: forward with the moments of the batch, gradients by burn's automatic differentiation, and the rule by
//! which weights follow.

use burn_autodiff::Autodiff;
use burn_tensor::Tensor;
use burn_tensor::backend::Backend;
use taceva_network::{Network, Rule};

use crate::passes::{Normed, Passes};
use crate::weights::{Layout, Weights, numbers, vector};

/// What a step makes of a batch.
pub(crate) struct Course<B: Backend> {
    /// The tensors that are learnt, whose gradients are asked for.
    learnt: Vec<Tensor<Autodiff<B>, 1>>,
    /// Mean and unbiased variance of the batch, as running moments lie.
    moments: Vec<Option<Tensor<B, 1>>>,
    outputs: Tensor<Autodiff<B>, 2>,
}

impl<B: Backend> Course<B> {
    /// Passes `pictures`.
    pub(crate) fn forward(
        passes: &Passes,
        layout: &Layout,
        weights: &Weights<B>,
        pictures: Tensor<B, 4>,
    ) -> Course<B> {
        let slices = layout.learnt.iter();
        let learnt: Vec<_> = slices
            .map(|slice| Tensor::from_inner(slice.of(&weights.learnt)).require_grad())
            .collect();
        let mut moments = vec![None; layout.running.len()];
        let outputs = passes.run(Tensor::from_inner(pictures), &learnt, |normed, pictures| {
            norm(normed, pictures, &learnt, &mut moments)
        });
        Course {
            learnt,
            moments,
            outputs,
        }
    }

    /// The outputs, once the device has them.
    ///
    /// # Shapes
    /// `[samples, outputs]`.
    pub(crate) fn outputs(&self) -> Vec<f64> {
        let outputs = numbers(self.outputs.clone().inner());
        outputs.into_iter().map(f64::from).collect()
    }

    /// The gradient of each number that is learnt, from `gradient`, that of the outputs.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "formed in double precision and passed back in single"
    )]
    pub(crate) fn backward(&self, gradient: &[f64]) -> Tensor<B, 1> {
        let device = self.outputs.device();
        let gradient: Vec<f32> = gradient.iter().map(|number| *number as f32).collect();
        let gradient = vector::<Autodiff<B>>(gradient, &device).reshape(self.outputs.dims());
        // The derivative of this product by the outputs is the gradient, whatever the loss was.
        let mut gradients = (self.outputs.clone() * gradient).sum().backward();
        let each = self.learnt.iter().map(|tensor| {
            let found = tensor.grad_remove(&mut gradients);
            found.expect("the outputs depend on every tensor that is learnt")
        });
        Tensor::cat(each.collect(), 0)
    }

    /// Running moments after this batch.
    pub(crate) fn followed(&self, running: &Tensor<B, 1>) -> Tensor<B, 1> {
        let moments = self.moments.iter().cloned();
        let moments = moments.map(|moment| moment.expect("each normalisation was passed"));
        let newest = Tensor::cat(moments.collect(), 0);
        let share = Network::NORM_MOMENTUM;
        running.clone() * (1.0 - share) + newest * share
    }
}

/// Convolves `pictures` and normalises them by their own moments, which are kept.
fn norm<B: Backend>(
    normed: &Normed,
    pictures: Tensor<Autodiff<B>, 4>,
    learnt: &[Tensor<Autodiff<B>, 1>],
    moments: &mut [Option<Tensor<B, 1>>],
) -> Tensor<Autodiff<B>, 4> {
    let raw = normed.convolve(pictures, learnt[normed.weight].clone(), None);
    let [samples, channels, height, width] = raw.dims();
    let pixels = samples * height * width;
    // Channels last, as convolutions write them: then nothing is moved.
    let raw = raw.permute([0, 2, 3, 1]).reshape([pixels, channels]);
    let mean = raw.clone().mean_dim(0);
    let centred = raw - mean.clone();
    let variance = (centred.clone() * centred.clone()).mean_dim(0);
    let unbiased = pixels as f64 / (pixels as f64 - 1.0);
    let kept = |moment: &Tensor<Autodiff<B>, 2>| moment.clone().inner().reshape([channels]);
    moments[normed.mean] = Some(kept(&mean));
    moments[normed.variance] = Some(kept(&variance) * unbiased);
    let row = |position: usize| learnt[position].clone().reshape([1, channels]);
    let scale = row(normed.gain) / (variance + Network::NORM_EPSILON).sqrt();
    let normalised = centred * scale + row(normed.bias);
    let shaped = normalised.reshape([samples, height, width, channels]);
    shaped.permute([0, 3, 1, 2])
}

/// The weights after a step by `rule`; `moments` are what the optimiser remembers, none before the first step.
pub(crate) fn descend<B: Backend>(
    rule: Rule,
    weights: &Tensor<B, 1>,
    gradient: Tensor<B, 1>,
    moments: &mut Vec<Tensor<B, 1>>,
) -> Tensor<B, 1> {
    let weights = weights.clone();
    let count = match rule {
        Rule::Momentum(_) => 1,
        Rule::Adam(_) => 2,
    };
    moments.resize(count, Tensor::zeros_like(&weights));
    match rule {
        Rule::Momentum(rule) => {
            let pull = gradient + weights.clone() * rule.decay;
            let velocity = moments[0].clone() * rule.momentum + pull;
            moments[0] = velocity.clone();
            weights - velocity * rule.rate
        }
        Rule::Adam(rule) => {
            let square = gradient.clone() * gradient.clone();
            let mean = moments[0].clone() * rule.betas.0 + gradient * rule.news.0;
            let square = moments[1].clone() * rule.betas.1 + square * rule.news.1;
            *moments = vec![mean.clone(), square.clone()];
            let root = square.sqrt() * rule.correction + rule.epsilon;
            weights * rule.keep - mean / root * rule.step
        }
    }
}
