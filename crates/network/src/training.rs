//! Training in single steps. Between any two steps, a caller can inspect, save or stop the training.

mod augmentation;
mod breakage;
mod checkpoint;
mod engine;
mod label_scale;
mod processor;
mod recipe;
mod state;

pub use augmentation::{Augmentation, Jitter};
pub use breakage::Breakage;
pub use checkpoint::{Checkpoint, Summary};
pub use engine::{Batch, Engine, Moments, Snapshot};
pub use label_scale::{LabelScale, LabelScaling};
pub use recipe::Recipe;
pub use state::{Epoch, Step, Trained, TrainingState};

use processor::Processor;
use rayon::prelude::*;

use crate::architecture::Architecture;
use crate::convolution::ConvolutionForm;
use crate::error::{NetworkError, SampleSet};
use crate::labels::Labels;
use crate::network::Network;
use crate::samples::Samples;
use taceva_core::random::Draws;

/// A training in progress.
///
/// Random numbers depend only on the recipe's seed, the epoch and the sample. An interrupted and resumed training therefore ends with the same bits as an
/// uninterrupted training, for any number of threads. On a GPU, the random numbers are the same, but sums may differ.
#[derive(Debug)]
pub struct Trainer<'a> {
    architecture: Architecture,
    engine: Box<dyn Engine>,
    recipe: Recipe,
    training: Samples<'a>,
    validation: Option<Samples<'a>>,
    scale: LabelScale,
    state: TrainingState,
    /// Network after the epoch with the lowest validation loss; `None` before such an epoch.
    best: Option<Network>,
    /// Order of the samples in the current epoch. Empty before the first step.
    order: Vec<usize>,
    /// Algorithm of convolutions on the CPU.
    form: ConvolutionForm,
}

/// Purposes of random numbers: order of the samples, and augmentation of the pictures.
const ORDER: u64 = 1;
const AUGMENTATION: u64 = 2;

