//! Adapter for models that a plugin has fitted.

use std::fmt;
use std::sync::Arc;

use safetensors::tensor::Dtype;
use taceva_core::{
    Channels, ErrorKind, EstimatorFactory, FeatureShape, Features, ModelError, Regressor, Saved,
    SavedRegressor, not_finite,
};

use crate::features::Pca;
use crate::linalg::invalid;
use crate::training::card::{KindCard, PluginCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::Raw;
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Name of the tensor that contains the bytes of the plugin's model.
const TENSOR: &str = "plugin";

/// Error message for a plugin model that would read principal components.
const OPAQUE: &str = "the model of a plugin reads pixels: remove `pca`; the plugin may compute its own principal components";

/// Fitted model of a plugin. The plugin computes predictions; this type stores the model's bytes.
#[derive(Clone)]
pub struct PluginRegressor {
    card: PluginCard,
    fitted: Arc<dyn SavedRegressor>,
    bytes: Arc<[u8]>,
}

impl PluginRegressor {
    pub(super) fn new(
        card: PluginCard,
        fitted: Box<dyn SavedRegressor>,
        bytes: Vec<u8>,
        channels: &Channels,
        shape: FeatureShape,
    ) -> Result<PluginRegressor, ModelError> {
        if fitted.channels() != channels || fitted.shape() != shape {
            let named = |channels: &Channels| {
                let names: Vec<&str> = channels.iter().map(|channel| channel.name()).collect();
                names.join(", ")
            };
            let why = format!(
                "{}: its model gives {} from {}, expected {} from {shape}",
                card.key,
                named(fitted.channels()),
                fitted.shape(),
                named(channels),
            );
            return Err(ModelError::new(ErrorKind::DeviceFault, why));
        }
        Ok(PluginRegressor {
            card,
            fitted: fitted.into(),
            bytes: bytes.into(),
        })
    }

    /// Loads the model from a file. The plugin decodes its bytes through `factory`.
    pub(crate) fn load(
        factory: &dyn EstimatorFactory,
        card: &PluginCard,
        stored: &Stored<'_>,
    ) -> Result<ModelRegressor, FormatError> {
        stored.tensors.only(&[TENSOR])?;
        let tensor = stored.tensors.0.tensor(TENSOR);
        let tensor = tensor.map_err(|_| FormatError::Missing { name: TENSOR })?;
        let features = stored.card.features;
        if tensor.dtype() != Dtype::U8 || features.pca.is_some() || stored.card.model != card.key {
            return Err(FormatError::Card);
        }
        let saved = Saved::new(tensor.data(), &stored.channels, features.shape());
        factory.admit(card.build.as_deref())?;
        let fitted = factory.load(&saved)?;
        let bytes = saved.bytes.to_vec();
        let own = PluginRegressor::new(card.clone(), fitted, bytes, saved.channels, saved.shape)?;
        Ok(ModelRegressor::new(own))
    }

    /// Entry of the model card about the plugin that fitted the model.
    pub fn card(&self) -> &PluginCard {
        &self.card
    }
}

impl FittedModel for PluginRegressor {
    fn kind(&self) -> KindCard {
        KindCard {
            plugin: Some(self.card.clone()),
            ..KindCard::default()
        }
    }

    /// One tensor of bytes: the plugin's model, as the plugin saved it.
    fn tensors(&self) -> Vec<Raw> {
        vec![Raw {
            name: TENSOR.to_owned(),
            kind: Dtype::U8,
            shape: vec![self.bytes.len()],
            bytes: self.bytes.to_vec(),
        }]
    }

    fn reads_features(&self) -> bool {
        true
    }

    fn through(&self, _: &Pca) -> Result<Option<ModelRegressor>, ModelError> {
        Err(invalid(OPAQUE))
    }
}

impl Regressor for PluginRegressor {
    fn channels(&self) -> &Channels {
        self.fitted.channels()
    }

    fn shape(&self) -> FeatureShape {
        self.fitted.shape()
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        // Values that the plugin does not write stay NaN and are rejected below.
        into.fill(f64::NAN);
        self.fitted.predict(features, into)?;
        not_finite(self.channels(), into).map_or(Ok(()), |why| {
            let why = format!("{}: cannot predict: {why}", self.card.key);
            Err(ModelError::new(ErrorKind::DeviceFault, why))
        })
    }
}

impl fmt::Debug for PluginRegressor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PluginRegressor")
            .field("card", &self.card)
            .field("bytes", &self.bytes.len())
            .finish_non_exhaustive()
    }
}
