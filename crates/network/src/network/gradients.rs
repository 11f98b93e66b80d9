//! Gradients of a batch, by name.

use super::{NamedTensor, Network};
use crate::convolution::{ConvolutionForm, plain};
use crate::error::{NetworkError, SampleSet};
use crate::loss::Loss;
use crate::samples::Samples;
use crate::stage::Stage;
use crate::update::Update;

/// Loss of some samples, and its gradient for each parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradients {
    /// Loss of the samples.
    pub loss: f64,
    /// Gradients with the names of their parameters, sorted by name.
    pub tensors: Vec<NamedTensor>,
}

/// [`Update`] that stores every gradient.
struct Keep(Vec<Vec<f32>>);

impl Update for Keep {
    fn update(&mut self, slot: usize, _values: &mut [f32], gradient: &[f32]) {
        self.0[slot] = gradient.to_vec();
    }
}

impl Network {
    /// Loss and gradients of `samples`, as one batch and with batch moments. Updates the running moments.
    ///
    /// # Errors
    /// [`NetworkError`] if the samples do not match the network or the loss, or if memory is insufficient.
    pub fn gradients(
        &mut self,
        samples: Samples<'_>,
        loss: Loss,
    ) -> Result<Gradients, NetworkError> {
        samples.check(SampleSet::Training, &self.architecture, loss)?;
        let (picture, width) = (self.architecture.input, self.architecture.outputs);
        let batch = samples.pictures.len() / picture.len();
        let mut space = self.training_space(batch, ConvolutionForm::Winograd)?;
        for (position, values) in samples.pictures.chunks_exact(picture.len()).enumerate() {
            space.input.set(position, values);
        }
        let mut gradient = Vec::new();
        let outputs = self.forward(&mut space, batch);
        let loss = loss.measure(outputs, width, samples.labels, &mut gradient);
        let mut kept = Keep(vec![Vec::new(); self.slots()]);
        self.backward(&mut space, &gradient, &mut kept);
        let Keep(kept) = kept;
        Ok(Gradients {
            loss,
            tensors: self.named(kept),
        })
    }

    /// Adds parameter names to `gradients`, which have one vector per slot, or to other values of the same shape.
    pub(crate) fn named(&self, mut gradients: Vec<Vec<f32>>) -> Vec<NamedTensor> {
        let mut values = std::collections::BTreeMap::new();
        for (prefix, stage) in self.architecture.stage_names().iter().zip(&self.stages) {
            for (normed, [convolution, norm]) in Stage::normed(stage) {
                let weights = plain(normed.convolution(), &gradients[normed.slot]);
                values.insert(format!("{prefix}{convolution}.weight"), weights);
                let gain = std::mem::take(&mut gradients[normed.slot + 1]);
                values.insert(format!("{prefix}{norm}.weight"), gain);
                let bias = std::mem::take(&mut gradients[normed.slot + 2]);
                values.insert(format!("{prefix}{norm}.bias"), bias);
            }
        }
        let head = self.head.slot;
        values.insert("fc.weight".into(), std::mem::take(&mut gradients[head]));
        values.insert("fc.bias".into(), std::mem::take(&mut gradients[head + 1]));
        let tensors = self.tensors().into_iter();
        tensors
            .filter_map(|tensor| {
                let values = values.remove(&tensor.name)?;
                Some(NamedTensor { values, ..tensor })
            })
            .collect()
    }
}
