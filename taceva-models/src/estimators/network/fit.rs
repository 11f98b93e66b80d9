//! Fitting of networks that predict numbers.

use taceva_core::{ModelError, Progress, SignalInfo, TrainingSet};
use taceva_network::Gpu;
use taceva_network::{Isa, LabelScale, Labels, Network, Samples, Trained};

use super::NO_PICTURE;
use super::training::{Training, no_gpu, refused};
use super::{NetworkEstimator, NetworkRegressor};
use crate::features::FeatureError;
use crate::linalg::invalid;
use crate::training::card::NetworkCard;
use crate::training::checkpoint::Checkpoints;
use crate::training::choice::{ChannelChoice, Choice, ChosenBy, errors};
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::problem::Problem;
use crate::training::regressor::ModelRegressor;

/// Labels of the channels with the indices in `varying`. The labels of one sample are adjacent.
fn labels_of(set: &TrainingSet<'_>, varying: &[usize]) -> Vec<f64> {
    let rows = set.targets.values.chunks_exact(set.targets.channels.len());
    rows.flat_map(|row| varying.iter().map(|&channel| row[channel]))
        .collect()
}

impl ModelEstimator for NetworkEstimator {
    fn of_signals(
        &self,
        info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        Ok(Some(Box::new(self.for_signals(info)?)))
    }

    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        if self.classes.is_some() {
            return self.fit_classes(training, validation, progress);
        }
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let validation = validation.filter(|_| held.is_some());
        let shape = training.features.shape();
        if shape.height == 1 && shape.depth == 1 {
            return Err(invalid(NO_PICTURE));
        }
        // Finds the GPU before computing anything.
        let gpu = self.gpu.map(Gpu::find).transpose().map_err(no_gpu)?;
        let channels = training.targets.channels;
        let is_constant = |channel: &usize| problem.scaling.is_constant(*channel);
        let varying: Vec<usize> = (0..channels.len())
            .filter(|channel| !is_constant(channel))
            .collect();
        let architecture = self.architecture(shape, varying.len().max(1));
        let (recipe, preprocessing) = self.recipe(shape);

        let prepare = |set: &TrainingSet<'_>| {
            let pictures = preprocessing.apply(shape, set.features.values());
            (pictures, labels_of(set, &varying))
        };
        let learnt = prepare(training);
        let kept = validation.map(prepare);
        let trained = if varying.is_empty() {
            None
        } else {
            let of = |pictures, labels| Samples {
                pictures,
                labels: Labels::Values(labels),
            };
            let kept = kept.as_ref().map(|(pictures, labels)| of(pictures, labels));
            let training = Training {
                architecture: &architecture,
                recipe: &recipe,
                samples: of(&learnt.0, &learnt.1),
                validation: kept,
                gpu: gpu.as_ref(),
                checkpoints: self.checkpoints.as_ref(),
            };
            Some(training.run(progress)?)
        };
        let constant = (0..channels.len()).map(|channel| {
            let label = problem.scaling.minimum()[channel];
            problem.scaling.is_constant(channel).then_some(label)
        });
        let (network, scale, best) = match trained {
            Some(Trained {
                network,
                scale,
                state,
            }) => (network, scale, state.best),
            // All labels are constant: no training.
            None => {
                let network = Network::new(&architecture, recipe.seed).map_err(refused)?;
                (network, LabelScale::identity(1), None)
            }
        };
        let card = NetworkCard {
            architecture,
            preprocessing,
            scale,
            constant: constant.collect(),
            convolutions: self.convolutions,
            instructions: Isa::detect().name().to_owned(),
            gpu: gpu
                .filter(|_| !varying.is_empty())
                .map(|gpu| gpu.to_string()),
            classes: None,
        };
        let regressor = NetworkRegressor::new(channels.clone(), card, network)?;
        let errors = match validation {
            Some(set) => errors(&regressor, set)?,
            None => vec![None; channels.len()],
        };
        let by = if best.is_some() {
            ChosenBy::Validation
        } else {
            ChosenBy::Nobody
        };
        let choices = errors.into_iter().map(|rmse| ChannelChoice {
            value: best.map(|epoch| epoch as f64),
            rmse,
            at_edge: false,
        });
        Ok(ModelFit {
            choice: Choice {
                by,
                setting: best.map(|_| "epoch".to_owned()),
                channels: choices.collect(),
            },
            regressor: ModelRegressor::new(regressor),
            scaling: problem.scaling,
            refitted: false,
        })
    }

    fn first_look(&self, share: f64) -> Option<Box<dyn ModelEstimator>> {
        Some(Box::new(self.shortened(share)))
    }

    fn keep_checkpoints(&mut self, checkpoints: Checkpoints) {
        self.checkpoints = Some(checkpoints);
    }
}

estimator!(NetworkEstimator, |own| own.info().name);
