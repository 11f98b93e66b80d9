//! One training step: forward pass with batch moments, gradients by burn's automatic differentiation, and the update of the weights.

use burn_autodiff::Autodiff;
use burn_tensor::Tensor;
use burn_tensor::backend::Backend;
use taceva_core::single;

use crate::gpu::autodiff::convolved;
use crate::gpu::normalisation::normalised;
use crate::gpu::passes::{Head, Normed, Pass, Passes};
use crate::gpu::products::Products;
use crate::gpu::weights::{Layout, Weights, numbers, vector};
use crate::{Network, Rule};

/// State of a training step after the forward pass.
pub(crate) struct Course<B: Backend> {
    /// Trained tensors, which track gradients.
    learnt: Vec<Tensor<Autodiff<B>, 1>>,
    /// Mean and unbiased variance of the batch for each normalisation, in the order of the running moments.
    moments: Vec<Option<Tensor<B, 1>>>,
    outputs: Tensor<Autodiff<B>, 2>,
}

impl<B: Products> Course<B> {
    /// Runs the forward pass on `pictures`.
    pub(crate) fn forward(
        passes: &Passes<B>,
        layout: &Layout,
        weights: &Weights<B>,
        pictures: Tensor<B, 4>,
    ) -> Course<B> {
        let slices = layout.learnt.iter();
        let learnt: Vec<_> = slices
            .map(|slice| Tensor::from_inner(slice.of(&weights.learnt)).require_grad())
            .collect();
        let mut moments = vec![None; layout.running.len()];
        let mut step = Step {
            learnt: &learnt,
            moments: &mut moments,
        };
        let outputs = passes.run(Tensor::from_inner(pictures), &mut step);
        Course {
            learnt,
            moments,
            outputs,
        }
    }

    /// Downloads the outputs. Waits until the device has computed them.
    ///
    /// # Shapes
    /// Returns `[samples, outputs]`.
    pub(crate) fn outputs(&self) -> Vec<f64> {
        let outputs = numbers(self.outputs.clone().inner());
        outputs.into_iter().map(f64::from).collect()
    }

    /// Gradient of all trained values, from the output gradient `gradient`.
    pub(crate) fn backward(&self, gradient: &[f64]) -> Tensor<B, 1> {
        let device = self.outputs.device();
        let gradient: Vec<f32> = gradient.iter().copied().map(single).collect();
        let gradient = vector::<Autodiff<B>>(gradient, &device).reshape(self.outputs.dims());
        // The derivative of this product with respect to the outputs is `gradient`, for any loss.
        let mut gradients = (self.outputs.clone() * gradient).sum().backward();
        let each = self.learnt.iter().map(|tensor| {
            let found = tensor.grad_remove(&mut gradients);
            found.expect("the outputs depend on every tensor that is learnt")
        });
        Tensor::cat(each.collect(), 0)
    }

    /// Running moments after their update by this batch.
    pub(crate) fn followed(&self, running: &Tensor<B, 1>) -> Tensor<B, 1> {
        let moments = self.moments.iter().cloned();
        let moments = moments.map(|moment| moment.expect("each normalisation was passed"));
        let newest = Tensor::cat(moments.collect(), 0);
        let share = Network::NORM_MOMENTUM;
        running.clone() * (1.0 - share) + newest * share
    }
}

/// Training pass, which normalises by the batch moments and stores these.
struct Step<'a, B: Backend> {
    learnt: &'a [Tensor<Autodiff<B>, 1>],
    moments: &'a mut [Option<Tensor<B, 1>>],
}

impl<B: Products> Pass<B, Autodiff<B>> for Step<'_, B> {
    fn normed(
        &mut self,
        normed: &Normed<B>,
        pictures: Tensor<Autodiff<B>, 4>,
    ) -> Tensor<Autodiff<B>, 4> {
        let raw = convolved(&normed.convolution, pictures, self.learnt(normed.weight));
        let batch = normalised(raw, self.learnt(normed.gain), self.learnt(normed.bias));
        self.moments[normed.mean] = Some(batch.mean);
        self.moments[normed.variance] = Some(batch.variance);
        batch.given
    }

    fn weighted(&self, head: &Head<B>, features: Tensor<Autodiff<B>, 4>) -> Tensor<Autodiff<B>, 4> {
        convolved(&head.convolution, features, self.learnt(head.weight))
    }

    fn learnt(&self, position: usize) -> Tensor<Autodiff<B>, 1> {
        self.learnt[position].clone()
    }
}

/// Weights after a step by `rule`. `moments` contains the state of the optimiser, and is empty before the first step.
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
