//! Checkpoints: the state of a training after a step, from which it can be resumed.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Moments, Recipe, Snapshot, Trainer, TrainingState};
use crate::architecture::Architecture;
use crate::convolution::ConvolutionForm;
use crate::error::NetworkError;
use crate::network::{NamedTensor, Network};
use crate::samples::Samples;

/// State of a training after a step. A resumed training ends with the same bits as an uninterrupted training.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// Settings and progress, for a short text file.
    pub summary: Summary,
    /// Tensors by prefix: present weights `now.`, weights of the best epoch `best.`, and optimiser state of each parameter `moment.0.` and `moment.1.`.
    pub tensors: Vec<NamedTensor>,
}

/// Settings and progress of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Architecture of the network.
    pub architecture: Architecture,
    /// Training settings.
    pub recipe: Recipe,
    /// Number of training samples.
    pub samples: usize,
    /// Algorithm of convolutions on the CPU. The algorithm affects the last digits of results.
    pub convolutions: ConvolutionForm,
    /// Progress and losses.
    pub state: TrainingState,
}

impl<'a> Trainer<'a> {
    /// Algorithm of convolutions for training on the CPU, unless [`in_form`](Trainer::in_form) selects another.
    pub const CONVOLUTIONS: ConvolutionForm = ConvolutionForm::Winograd;

    /// Returns a checkpoint of the training after the last step.
    ///
    /// # Errors
    /// Errors of [`Engine::network`](super::Engine::network) and [`moments`](super::Engine::moments); none on the CPU.
    pub fn checkpoint(&self) -> Result<Checkpoint, NetworkError> {
        let named = |prefix: String, tensors: Vec<NamedTensor>| {
            tensors.into_iter().map(move |tensor| NamedTensor {
                name: format!("{prefix}.{}", tensor.name),
                ..tensor
            })
        };
        let Snapshot { network, moments } = self.snapshot()?;
        let mut tensors: Vec<NamedTensor> = named("now".into(), network.tensors()).collect();
        if let Some(best) = &self.best {
            tensors.extend(named("best".into(), best.tensors()));
        }
        for (which, moments) in moments.into_iter().enumerate() {
            tensors.extend(named(format!("moment.{which}"), moments));
        }
        tensors.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(Checkpoint {
            summary: self.summary(),
            tensors,
        })
    }

    fn summary(&self) -> Summary {
        Summary {
            architecture: self.architecture.clone(),
            recipe: self.recipe.clone(),
            samples: self.training.count(&self.architecture),
            convolutions: self.form,
            state: self.state.clone(),
        }
    }

    /// Resumes the training of `checkpoint`, with the same samples and the algorithm in the checkpoint.
    ///
    /// # Errors
    /// [`NetworkError::Checkpoint`] if the number of samples differs, if the present or the best network is missing, or if a tensor of the optimiser
    /// does not match. Otherwise errors of [`new`](Trainer::new) and [`Network::from_tensors`].
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
            return refuse("no tensor has the prefix `now.`".into());
        };
        let best = network("best").transpose()?;
        let (network, recipe) = (now?, &summary.recipe);
        let moments = moments_of(&network, recipe, parts.remove("moment").unwrap_or_default());
        let snapshot = Snapshot {
            moments: moments?,
            network,
        };
        let form = summary.convolutions;
        let mut trainer = Trainer::from_snapshot(&snapshot, form, recipe, training, validation)?;
        let samples = trainer.summary().samples;
        if samples != summary.samples {
            return refuse(format!("{} samples, expected {samples}", summary.samples));
        }
        if summary.state.best.is_some() != best.is_some() {
            return refuse(
                "the best epoch and the tensors `best.…` must both be present or both be absent"
                    .into(),
            );
        }
        trainer.best = best;
        trainer.state = summary.state;
        if !trainer.is_finished() {
            // Recomputes the order of the current epoch from its number.
            let epoch = trainer.state.step / trainer.steps_per_epoch();
            trainer.order = trainer.draws(super::ORDER).of(epoch).order(samples);
        }
        Ok(trainer)
    }
}

/// Optimiser state for `recipe` among `tensors`, whose names are `<which>.<parameter of the network>`.
fn moments_of(
    network: &Network,
    recipe: &Recipe,
    tensors: Vec<NamedTensor>,
) -> Result<Moments, NetworkError> {
    if tensors.is_empty() {
        return Ok(Moments::new());
    }
    let mut found: BTreeMap<String, Vec<f32>> = tensors
        .into_iter()
        .map(|tensor| (tensor.name, tensor.values))
        .collect();
    let learnt = network.learnt();
    let mut take = |which: usize, parameter: &NamedTensor| {
        let name = format!("{which}.{}", parameter.name);
        let length = parameter.values.len();
        match found.remove(&name) {
            Some(values) if values.len() == length => Ok(NamedTensor {
                values,
                ..parameter.clone()
            }),
            _ => Err(NetworkError::Checkpoint {
                what: format!("`moment.{name}` is missing or does not have {length} numbers"),
            }),
        }
    };
    let moments = (0..recipe.optimizer.moments())
        .map(|which| learnt.iter().map(|tensor| take(which, tensor)).collect())
        .collect::<Result<Moments, _>>()?;
    match found.into_keys().next() {
        None => Ok(moments),
        Some(name) => Err(NetworkError::UnexpectedTensor {
            name: format!("moment.{name}"),
        }),
    }
}
