//! Networks: weights, forward pass and backward pass.

mod gradients;
mod tensors;

pub use gradients::Gradients;
pub use tensors::NamedTensor;

use taceva_core::{Isa, single};

use crate::architecture::{Architecture, StagePlan};
use crate::batch_norm;
use crate::convolution::ConvolutionForm;
use crate::error::NetworkError;
use crate::head::Head;
use crate::machine::Machine;
use crate::normalised_convolution::{Back, Normed};
use crate::planes::{Pictures, Planes};
use crate::scratch::Scratch;
use crate::stage::{Stage, StageSpace, Standing};
use crate::update::Update;
use taceva_core::random::Draws;

/// Weights of an architecture, and the running moments of its normalisations.
#[derive(Clone, Debug)]
pub struct Network {
    pub(crate) architecture: Architecture,
    pub(crate) machine: Machine,
    pub(crate) stages: Vec<Stage>,
    pub(crate) head: Head,
}

/// Activations and buffers of a training, which the backward pass needs after the forward pass.
#[derive(Debug)]
pub(crate) struct TrainingSpace {
    pub(crate) input: Planes,
    stages: Vec<StageSpace>,
    features: Vec<f32>,
    outputs: Vec<f64>,
    scratch: Scratch,
}

impl Network {
    /// Epsilon added to a batch variance before its square root, as in PyTorch.
    pub const NORM_EPSILON: f64 = batch_norm::EPSILON;

    /// Weight of the newest batch in the running moments, as in PyTorch.
    pub const NORM_MOMENTUM: f64 = batch_norm::MOMENTUM;

    /// Creates a network with random weights, distributed as in torchvision. Convolution weights are normal with variance 2 / (kernel² · outputs). The weights
    /// of the last layer are uniform within ±1/√features.
    ///
    /// # Errors
    /// [`NetworkError::Architecture`] if the architecture is invalid.
    /// # Reference
    /// K. He, X. Zhang, S. Ren, J. Sun, "Delving deep into rectifiers", ICCV 2015.
    pub fn new(architecture: &Architecture, seed: u64) -> Result<Network, NetworkError> {
        let mut network = Network::zeros(architecture)?;
        let stages = network.stages.iter_mut();
        for normed in stages.flat_map(Stage::normed_mut) {
            let convolution = normed.convolution();
            let fan = (convolution.taps() * convolution.outputs) as f64;
            let draws = Draws::new(seed).of(normed.slot as u64);
            let mut plain = normed.weights.to_plain();
            for (position, weight) in plain.iter_mut().enumerate() {
                *weight = single(draws.normal(position as u64) * (2.0 / fan).sqrt());
            }
            normed.weights.set_plain(&plain);
        }
        let head = &mut network.head;
        let bound = 1.0 / (head.features() as f64).sqrt();
        for (slot, values) in [
            (head.slot, &mut head.weights),
            (head.slot + 1, &mut head.bias),
        ] {
            let draws = Draws::new(seed).of(slot as u64);
            for (position, value) in values.iter_mut().enumerate() {
                *value = single((2.0 * draws.unit(position as u64) - 1.0) * bound);
            }
        }
        Ok(network)
    }

    /// Creates a network with weights of zero.
    fn zeros(architecture: &Architecture) -> Result<Network, NetworkError> {
        architecture.check()?;
        let (mut stages, mut slot) = (Vec::new(), 0);
        let mut picture = architecture.input;
        for plan in architecture.stages() {
            let stage = Stage::new(plan, picture.channels, slot);
            slot += Normed::SLOTS * stage.normed().len();
            picture = plan.output(picture);
            stages.push(stage);
        }
        let head = Head::new(architecture.pooling(), picture, architecture.outputs, slot);
        Ok(Network {
            architecture: architecture.clone(),
            machine: Machine::with(Isa::detect()).expect("detected"),
            stages,
            head,
        })
    }

    /// Selects the instruction set `isa` for computations.
    ///
    /// # Errors
    /// [`NetworkError::Architecture`] if the CPU lacks `isa`.
    pub fn on(mut self, isa: Isa) -> Result<Network, NetworkError> {
        self.machine = Machine::with(isa).ok_or_else(|| NetworkError::Architecture {
            reason: format!("this CPU lacks the instruction set {isa}"),
        })?;
        Ok(self)
    }

    /// True if all running moments are finite.
    pub(crate) fn are_moments_finite(&self) -> bool {
        let mut norms = self.stages.iter().flat_map(Stage::normed);
        norms.all(|(normed, _)| {
            let moments = [&normed.norm.running_mean, &normed.norm.running_variance];
            moments
                .into_iter()
                .all(|moments| moments.iter().all(|value| value.is_finite()))
        })
    }

