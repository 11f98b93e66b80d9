//! Training of a network on a device.

use burn_tensor::Tensor;
use burn_tensor::backend::Backend;

use crate::gpu::guard::guard;
use crate::gpu::passes::Passes;
use crate::gpu::prediction::{Prediction, pictures_on};
use crate::gpu::products::Products;
use crate::gpu::training::{Course, descend};
use crate::gpu::weights::{Layout, Weights, named, upload};
use crate::{Architecture, Batch, Engine, Moments, Network, NetworkError, Recipe, Rule, Snapshot};

/// Engine that trains a network on a device of the backend `B`.
#[derive(Debug)]
struct DeviceEngine<B: Backend> {
    device: B::Device,
    /// Name of the device in errors.
    name: String,
    architecture: Architecture,
    recipe: Recipe,
    layout: Layout,
    passes: Passes<B>,
    weights: Weights<B>,
    /// Folded weights for prediction, computed at the first prediction after a step.
    prediction: Option<Prediction<B>>,
    moments: Vec<Tensor<B, 1>>,
    /// Index of the last step, for the error about infinite or NaN weights.
    last: u64,
    /// Error of a failed step. Every further step returns this error, because the weights may be only partly updated.
    failed: Option<NetworkError>,
}

/// Starts an engine on the first device of `B` that continues from `snapshot`. Errors call the device `name`.
pub(crate) fn begin<B: Products>(
    name: &str,
    snapshot: &Snapshot,
    recipe: &Recipe,
) -> Result<Box<dyn Engine>, NetworkError> {
    let device = &B::Device::default();
    guard(name, || {
        let tensors = snapshot.network.tensors();
        let architecture = snapshot.network.architecture().clone();
        let layout = Layout::of(&tensors);
        let passes = Passes::new(&architecture, &layout, device);
        let engine = DeviceEngine::<B> {
            passes,
            weights: Weights::upload(&tensors, device),
            prediction: None,
            moments: snapshot
                .moments
                .iter()
                .map(|tensors| upload(tensors, device))
                .collect(),
            device: device.clone(),
            name: name.to_owned(),
            architecture,
            recipe: recipe.clone(),
            layout,
            last: 0,
            failed: None,
        };
        Ok(Box::new(engine) as Box<dyn Engine>)
    })
}

impl<B: Products> DeviceEngine<B> {
    fn make_step(&mut self, batch: &Batch<'_>) -> Result<f64, NetworkError> {
        let pictures = pictures_on(
            self.architecture.input,
            batch.pictures.concat(),
            &self.device,
        );
        let course = Course::forward(&self.passes, &self.layout, &self.weights, pictures);
        let (outputs, width) = (course.outputs(), self.architecture.outputs);
        // The loss is computed on the CPU: it has few numbers, and all engines share one formula.
        let mut gradient = Vec::new();
        let loss = self
            .recipe
            .measure(&outputs, width, batch.labels, &mut gradient);
        if !loss.is_finite() {
            return Err(NetworkError::LossNotFinite { step: batch.step });
        }
        let gradient = course.backward(&gradient);
        let running = course.followed(&self.weights.running);
        let rule = Rule::new(self.recipe.optimizer, batch.rate, batch.step + 1);
        self.prediction = None;
        self.weights = Weights {
            learnt: descend(rule, &self.weights.learnt, gradient, &mut self.moments),
            running,
        };
        self.last = batch.step;
        Ok(loss)
    }
}

impl<B: Products> Engine for DeviceEngine<B> {
    fn step(&mut self, batch: &Batch<'_>) -> Result<f64, NetworkError> {
        if let Some(error) = &self.failed {
            return Err(error.clone());
        }
        let name = self.name.clone();
        let made = guard(&name, || self.make_step(batch));
        self.failed = made.as_ref().err().cloned();
        made
    }

    fn predict(&mut self, pictures: &[f32], into: &mut [f64]) -> Result<(), NetworkError> {
        let picture = self.architecture.input;
        picture.check_prediction(pictures, self.architecture.outputs, into)?;
        guard(&self.name, || {
            let (passes, layout, weights) = (&self.passes, &self.layout, &self.weights);
            let prediction = self
                .prediction
                .get_or_insert_with(|| Prediction::new(passes, layout, weights));
            prediction.run(passes, picture, pictures, into, &self.device);
            Ok(())
        })
    }

    fn network(&self) -> Result<Network, NetworkError> {
        let read = || self.weights.download(&self.layout, &self.architecture);
        guard(&self.name, read).map_err(|error| match error {
            NetworkError::TensorNotFinite { .. } => {
                NetworkError::WeightNotFinite { step: self.last }
            }
            other => other,
        })
    }

    fn moments(&self) -> Result<Moments, NetworkError> {
        guard(&self.name, || {
            let moments = self.moments.iter();
            Ok(moments
                .map(|moments| named(&self.layout.learnt, moments))
                .collect())
        })
    }
}
