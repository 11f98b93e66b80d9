//! Weights by name, with the names of PyTorch.

use std::collections::BTreeMap;

use super::Network;
use crate::architecture::Architecture;
use crate::error::NetworkError;
use crate::panel::Aligned;
use crate::stage::Stage;

/// A tensor with its name. Residual networks use torchvision's names, such as `layer1.0.conv1.weight`.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedTensor {
    /// Name of the tensor.
    pub name: String,
    /// Dimensions of the tensor; `[outputs, inputs, kernel rows, kernel columns]` for a convolution.
    pub shape: Vec<usize>,
    /// Values of the tensor. The index of the last dimension varies fastest.
    pub values: Vec<f32>,
}

impl NamedTensor {
    /// True for trainable tensors, which are all tensors except running moments.
    pub fn is_learnt(&self) -> bool {
        !self.name.contains(".running_")
    }
}

/// Suffix of PyTorch's batch counters, which this crate does not use.
const COUNTER: &str = ".num_batches_tracked";

impl Network {
    /// All tensors on which predictions depend, sorted by name.
    pub fn tensors(&self) -> Vec<NamedTensor> {
        let mut tensors = Vec::new();
        for (prefix, stage) in self.architecture.stage_names().iter().zip(&self.stages) {
            for (normed, [convolution, norm]) in stage.normed() {
                let shape = normed.convolution();
                let (kernel, channels) = (shape.kernel, shape.outputs);
                tensors.push(NamedTensor {
                    name: format!("{prefix}{convolution}.weight"),
                    shape: vec![channels, shape.inputs, kernel, kernel],
                    values: normed.weights.to_plain(),
                });
                let norms = [
                    ("weight", &normed.norm.gain),
                    ("bias", &normed.norm.bias),
                    ("running_mean", &normed.norm.running_mean),
                    ("running_var", &normed.norm.running_variance),
                ];
                tensors.extend(norms.map(|(name, values)| NamedTensor {
                    name: format!("{prefix}{norm}.{name}"),
                    shape: vec![channels],
                    values: values.to_vec(),
                }));
            }
        }
        let (outputs, features) = (self.head.outputs(), self.head.features());
        tensors.push(NamedTensor {
            name: "fc.weight".into(),
            shape: vec![outputs, features],
            values: self.head.weights.to_vec(),
        });
        tensors.push(NamedTensor {
            name: "fc.bias".into(),
            shape: vec![outputs],
            values: self.head.bias.to_vec(),
        });
        tensors.sort_by(|a, b| a.name.cmp(&b.name));
        tensors
    }

    /// Builds a network from tensors. Ignores PyTorch's batch counters.
    ///
    /// # Errors
    /// [`NetworkError`] if the architecture is invalid, or a tensor is missing, unexpected, of the wrong shape, or not finite.
    pub fn from_tensors(
        architecture: &Architecture,
        tensors: impl IntoIterator<Item = NamedTensor>,
    ) -> Result<Network, NetworkError> {
        let mut network = Network::zeros(architecture)?;
        let mut found: BTreeMap<String, NamedTensor> = tensors
            .into_iter()
            .filter(|tensor| !tensor.name.ends_with(COUNTER))
            .map(|tensor| (tensor.name.clone(), tensor))
            .collect();
        let mut values = Vec::new();
        for expected in network.tensors() {
            let name = expected.name;
            let tensor = found
                .remove(&name)
                .ok_or_else(|| NetworkError::MissingTensor { name: name.clone() })?;
            if tensor.shape != expected.shape || tensor.values.len() != expected.values.len() {
                return Err(NetworkError::TensorShape {
                    name,
                    found: tensor.shape,
                    values: tensor.values.len(),
                    expected: expected.shape,
                });
            }
            if let Some(position) = tensor.values.iter().position(|value| !value.is_finite()) {
                return Err(NetworkError::TensorNotFinite { name, position });
            }
            values.push(tensor);
        }
        if let Some(name) = found.into_keys().next() {
            return Err(NetworkError::UnexpectedTensor { name });
        }
        network.set_tensors(&values);
        Ok(network)
    }

    /// Trainable tensors, sorted by name.
    pub(crate) fn learnt(&self) -> Vec<NamedTensor> {
        let mut tensors = self.tensors();
        tensors.retain(NamedTensor::is_learnt);
        tensors
    }

    /// Values of `learnt` in slot order. Names and shapes must equal the output of [`learnt`](Network::learnt).
    pub(crate) fn slotted(&self, learnt: &[NamedTensor]) -> Vec<Aligned> {
        let mut carrier = self.clone();
        let mut tensors = carrier.tensors();
        tensors.retain(|tensor| !tensor.is_learnt());
        tensors.extend_from_slice(learnt);
        carrier.set_tensors(&tensors);
        let normed = carrier.stages.iter().flat_map(Stage::normed);
        let parts = normed.flat_map(|(part, _)| {
            let weights = Aligned::of(part.weights.values());
            [weights, part.norm.gain.clone(), part.norm.bias.clone()]
        });
        parts
            .chain([carrier.head.weights.clone(), carrier.head.bias.clone()])
            .collect()
    }

    /// Sets all tensors. Names and shapes must equal the output of [`tensors`](Network::tensors).
    fn set_tensors(&mut self, tensors: &[NamedTensor]) {
        let by_name: BTreeMap<&str, &[f32]> = tensors
            .iter()
            .map(|tensor| (tensor.name.as_str(), tensor.values.as_slice()))
            .collect();
        let set = |place: &mut Aligned, name: String| place.copy_from_slice(by_name[name.as_str()]);
        for (prefix, stage) in self.architecture.stage_names().iter().zip(&mut self.stages) {
            let names: Vec<_> = stage.normed().into_iter().map(|(_, names)| names).collect();
            for (normed, [convolution, norm]) in stage.normed_mut().into_iter().zip(names) {
                let name = format!("{prefix}{convolution}.weight");
                normed.weights.set_plain(by_name[name.as_str()]);
                set(&mut normed.norm.gain, format!("{prefix}{norm}.weight"));
                set(&mut normed.norm.bias, format!("{prefix}{norm}.bias"));
                set(
                    &mut normed.norm.running_mean,
                    format!("{prefix}{norm}.running_mean"),
                );
                set(
                    &mut normed.norm.running_variance,
                    format!("{prefix}{norm}.running_var"),
                );
            }
        }
        set(&mut self.head.weights, "fc.weight".into());
        set(&mut self.head.bias, "fc.bias".into());
    }
}
