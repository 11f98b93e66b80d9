//! A training put aside, to be gone on with later.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Recipe, Samples, Trainer, TrainingState};
use crate::architecture::Architecture;
use crate::error::NetworkError;
use crate::network::{NamedTensor, Network};
use crate::panel::Aligned;

/// A training put aside after any step: gone on with, it ends with the same bits as if it had not been.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// What a file of a few lines can hold.
    pub summary: Summary,
    /// Weights now, under `now.`; those of the best epoch, under `best.`; what the optimiser remembers, under `moment.`.
    pub tensors: Vec<NamedTensor>,
}

/// What a checkpoint is of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The network.
    pub architecture: Architecture,
    /// How it is trained.
    pub recipe: Recipe,
    /// How many samples it learns from.
    pub samples: usize,
    /// How far it has come.
    pub state: TrainingState,
}

impl<'a> Trainer<'a> {
    /// The training as it stands.
    pub fn checkpoint(&self) -> Checkpoint {
        let named = |prefix: &str, network: &Network| {
            let tensors = network.tensors().into_iter();
            let renamed = tensors.map(|tensor| NamedTensor {
                name: format!("{prefix}.{}", tensor.name),
                ..tensor
            });
            renamed.collect::<Vec<_>>()
        };
        let mut tensors = named("now", &self.network);
        if let Some(best) = &self.best {
            tensors.extend(named("best", best));
        }
        for (slot, moments) in self.memory.moments.iter().enumerate() {
            for (which, values) in moments.iter().enumerate() {
                tensors.push(NamedTensor {
                    name: format!("moment.{slot}.{which}"),
                    shape: vec![values.len()],
                    values: values.to_vec(),
                });
            }
        }
        tensors.sort_by(|a, b| a.name.cmp(&b.name));
        Checkpoint {
            summary: self.summary(),
            tensors,
        }
    }

    fn summary(&self) -> Summary {
        Summary {
            architecture: self.network.architecture().clone(),
            recipe: self.recipe.clone(),
            samples: self.training.count(self.network.architecture()),
            state: self.state.clone(),
        }
    }

    /// The training that `checkpoint` was put aside from, with the same samples.
    ///
    /// # Errors
    /// [`NetworkError::Checkpoint`] if the samples are others in number, or a tensor of the optimiser does not fit; otherwise as
    /// [`new`](Trainer::new) and [`Network::from_tensors`].
    pub fn resume(
        checkpoint: Checkpoint,
        training: Samples<'a>,
        validation: Option<Samples<'a>>,
    ) -> Result<Trainer<'a>, NetworkError> {
        let Checkpoint { summary, tensors } = checkpoint;
        let refuse = |what: String| Err(NetworkError::Checkpoint { what });
        let mut parts: BTreeMap<String, Vec<NamedTensor>> = BTreeMap::new();
        for tensor in tensors {
            match tensor.name.split_once('.') {
                Some((part @ ("now" | "best" | "moment"), name)) => {
                    let tensor = NamedTensor {
                        name: name.to_owned(),
                        ..tensor.clone()
                    };
                    parts.entry(part.to_owned()).or_default().push(tensor);
                }
                _ => return Err(NetworkError::UnexpectedTensor { name: tensor.name }),
            }
        }
        let mut network = |part: &str| {
            let tensors = parts.remove(part);
            tensors.map(|tensors| Network::from_tensors(&summary.architecture, tensors))
        };
        let Some(now) = network("now") else {
            return refuse("no tensor begins with `now.`".into());
        };
        let best = network("best").transpose()?;
        let mut trainer = Trainer::of(now?, &summary.recipe, training, validation)?;
        let samples = trainer.summary().samples;
        if samples != summary.samples {
            return refuse(format!(
                "{} samples, now there are {samples}",
                summary.samples
            ));
        }
        if summary.state.best.is_some() != best.is_some() {
            return refuse("the best epoch is named without its tensors, or the reverse".into());
        }
        trainer.best = best;
        trainer.restore(parts.remove("moment").unwrap_or_default())?;
        trainer.state = summary.state;
        if !trainer.is_finished() {
            // The order within the epoch is made anew from its number.
            let epoch = trainer.state.step / trainer.steps_per_epoch();
            trainer.order = trainer.draws(super::ORDER).of(epoch).order(samples);
        }
        Ok(trainer)
    }

    /// Takes back what the optimiser remembered.
    fn restore(&mut self, tensors: Vec<NamedTensor>) -> Result<(), NetworkError> {
        let lengths = self.network.slot_lengths();
        let moments = self.recipe.optimizer.moments();
        let mut found: BTreeMap<String, Vec<f32>> = tensors
            .into_iter()
            .map(|tensor| (tensor.name, tensor.values))
            .collect();
        if found.is_empty() {
            return Ok(());
        }
        for (slot, length) in lengths.into_iter().enumerate() {
            for which in 0..moments {
                let name = format!("{slot}.{which}");
                match found.remove(&name) {
                    Some(values) if values.len() == length => {
                        self.memory.moments[slot].push(Aligned::of(&values));
                    }
                    _ => {
                        let what =
                            format!("`moment.{name}` is missing or does not have {length} numbers");
                        return Err(NetworkError::Checkpoint { what });
                    }
                }
            }
        }
        match found.into_keys().next() {
            None => Ok(()),
            Some(name) => Err(NetworkError::UnexpectedTensor {
                name: format!("moment.{name}"),
            }),
        }
    }
}
