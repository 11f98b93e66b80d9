//! Networks that predict the spacing of gratings from pictures.

use taceva_core::{FeatureShape, Features, ModelError, Nanometre, Progress};
use taceva_network::Gpu;
use taceva_network::{LabelScale, Labels, Loss, Network, Recipe, Samples, Trained};

use super::calibration::greatest;
use super::estimator::NetworkEstimator;
use super::training::{Training, no_gpu, refused};
use crate::features::Preprocessing;
use crate::linalg::invalid;

/// Form in which a network predicts the spacing of a grating in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpacingOutput {
    /// One class per grating spacing in the training pictures. Training uses cross entropy. The network predicts one of these spacings.
    Classes,
    /// One number: the grating spacing as a length. Training uses Huber's loss. Predictions may lie between the spacings of the training pictures.
    Length,
}

/// Fitted network that predicts the spacing of a grating.
#[derive(Debug)]
pub struct SpacingNetwork {
    shape: FeatureShape,
    preprocessing: Preprocessing,
    /// Trained network, and the scale that converts its output to a length. `None` if all training pictures have the same spacing.
    network: Option<(Network, LabelScale)>,
    output: SpacingOutput,
    /// Distinct spacings of the training pictures, ascending.
    known: Vec<Nanometre>,
}

impl NetworkEstimator {
    /// Trains a network that predicts the grating spacing in a picture. The settings of this estimator apply.
    ///
    /// # Shapes
    /// `spacings`: `[samples]`, one per picture.
    /// # Errors
    /// [`ModelError`] without pictures, or if the number of spacings differs from the number of pictures. Otherwise as
    /// [`Estimator::fit`](taceva_core::Estimator::fit).
    pub fn fit_spacings(
        &self,
        pictures: &Features,
        spacings: &[Nanometre],
        output: SpacingOutput,
        progress: &dyn Progress,
    ) -> Result<SpacingNetwork, ModelError> {
        let shape = pictures.shape();
        if spacings.is_empty() || pictures.samples() != spacings.len() {
            return Err(invalid(format!(
                "{} pictures of gratings and {} spacings, expected equal numbers, at least one",
                pictures.samples(),
                spacings.len()
            )));
        }
        let mut known = spacings.to_vec();
        known.sort_unstable();
        known.dedup();
        let outputs = match output {
            SpacingOutput::Classes => known.len(),
            SpacingOutput::Length => 1,
        };
        let learnt = Learnt::new(spacings, &known);
        let labels = match output {
            SpacingOutput::Classes => Labels::Classes(&learnt.classes),
            SpacingOutput::Length => Labels::Values(&learnt.lengths),
        };
        let (recipe, preprocessing) = self.recipe(shape);
        let values = preprocessing.apply(shape, pictures.values());
        let gpu = self.gpu.map(Gpu::find).transpose().map_err(no_gpu)?;
        let network = if known.len() > 1 {
            let training = Training {
                architecture: &self.architecture(shape, outputs),
                recipe: &recipe_of(recipe, output, spacings.len()),
                samples: Samples {
                    pictures: &values,
                    labels,
                },
                validation: None,
                gpu: gpu.as_ref(),
                checkpoints: self.checkpoints.as_ref(),
            };
            let Trained { network, scale, .. } = training.run(progress)?;
            Some((network, scale))
        } else {
            None
        };
        Ok(SpacingNetwork {
            shape,
            preprocessing,
            network,
            output,
            known,
        })
    }
}

/// Training settings `recipe`, changed for this form of `output`. A batch has at most `samples` samples.
fn recipe_of(recipe: Recipe, output: SpacingOutput, samples: usize) -> Recipe {
    Recipe {
        batch: recipe.batch.min(samples),
        loss: match output {
            SpacingOutput::Classes => Loss::CrossEntropy,
            SpacingOutput::Length => recipe.loss,
        },
        ..recipe
    }
}

/// Spacings of the training pictures as labels: class numbers, and lengths in mm.
struct Learnt {
    classes: Vec<u32>,
    lengths: Vec<f64>,
}

impl Learnt {
    fn new(spacings: &[Nanometre], known: &[Nanometre]) -> Learnt {
        let class = |spacing: &Nanometre| known.partition_point(|other| other < spacing);
        let classes = spacings.iter().map(class);
        Learnt {
            classes: classes
                .map(|class| u32::try_from(class).expect("fewer classes than pictures in memory"))
                .collect(),
            lengths: spacings
                .iter()
                .map(|spacing| spacing.to_millimetres())
                .collect(),
        }
    }
}

impl SpacingNetwork {
    /// Predicts the spacing of the grating in each of `pictures`.
    ///
    /// # Errors
    /// [`ModelError`] if the shape of the pictures differs, or a prediction is not a valid length.
    pub fn predict(&self, pictures: &Features) -> Result<Vec<Nanometre>, ModelError> {
        if pictures.shape() != self.shape {
            return Err(invalid(format!(
                "pictures of {} features, expected {} as in the fit",
                pictures.shape().len(),
                self.shape.len()
            )));
        }
        let Some((network, scale)) = &self.network else {
            return Ok(vec![self.known[0]; pictures.samples()]);
        };
        let width = network.architecture().outputs;
        let values = self
            .preprocessing
            .apply(pictures.shape(), pictures.values());
        let mut outputs = vec![0.0; pictures.samples() * width];
        let predicted = network.predictor().predict(&values, &mut outputs);
        predicted.map_err(refused)?;
        let found = outputs
            .chunks_exact(width)
            .map(|outputs| match self.output {
                SpacingOutput::Classes => Some(self.known[greatest(outputs)]),
                SpacingOutput::Length => Nanometre::from_millimetres(scale.unscaled(0, outputs[0])),
            });
        found
            .collect::<Option<_>>()
            .ok_or_else(|| invalid("a predicted spacing is not a length"))
    }
}
