//! Fitting of networks that predict classes: cross entropy loss, and a softmax temperature fitted on the validation part.

use taceva_core::{Features, ModelError, Progress, Regressor, TrainingSet};
use taceva_network::Gpu;
use taceva_network::{Isa, LabelScale, Labels, Loss, Network, Recipe, Samples, Trained};

use super::calibration::temperature;
use super::classifier::{NetworkClassifier, class_channels};
use super::head::ClassWeights;
use super::training::{Training, no_gpu, refused};
use super::{NO_PICTURE, NetworkEstimator, NetworkRegressor};
use crate::estimators::discriminant::VALUES_MAX;
use crate::linalg::invalid;
use crate::training::card::{ClassCard, NetworkCard};
use crate::training::choice::{ChannelChoice, Choice, ChosenBy};
use crate::training::fit::ModelFit;
use crate::training::problem::Problem;
use crate::training::regressor::ModelRegressor;

/// Samples whose label occurs in the training part, with class numbers. Other samples are left out.
struct Known {
    features: Features,
    classes: Vec<u32>,
}

impl Known {
    fn of(set: &TrainingSet<'_>, labels: &[f64]) -> Known {
        let class = |label: &f64| {
            let at = labels.binary_search_by(|known| known.total_cmp(label));
            at.ok().and_then(|at| u32::try_from(at).ok())
        };
        let classes: Vec<Option<u32>> = set.targets.values.iter().map(class).collect();
        let rows = (0..classes.len()).filter(|row| classes[*row].is_some());
        let rows: Vec<usize> = rows.collect();
        Known {
            features: set.features.select(&rows),
            classes: classes.into_iter().flatten().collect(),
        }
    }
}

/// Distinct labels, ascending.
fn levels(labels: &[f64]) -> Vec<f64> {
    let mut levels = labels.to_vec();
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|one, other| one.total_cmp(other).is_eq());
    levels
}

impl NetworkEstimator {
    /// Fits a network with one output for each distinct label of the only channel. The best epoch and the softmax temperature are chosen on the
    /// validation part.
    ///
    /// # Errors
    /// Errors of [`Estimator::fit`](taceva_core::Estimator::fit), and errors for several channels and for too many labels.
    pub(super) fn fit_classes(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let channels = training.targets.channels;
        let labels = levels(training.targets.values);
        if channels.len() != 1 || labels.len() > VALUES_MAX {
            return Err(invalid(format!(
                "head=classes: {} channels with {} labels, expected one channel with at most {VALUES_MAX}: name the channel by --channels",
                channels.len(),
                labels.len()
            )));
        }
        let shape = training.features.shape();
        if shape.height == 1 && shape.depth == 1 {
            return Err(invalid(NO_PICTURE));
        }
        let gpu = self.gpu.map(Gpu::find).transpose().map_err(no_gpu)?;
        let architecture = self.architecture(shape, labels.len());
        let (recipe, preprocessing) = self.recipe(shape);
        let learnt = Known::of(training, &labels);
        let kept = validation.filter(|_| held.is_some());
        let kept = kept.map(|set| Known::of(set, &labels));
        let kept = kept.filter(|kept| !kept.classes.is_empty());
        let weights = self.classes.unwrap_or(ClassWeights::Equal);
        let recipe = Recipe {
            batch: recipe.batch.min(learnt.classes.len()),
            loss: Loss::CrossEntropy,
            class_weights: weights.in_loss(&learnt.classes, labels.len()),
            ..recipe
        };
        let prepared = |known: &Known| preprocessing.apply(shape, known.features.values());
        let (pictures, of_kept) = (prepared(&learnt), kept.as_ref().map(prepared));
        let varies = labels.len() > 1;
        let (network, best) = if varies {
            let kept = kept.as_ref().zip(of_kept.as_deref());
            let run = Training {
                architecture: &architecture,
                recipe: &recipe,
                samples: Samples {
                    pictures: &pictures,
                    labels: Labels::Classes(&learnt.classes),
                },
                validation: kept.map(|(kept, pictures)| Samples {
                    pictures,
                    labels: Labels::Classes(&kept.classes),
                }),
                gpu: gpu.as_ref(),
                checkpoints: self.checkpoints.as_ref(),
            };
            let Trained { network, state, .. } = run.run(progress)?;
            (network, state.best)
        } else {
            let network = Network::new(&architecture, recipe.seed).map_err(refused)?;
            (network, None)
        };
        let card = NetworkCard {
            preprocessing,
            scale: LabelScale::identity(labels.len()),
            constant: vec![None; labels.len()],
            convolutions: self.convolutions,
            instructions: Isa::detect().name().to_owned(),
            gpu: gpu.filter(|_| varies).map(|gpu| gpu.to_string()),
            classes: None,
            architecture,
        };
        let network = NetworkRegressor::new(class_channels(labels.len())?, card, network)?;
        let classes = calibrated(&network, labels, kept.as_ref())?;
        let regressor = NetworkClassifier::new(channels.clone(), network, classes)?;
        Ok(ModelFit {
            choice: Choice {
                by: best.map_or(ChosenBy::Nobody, |_| ChosenBy::Validation),
                setting: best.map(|_| "epoch".to_owned()),
                channels: vec![ChannelChoice {
                    value: best.map(|epoch| epoch as f64),
                    ..ChannelChoice::default()
                }],
            },
            regressor: ModelRegressor::new(regressor),
            scaling: problem.scaling,
            refitted: false,
        })
    }
}

/// Class entry of the model card: `labels`, and a temperature fitted to the validation samples `kept`. Without `kept`, the temperature is 1.
fn calibrated(
    network: &NetworkRegressor,
    labels: Vec<f64>,
    kept: Option<&Known>,
) -> Result<ClassCard, ModelError> {
    let mut card = ClassCard {
        temperature: 1.0,
        calibrated_on: 0,
        labels,
    };
    let width = card.labels.len();
    if let Some(kept) = kept.filter(|_| width > 1) {
        let mut outputs = vec![0.0; kept.classes.len() * width];
        network.predict(&kept.features, &mut outputs)?;
        card.temperature = temperature(&outputs, width, &kept.classes);
        card.calibrated_on = kept.classes.len();
    }
    Ok(card)
}
