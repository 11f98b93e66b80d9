//! Fitted networks that predict classes.

use taceva_core::{
    Channel, Channels, ErrorKind, FeatureShape, Features, ModelError, Regressor, Unit,
};

use super::NO_PICTURE;
use super::calibration::{greatest, softmax};
use super::regressor::{NetworkRegressor, named_tensors};
use crate::features::Pca;
use crate::linalg::invalid;
use crate::training::card::{ClassCard, KindCard, NetworkCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::Raw;
use crate::training::output::check_call;
use crate::training::regressor::{ClassProbabilities, FittedModel, ModelRegressor};

/// Fitted network that predicts the class of its only channel: one of the labels seen in training.
#[derive(Clone, Debug)]
pub struct NetworkClassifier {
    channels: Channels,
    /// Network with one output for each class.
    network: NetworkRegressor,
    classes: ClassCard,
}

/// Artificial channels for the outputs of a network with `count` classes, named `class_000` and so on.
pub(super) fn class_channels(count: usize) -> Result<Channels, ModelError> {
    let named = (0..count).map(|class| Channel::named(&format!("class_{class:03}"), Unit::One));
    let channels = named.collect::<Result<Vec<_>, _>>();
    let channels = channels.and_then(Channels::new);
    channels.map_err(|error| invalid("the classes of a network").because(error))
}

/// Loads a network from a file: a classifier if the model card lists classes, otherwise a network that predicts numbers.
pub(super) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
    let card = stored.card.network.as_ref().ok_or(FormatError::Card)?;
    let found = named_tensors(&stored.tensors)?;
    let of_stored = stored.channels.clone();
    let Some(classes) = &card.classes else {
        let own = NetworkRegressor::of_tensors(stored, of_stored, card, found)?;
        return Ok(ModelRegressor::new(own));
    };
    let channels = class_channels(classes.labels.len())?;
    let network = NetworkRegressor::of_tensors(stored, channels, card, found)?;
    let own = NetworkClassifier::new(of_stored, network, classes.clone())?;
    Ok(ModelRegressor::new(own))
}

impl NetworkClassifier {
    /// Builds a classifier from a network with one output for each label of `classes`.
    ///
    /// # Errors
    /// [`ModelError`] if `classes`, channels and network do not match each other.
    pub(super) fn new(
        channels: Channels,
        network: NetworkRegressor,
        classes: ClassCard,
    ) -> Result<NetworkClassifier, ModelError> {
        let labels = &classes.labels;
        let are_ascending = labels.windows(2).all(|pair| pair[0] < pair[1]);
        let are_finite = labels.iter().all(|label| label.is_finite());
        let is_divisor = classes.temperature.is_finite() && classes.temperature > 0.0;
        if channels.len() != 1
            || labels.len() != network.channels().len()
            || !are_ascending
            || !are_finite
            || !is_divisor
        {
            return Err(ModelError::new(
                ErrorKind::OutOfRange,
                "the classes of the card differ from the outputs of the network",
            ));
        }
        Ok(NetworkClassifier {
            channels,
            network,
            classes,
        })
    }

    /// Entry of the model card with the class labels and the softmax temperature.
    pub fn classes(&self) -> &ClassCard {
        &self.classes
    }

    /// Network outputs before softmax, with shape `[samples, classes]`.
    fn outputs(&self, features: &Features) -> Result<Vec<f64>, ModelError> {
        let mut outputs = vec![0.0; features.samples() * self.classes.labels.len()];
        self.network.predict(features, &mut outputs)?;
        Ok(outputs)
    }
}

impl FittedModel for NetworkClassifier {
    fn kind(&self) -> KindCard {
        KindCard {
            network: Some(NetworkCard {
                classes: Some(self.classes.clone()),
                ..self.network.card().clone()
            }),
            ..KindCard::default()
        }
    }

    fn tensors(&self) -> Vec<Raw> {
        FittedModel::tensors(&self.network)
    }

    fn reads_features(&self) -> bool {
        self.classes.labels.len() > 1
    }

    fn probabilities(&self, features: &Features) -> Result<Option<ClassProbabilities>, ModelError> {
        let labels = self.classes.labels.clone();
        let mut shares = Vec::with_capacity(features.samples() * labels.len());
        if labels.len() == 1 {
            shares.resize(features.samples(), 1.0);
        } else {
            for outputs in self.outputs(features)?.chunks_exact(labels.len()) {
                softmax(outputs, self.classes.temperature, &mut shares);
            }
        }
        Ok(Some(ClassProbabilities { labels, shares }))
    }

    fn through(&self, _: &Pca) -> Result<Option<ModelRegressor>, ModelError> {
        Err(invalid(NO_PICTURE))
    }
}

impl Regressor for NetworkClassifier {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.network.shape()
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(&self.channels, self.shape(), features, into)?;
        let labels = &self.classes.labels;
        if let [only] = labels.as_slice() {
            into.fill(*only);
            return Ok(());
        }
        let outputs = self.outputs(features)?;
        let samples = into.iter_mut().zip(outputs.chunks_exact(labels.len()));
        samples.for_each(|(place, outputs)| *place = labels[greatest(outputs)]);
        Ok(())
    }
}
