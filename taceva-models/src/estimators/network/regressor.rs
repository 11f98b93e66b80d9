//! Fitted networks that predict numbers.

use std::sync::Mutex;

use safetensors::tensor::Dtype;
use taceva_core::{Channels, ErrorKind, FeatureShape, Features, ModelError, Regressor};
use taceva_network::{NamedTensor, Network, Picture, Predictor};

use super::NO_PICTURE;
use super::training::refused;
use crate::features::Pca;
use crate::linalg::invalid;
use crate::training::card::KindCard;
use crate::training::card::NetworkCard;
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::limits::FILE_MAX;
use crate::training::file::tensors::{DISTANCE, Raw, Tensors};
use crate::training::output::{check_call, check_finite};
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Fitted network that predicts channels from features.
#[derive(Debug)]
pub struct NetworkRegressor {
    channels: Channels,
    card: NetworkCard,
    network: Network,
    /// Idle predictors with their buffers, kept for reuse. A call of `predict` takes an idle predictor, or builds a new predictor if none is idle.
    spare: Mutex<Vec<Predictor>>,
}

impl NetworkRegressor {
    /// Builds a regressor from a trained network and its model card.
    ///
    /// # Errors
    /// [`ModelError`] if card, network and channels do not match each other.
    pub(crate) fn new(
        channels: Channels,
        card: NetworkCard,
        network: Network,
    ) -> Result<NetworkRegressor, ModelError> {
        let outputs = card.architecture.outputs;
        let varying = card.constant.iter().filter(|label| label.is_none()).count();
        let lengths = [card.scale.offset.len(), card.scale.span.len()];
        // If all labels are constant, the network has one unused output.
        if card.constant.len() != channels.len()
            || varying.max(1) != outputs
            || lengths != [outputs; 2]
            || network.architecture() != &card.architecture
        {
            return Err(invalid(
                "the channels of the card differ from the outputs of the network",
            ));
        }
        let numbers = card.scale.offset.iter().chain(&card.scale.span);
        let mut numbers = numbers
            .copied()
            .chain(card.constant.iter().flatten().copied());
        if !numbers.all(f64::is_finite) || !card.preprocessing.is_valid() {
            return Err(ModelError::new(
                ErrorKind::OutOfRange,
                "the card of the network has a number out of range",
            ));
        }
        Ok(NetworkRegressor {
            channels,
            card,
            network,
            spare: Mutex::new(Vec::new()),
        })
    }

    /// Entry of the model card about the network.
    pub fn card(&self) -> &NetworkCard {
        &self.card
    }

    /// Weights of the network as named tensors. Residual networks use torchvision's tensor names.
    pub fn tensors(&self) -> Vec<NamedTensor> {
        self.network.tensors()
    }

    /// Builds a network that predicts `channels` from its model card and the tensors `found` in a file.
    pub(super) fn of_tensors(
        stored: &Stored<'_>,
        channels: Channels,
        card: &NetworkCard,
        found: Vec<NamedTensor>,
    ) -> Result<NetworkRegressor, FormatError> {
        let shape = stored.shape();
        if card.architecture.input != picture(shape) || stored.card.features.pca.is_some() {
            return Err(FormatError::Card);
        }
        // The card may be wrong: rejects networks larger than any file before allocating them.
        let parameters = card.architecture.parameters()?;
        if parameters as u64 > FILE_MAX / size_of::<f32>() as u64 {
            return Err(FormatError::Card);
        }
        let ready = Network::from_tensors(&card.architecture, found)?;
        Ok(NetworkRegressor::new(channels, card.clone(), ready)?)
    }

    /// Computes the network outputs for preprocessed `pictures`, and writes them to `into`.
    fn outputs(&self, pictures: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        let spare = || {
            self.spare
                .lock()
                .unwrap_or_else(std::sync::PoisonError::into_inner)
        };
        let taken = spare().pop();
        let mut predictor =
            taken.unwrap_or_else(|| self.network.predictor_in(self.card.convolutions));
        let result = predictor.predict(pictures, into);
        spare().push(predictor);
        result.map_err(refused)
    }
}

impl Clone for NetworkRegressor {
    fn clone(&self) -> NetworkRegressor {
        NetworkRegressor {
            channels: self.channels.clone(),
            card: self.card.clone(),
            network: self.network.clone(),
            spare: Mutex::new(Vec::new()),
        }
    }
}

/// Picture in which each cell of `shape` is a pixel, and each value of a cell is a channel.
pub(super) const fn picture(shape: FeatureShape) -> Picture {
    Picture {
        height: shape.height,
        width: shape.width,
        channels: shape.depth,
    }
}

/// Tensors of a network in a file: all tensors except those of the feature distance. Their type must be f32.
pub(super) fn named_tensors(tensors: &Tensors<'_>) -> Result<Vec<NamedTensor>, FormatError> {
    let all = tensors.0.tensors().into_iter();
    let own = all.filter(|(name, _)| !DISTANCE.contains(&name.as_str()));
    let found = own.map(|(name, tensor)| {
        if tensor.dtype() != Dtype::F32 {
            return Err(FormatError::Type {
                name,
                found: format!("{:?}", tensor.dtype()),
            });
        }
        let (numbers, _) = tensor.data().as_chunks::<4>();
        Ok(NamedTensor {
            name,
            shape: tensor.shape().to_vec(),
            values: numbers
                .iter()
                .map(|bytes| f32::from_le_bytes(*bytes))
                .collect(),
        })
    });
    found.collect()
}

impl FittedModel for NetworkRegressor {
    fn kind(&self) -> KindCard {
        KindCard {
            network: Some(self.card.clone()),
            ..KindCard::default()
        }
    }

    fn tensors(&self) -> Vec<Raw> {
        let tensors = self.network.tensors().into_iter();
        tensors
            .map(|tensor| Raw::singles(&tensor.name, tensor.shape, &tensor.values))
            .collect()
    }

    fn reads_features(&self) -> bool {
        self.card.constant.iter().any(Option::is_none)
    }

    fn through(&self, _: &Pca) -> Result<Option<ModelRegressor>, ModelError> {
        Err(invalid(NO_PICTURE))
    }
}

impl Regressor for NetworkRegressor {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        let Picture {
            height,
            width,
            channels,
        } = self.card.architecture.input;
        FeatureShape {
            height,
            width,
            depth: channels,
        }
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(&self.channels, self.shape(), features, into)?;
        let width = self.card.architecture.outputs;
        let mut outputs = vec![0.0; features.samples() * width];
        if self.reads_features() {
            let pictures = self
                .card
                .preprocessing
                .apply(self.shape(), features.values());
            self.outputs(&pictures, &mut outputs)?;
        }
        let samples = into.chunks_exact_mut(self.channels.len());
        for (into, outputs) in samples.zip(outputs.chunks_exact(width)) {
            let mut outputs = outputs.iter().enumerate();
            for (place, constant) in into.iter_mut().zip(&self.card.constant) {
                *place = match constant {
                    Some(label) => *label,
                    None => {
                        let (output, value) =
                            outputs.next().expect("one output per varying channel");
                        self.card.scale.unscaled(output, *value)
                    }
                };
            }
        }
        check_finite(&self.channels, into)
    }
}