impl<'a> Trainer<'a> {
    /// Starts the training of a network of `architecture` from random weights.
    ///
    /// # Errors
    /// [`NetworkError`] if the architecture, the recipe or the samples are invalid or do not match, or if memory is insufficient.
    pub fn new(
        architecture: &Architecture,
        recipe: &Recipe,
        training: Samples<'a>,
        validation: Option<Samples<'a>>,
    ) -> Result<Trainer<'a>, NetworkError> {
        let network = Network::new(architecture, recipe.seed)?;
        Trainer::of(network, recipe, training, validation)
    }

    /// Starts a training from the weights of `network`.
    ///
    /// # Errors
    /// As [`new`](Trainer::new).
    pub fn of(
        network: Network,
        recipe: &Recipe,
        training: Samples<'a>,
        validation: Option<Samples<'a>>,
    ) -> Result<Trainer<'a>, NetworkError> {
        let moments = Moments::new();
        let snapshot = Snapshot { network, moments };
        let form = Trainer::CONVOLUTIONS;
        Trainer::from_snapshot(&snapshot, form, recipe, training, validation)
    }

    fn from_snapshot(
        snapshot: &Snapshot,
        form: ConvolutionForm,
        recipe: &Recipe,
        training: Samples<'a>,
        validation: Option<Samples<'a>>,
    ) -> Result<Trainer<'a>, NetworkError> {
        recipe.check()?;
        let architecture = snapshot.network.architecture();
        recipe.check_weights(architecture.outputs)?;
        training.check(SampleSet::Training, architecture, recipe.loss)?;
        if let Some(validation) = &validation {
            validation.check(SampleSet::Validation, architecture, recipe.loss)?;
        }
        let samples = training.count(architecture);
        if samples < recipe.batch {
            return Err(NetworkError::FewSamples {
                samples,
                batch: recipe.batch,
            });
        }
        recipe.augmentation.check(architecture)?;
        let scale = match training.labels {
            Labels::Classes(_) => LabelScale::identity(architecture.outputs),
            Labels::Values(labels) => LabelScale::of(recipe.scaling, labels, architecture.outputs)?,
        };
        Ok(Trainer {
            engine: Box::new(Processor::new(snapshot, recipe, form)?),
            architecture: architecture.clone(),
            state: TrainingState::default(),
            best: None,
            order: Vec::new(),
            recipe: recipe.clone(),
            training,
            validation,
            scale,
            form,
        })
    }

    /// Continues this training on the CPU, with the convolution algorithm `form`. The last digits of results depend on the algorithm. A checkpoint
    /// stores the algorithm.
    ///
    /// # Errors
    /// Errors of the previous engine; [`NetworkError::Memory`].
    pub fn in_form(self, form: ConvolutionForm) -> Result<Trainer<'a>, NetworkError> {
        let trainer =
            self.on(|snapshot, recipe| Ok(Box::new(Processor::new(snapshot, recipe, form)?)))?;
        Ok(Trainer { form, ..trainer })
    }

    /// Continues this training on the engine that `begin` creates. The previous engine is dropped first, to free its memory.
    ///
    /// # Errors
    /// Errors of `begin` and of the previous engine.
    pub fn on(
        self,
        begin: impl FnOnce(&Snapshot, &Recipe) -> Result<Box<dyn Engine>, NetworkError>,
    ) -> Result<Trainer<'a>, NetworkError> {
        let snapshot = self.snapshot()?;
        drop(self.engine);
        Ok(Trainer {
            engine: begin(&snapshot, &self.recipe)?,
            ..self
        })
    }

    /// Present network and optimiser state. After a number that was not finite, returns the best network, if any, without optimiser state, because later values
    /// may not be finite.
    fn snapshot(&self) -> Result<Snapshot, NetworkError> {
        match (&self.best, self.state.broken) {
            (Some(best), Some(_)) => Ok(Snapshot {
                network: best.clone(),
                moments: Moments::new(),
            }),
            _ => Ok(Snapshot {
                network: self.engine.network()?,
                moments: self.engine.moments()?,
            }),
        }
    }

    /// Progress and losses.
    pub fn state(&self) -> &TrainingState {
        &self.state
    }

    /// Number of steps per epoch, which is the number of whole batches. The samples that fill no batch differ between epochs.
    pub fn steps_per_epoch(&self) -> u64 {
        (self.training.count(&self.architecture) / self.recipe.batch) as u64
    }

    /// Number of steps of the whole training, unless it stops early.
    pub fn steps(&self) -> u64 {
        self.steps_per_epoch() * self.recipe.epochs
    }

    /// True if all steps are done, or if the training stopped early.
    pub fn is_finished(&self) -> bool {
        self.state.is_stopped || self.state.step >= self.steps()
    }

    /// Runs the next step; `None` if the training is finished.
    ///
    /// # Errors
    /// [`NetworkError::LossNotFinite`] or [`NetworkError::WeightNotFinite`] with the step. Every further call returns the same error.
    /// [`finish`](Trainer::finish) and checkpoints still contain the network of the best epoch, if any. Otherwise errors of the [`Engine`].
    pub fn step(&mut self) -> Result<Option<Step>, NetworkError> {
        if let Some(breakage) = self.state.broken {
            return Err(breakage.into());
        }
        let made = self.next_step();
        self.state.broken = made.as_ref().err().and_then(Breakage::of);
        made
    }

    fn next_step(&mut self) -> Result<Option<Step>, NetworkError> {
        if self.is_finished() {
            return Ok(None);
        }
        let (step, batch) = (self.state.step, self.recipe.batch);
        let (epoch, position) = (step / self.steps_per_epoch(), step % self.steps_per_epoch());
        if self.order.is_empty() || position == 0 {
            let samples = self.training.count(&self.architecture);
            self.order = self.draws(ORDER).of(epoch).order(samples);
        }
        let first = usize::try_from(position).expect("below the number of samples") * batch;
        let chosen = self.order[first..first + batch].to_vec();
        let (pictures, labels, classes) = self.batch_of(epoch, &chosen);
        let batch = Batch {
            pictures: &pictures,
            labels: match self.training.labels {
                Labels::Values(_) => Labels::Values(&labels),
                Labels::Classes(_) => Labels::Classes(&classes),
            },
            step,
            rate: self.recipe.rate * self.recipe.schedule.factor(step, self.steps()),
        };
        let loss = self.engine.step(&batch)?;
        self.state.step += 1;
        self.state.loss_sum += loss;
        let is_last = position + 1 == self.steps_per_epoch();
        let epoch = if is_last {
            Some(self.end_epoch()?)
        } else {
            None
        };
        Ok(Some(Step { step, loss, epoch }))
    }

    /// Runs all remaining steps.
    ///
    /// # Errors
    /// Errors of [`step`](Trainer::step).
    pub fn run(mut self) -> Result<Trained, NetworkError> {
        while self.step()?.is_some() {}
        self.finish()
    }

    /// Ends the training and returns its result.
    ///
    /// # Errors
    /// Errors of [`Engine::network`]; none on the CPU.
    pub fn finish(self) -> Result<Trained, NetworkError> {
        let network = match self.best {
            Some(best) => best,
            None => self.engine.network()?,
        };
        Ok(Trained {
            network,
            scale: self.scale,
            state: self.state,
        })
    }

    /// Random generator for the purpose `purpose`.
    fn draws(&self, purpose: u64) -> Draws {
        // Weights use draws of the seed by slot. Purposes use numbers above all slots.
        Draws::new(self.recipe.seed).of(u64::MAX - purpose)
    }

    /// Augmented pictures of a batch, with scaled labels or classes.
    fn batch_of(&self, epoch: u64, chosen: &[usize]) -> (Vec<Vec<f32>>, Vec<f64>, Vec<u32>) {
        let (picture, outputs) = (self.architecture.input, self.architecture.outputs);
        let draws = self.draws(AUGMENTATION).of(epoch);
        let augmentation = &self.recipe.augmentation;
        let pictures = self.training.pictures;
        let (changed, shifts): (Vec<_>, Vec<_>) = chosen
            .par_iter()
            .map(|&sample| {
                let values = &pictures[sample * picture.len()..][..picture.len()];
                augmentation.apply(draws.of(sample as u64), picture, values)
            })
            .unzip();
        let (mut labels, mut classes) = (Vec::new(), Vec::new());
        for (&sample, shift) in chosen.iter().zip(shifts) {
            match self.training.labels {
                Labels::Classes(all) => classes.push(all[sample]),
                Labels::Values(all) => {
                    let own = &all[sample * outputs..][..outputs];
                    labels.extend(own.iter().enumerate().map(|(output, label)| {
                        let moved = label + augmentation.moved(shift, output);
                        self.scale.scaled(output, moved)
                    }));
                }
            }
        }
        (changed, labels, classes)
    }

    /// Ends an epoch: computes losses, stores the best network, and stops the training if the patience is exhausted.
    fn end_epoch(&mut self) -> Result<Epoch, NetworkError> {
        let epoch = Epoch {
            training_loss: self.state.loss_sum / self.steps_per_epoch() as f64,
            validation_loss: self.validation_loss()?,
        };
        self.state.loss_sum = 0.0;
        let number = self.state.epochs.len() as u64;
        self.state.epochs.push(epoch);
        if let Some(loss) = epoch.validation_loss {
            let least = self.state.best.and_then(|best| {
                let best = usize::try_from(best).ok()?;
                self.state.epochs[best].validation_loss
            });
            if least.is_none_or(|least| loss < least) {
                self.best = Some(self.engine.network()?);
                self.state.best = Some(number);
            }
            let since = number - self.state.best.unwrap_or(number);
            self.state.is_stopped = self.recipe.patience.is_some_and(|most| since >= most);
        }
        Ok(epoch)
    }

    /// Loss of the validation part, computed with running moments; `None` without a validation part.
    fn validation_loss(&mut self) -> Result<Option<f64>, NetworkError> {
        let Some(validation) = &self.validation else {
            return Ok(None);
        };
        let width = self.architecture.outputs;
        let samples = validation.count(&self.architecture);
        let mut outputs = vec![0.0; samples * width];
        self.engine.predict(validation.pictures, &mut outputs)?;
        let labels = match validation.labels {
            Labels::Classes(_) => Vec::new(),
            Labels::Values(labels) => self.scale.all_scaled(labels),
        };
        let truth = match validation.labels {
            Labels::Classes(classes) => Labels::Classes(classes),
            Labels::Values(_) => Labels::Values(&labels),
        };
        let loss = self.recipe.measure(&outputs, width, truth, &mut Vec::new());
        if loss.is_finite() {
            Ok(Some(loss))
        } else {
            Err(NetworkError::LossNotFinite {
                step: self.state.step,
            })
        }
    }
}
