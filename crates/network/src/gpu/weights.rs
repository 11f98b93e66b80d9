//! Upload and download of weights. On a device, a network consists of two long vectors: trained values and running moments. The number of GPU kernels of an
//! optimiser step therefore does not depend on the number of layers.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::{Architecture, NamedTensor, Network, NetworkError};
use burn_tensor::backend::Backend;
use burn_tensor::{Tensor, TensorData};

/// Offsets of each tensor of a network in the two weight vectors.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub(crate) learnt: Vec<Slice>,
    pub(crate) running: Vec<Slice>,
}

/// Location of a tensor in its vector.
#[derive(Clone, Debug)]
pub(crate) struct Slice {
    pub(crate) name: String,
    pub(crate) shape: Vec<usize>,
    pub(crate) range: Range<usize>,
}

/// Trained values and running moments.
#[derive(Clone, Debug)]
pub(crate) struct Weights<B: Backend> {
    pub(crate) learnt: Tensor<B, 1>,
    pub(crate) running: Tensor<B, 1>,
}

impl Layout {
    /// Layout of `tensors`, which must be the complete list of a network's tensors.
    pub(crate) fn of(tensors: &[NamedTensor]) -> Layout {
        let (mut learnt, mut running) = (Vec::new(), Vec::new());
        for tensor in tensors {
            let slices = if tensor.is_learnt() {
                &mut learnt
            } else {
                &mut running
            };
            let start = slices.last().map_or(0, |last: &Slice| last.range.end);
            slices.push(Slice {
                name: tensor.name.clone(),
                shape: tensor.shape.clone(),
                range: start..start + tensor.values.len(),
            });
        }
        Layout { learnt, running }
    }

    /// Index of each tensor among the tensors of its vector, by name.
    pub(crate) fn positions(&self) -> BTreeMap<&str, usize> {
        let kinds = [&self.learnt, &self.running];
        kinds
            .into_iter()
            .flat_map(|slices| slices.iter().enumerate())
            .map(|(position, slice)| (slice.name.as_str(), position))
            .collect()
    }
}

impl Slice {
    /// Values of this tensor in `vector`.
    pub(crate) fn of<B: Backend>(&self, vector: &Tensor<B, 1>) -> Tensor<B, 1> {
        vector.clone().slice([self.range.clone()])
    }

    fn named(&self, vector: &[f32]) -> NamedTensor {
        NamedTensor {
            name: self.name.clone(),
            shape: self.shape.clone(),
            values: vector[self.range.clone()].to_vec(),
        }
    }
}

impl<B: Backend> Weights<B> {
    /// Uploads the tensors of a network.
    pub(crate) fn upload(tensors: &[NamedTensor], device: &B::Device) -> Weights<B> {
        let (learnt, running): (Vec<&NamedTensor>, Vec<_>) =
            tensors.iter().partition(|tensor| tensor.is_learnt());
        Weights {
            learnt: upload(learnt, device),
            running: upload(running, device),
        }
    }

    /// Downloads the network with these weights.
    pub(crate) fn download(
        &self,
        layout: &Layout,
        architecture: &Architecture,
    ) -> Result<Network, NetworkError> {
        let learnt = named(&layout.learnt, &self.learnt);
        let running = named(&layout.running, &self.running);
        Network::from_tensors(architecture, learnt.into_iter().chain(running))
    }
}

/// Uploads the values of `tensors`, concatenated.
pub(crate) fn upload<'a, B: Backend>(
    tensors: impl IntoIterator<Item = &'a NamedTensor>,
    device: &B::Device,
) -> Tensor<B, 1> {
    let tensors = tensors.into_iter();
    vector(
        tensors
            .flat_map(|tensor| tensor.values.iter().copied())
            .collect(),
        device,
    )
}

/// Uploads `values`.
pub(crate) fn vector<B: Backend>(values: Vec<f32>, device: &B::Device) -> Tensor<B, 1> {
    let count = values.len();
    Tensor::from_data(TensorData::new(values, [count]), device)
}

/// Downloads the tensors of `vector`.
pub(crate) fn named<B: Backend>(slices: &[Slice], vector: &Tensor<B, 1>) -> Vec<NamedTensor> {
    let values = numbers(vector.clone());
    slices.iter().map(|slice| slice.named(&values)).collect()
}

/// Downloads the values of `tensor`. Waits until the device has computed them.
pub(crate) fn numbers<B: Backend, const D: usize>(tensor: Tensor<B, D>) -> Vec<f32> {
    tensor.into_data().iter::<f32>().collect()
}
