//! Training on the CPU.

use super::engine::{Batch, Engine, Moments, Snapshot};
use super::recipe::Recipe;
use crate::convolution::ConvolutionForm;
use crate::error::NetworkError;
use crate::network::{Network, TrainingSpace};
use crate::optimizer::{Descent, Memory};

/// Training engine on the CPU.
#[derive(Debug)]
pub(super) struct Processor {
    network: Network,
    space: TrainingSpace,
    memory: Memory,
    recipe: Recipe,
    form: ConvolutionForm,
}

impl Processor {
    /// Continues from `snapshot`, with the convolution algorithm `form`. The moments of `snapshot` must belong to the optimiser of `recipe`.
    ///
    /// # Errors
    /// [`NetworkError::Memory`] if the transformed weights do not fit into memory.
    pub(super) fn new(
        snapshot: &Snapshot,
        recipe: &Recipe,
        form: ConvolutionForm,
    ) -> Result<Processor, NetworkError> {
        let network = snapshot.network.clone();
        let mut memory = Memory::new(network.slots());
        for tensors in &snapshot.moments {
            for (moments, values) in memory.moments.iter_mut().zip(network.slotted(tensors)) {
                moments.push(values);
            }
        }
        Ok(Processor {
            space: network.training_space(recipe.batch, form)?,
            memory,
            recipe: recipe.clone(),
            form,
            network,
        })
    }
}

impl Engine for Processor {
    fn step(&mut self, batch: &Batch<'_>) -> Result<f64, NetworkError> {
        let &Batch {
            pictures,
            labels,
            step,
            rate,
        } = batch;
        for (position, values) in pictures.iter().enumerate() {
            self.space.input.set(position, values);
        }
        let width = self.network.architecture().outputs;
        let outputs = self.network.forward(&mut self.space, pictures.len());
        let mut gradient = Vec::new();
        let loss = self.recipe.measure(outputs, width, labels, &mut gradient);
        if !loss.is_finite() {
            return Err(NetworkError::LossNotFinite { step });
        }
        let mut descent = Descent {
            machine: self.network.machine,
            optimizer: self.recipe.optimizer,
            rate,
            steps: step + 1,
            memory: &mut self.memory,
            is_broken: false,
        };
        self.network
            .backward(&mut self.space, &gradient, &mut descent);
        if descent.is_broken || !self.network.are_moments_finite() {
            return Err(NetworkError::WeightNotFinite { step });
        }
        Ok(loss)
    }

    fn predict(&mut self, pictures: &[f32], into: &mut [f64]) -> Result<(), NetworkError> {
        let mut predictor = self.network.predictor_in(self.form);
        predictor.predict(pictures, into)
    }

    fn network(&self) -> Result<Network, NetworkError> {
        Ok(self.network.clone())
    }

    fn moments(&self) -> Result<Moments, NetworkError> {
        let moments = &self.memory.moments;
        let kinds = moments.iter().map(Vec::len).min().unwrap_or(0);
        let by_kind = (0..kinds).map(|kind| {
            let of_kind = moments.iter().map(|moments| moments[kind].to_vec());
            self.network.named(of_kind.collect())
        });
        Ok(by_kind.collect())
    }
}