    /// Architecture of the network.
    pub fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    /// Number of trainable parameters: weights, gains and biases.
    pub fn parameters(&self) -> usize {
        self.slot_lengths().into_iter().sum()
    }

    /// Number of slots, each the index of a parameter tensor in a backward pass.
    pub(crate) fn slots(&self) -> usize {
        self.head.slot + Head::SLOTS
    }

    /// Length of the parameter vector in each slot.
    pub(crate) fn slot_lengths(&self) -> Vec<usize> {
        let normed = self.stages.iter().flat_map(Stage::normed);
        let parts = normed.flat_map(|(part, _)| {
            let channels = part.norm.gain.len();
            [part.weights.values().len(), channels, channels]
        });
        parts
            .chain([self.head.weights.len(), self.head.bias.len()])
            .collect()
    }

    /// Allocates buffers for training, with batches of `batch` pictures and the convolution algorithm `form`.
    ///
    /// # Errors
    /// [`NetworkError::Memory`] if the transformed weights of one convolution do not fit into memory.
    pub(crate) fn training_space(
        &self,
        batch: usize,
        form: ConvolutionForm,
    ) -> Result<TrainingSpace, NetworkError> {
        let plans = self.architecture.stages();
        let mut picture = self.architecture.input;
        let input = plans[0].input_layout(picture);
        let mut stages = Vec::with_capacity(plans.len());
        let mut border = input.border;
        for (position, (plan, stage)) in plans.iter().zip(&self.stages).enumerate() {
            let output = plan.output(picture);
            let next = plans.get(position + 1);
            let next_border = next.map_or(0, |next| next.input_layout(output).border);
            stages.push(stage.space(Standing {
                input: crate::planes::Layout { picture, border },
                border: next_border,
                batch,
                is_first: position == 0,
                form,
            }));
            (picture, border) = (output, next_border);
        }
        let normed = self.stages.iter().flat_map(Stage::normed);
        let largest = normed.map(|(part, _)| part.weights.values().len()).max();
        let transformed = stages.iter().map(StageSpace::transformed_len).max();
        Ok(TrainingSpace {
            input: Planes::zeros(input.picture, input.border, batch),
            stages,
            features: Vec::new(),
            outputs: Vec::new(),
            scratch: Scratch::new(largest.unwrap_or(0), transformed.unwrap_or(0))?,
        })
    }

    /// Runs the forward pass on the first `count` pictures of `space`. Normalises by batch moments.
    ///
    /// # Shapes
    /// Returns `[count, outputs]`.
    pub(crate) fn forward<'a>(&mut self, space: &'a mut TrainingSpace, count: usize) -> &'a [f64] {
        for position in 0..self.stages.len() {
            let (before, rest) = space.stages.split_at_mut(position);
            let input = before.last().map_or(&space.input, StageSpace::output);
            let (stage, scratch) = (&mut self.stages[position], &mut space.scratch);
            let pictures = Pictures {
                planes: input,
                count,
            };
            stage.forward(self.machine, &mut rest[0], pictures, scratch);
        }
        let last = space.stages.last().expect("an architecture has stages");
        self.head.see(last.output(), count, &mut space.features);
        self.head.forward(&space.features, &mut space.outputs);
        &space.outputs
    }

    /// Runs the backward pass from the output gradient. Calls `update` with the gradient of each parameter.
    ///
    /// # Shapes
    /// `gradient`: `[count, outputs]`, for the pictures of the last [`forward`](Network::forward).
    pub(crate) fn backward(
        &mut self,
        space: &mut TrainingSpace,
        gradient: &[f64],
        update: &mut dyn Update,
    ) {
        let TrainingSpace {
            input,
            stages,
            features,
            scratch,
            ..
        } = space;
        let count = gradient.len() / self.head.outputs();
        let last = stages.last().expect("an architecture has stages");
        let mut passed = scratch.take(last.output().layout().bare(), count);
        self.head.backward(features, gradient, &mut passed, update);
        let mut back = Back {
            machine: self.machine,
            count,
            scratch,
            update,
        };
        for position in (0..self.stages.len()).rev() {
            let (before, rest) = stages.split_at_mut(position);
            let input = before.last().map_or(&*input, StageSpace::output);
            let stage = &mut self.stages[position];
            match stage.backward(&mut rest[0], input, passed, &mut back) {
                Some(gradient) => passed = gradient,
                None => break,
            }
        }
    }

    /// All stages, each with its plan.
    pub(crate) fn planned(&self) -> impl Iterator<Item = (StagePlan, &Stage)> {
        self.architecture.stages().into_iter().zip(&self.stages)
    }
}
