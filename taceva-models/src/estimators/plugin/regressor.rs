//! A fitted model of a plugin.

use std::fmt;
use std::sync::Arc;

use safetensors::tensor::Dtype;
use taceva_core::{
    Channels, ErrorKind, EstimatorFactory, FeatureShape, Features, ModelError, Regressor, Saved,
    SavedRegressor,
};

use super::card::PluginCard;
use crate::training::file::tensors::Raw;

/// The tensor of a file that holds its maker's bytes.
pub(crate) const TENSOR: &str = "plugin";

/// A fitted model of a plugin: its maker answers, and its maker's bytes are kept.
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
        (bytes, (channels, shape)): (Vec<u8>, (&Channels, FeatureShape)),
    ) -> Result<PluginRegressor, ModelError> {
        if fitted.channels() != channels || fitted.shape() != shape {
            let named = |channels: &Channels| {
                let names: Vec<&str> = channels.iter().map(|channel| channel.name()).collect();
                names.join(", ")
            };
            let why = format!(
                "{}: its model gives {} from {:?}, expected {} from {shape:?}",
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

    /// What `factory` makes of the bytes that a model file keeps.
    pub(crate) fn load(
        factory: &dyn EstimatorFactory,
        card: &PluginCard,
        saved: &Saved<'_>,
    ) -> Result<PluginRegressor, ModelError> {
        factory.admit(card.build.as_deref())?;
        let fitted = factory.load(saved)?;
        let kind = (saved.channels, saved.shape);
        PluginRegressor::new(card.clone(), fitted, (saved.bytes.to_vec(), kind))
    }

    /// Which plugin fitted it.
    pub fn card(&self) -> &PluginCard {
        &self.card
    }

    /// The tensor of a file: what its maker loads it from.
    pub(crate) fn tensor(&self) -> Raw {
        Raw {
            name: TENSOR.to_owned(),
            kind: Dtype::U8,
            shape: vec![self.bytes.len()],
            bytes: self.bytes.to_vec(),
        }
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
        // What it leaves out is no prediction.
        into.fill(f64::NAN);
        self.fitted.predict(features, into)?;
        let wrong = into.iter().position(|value| !value.is_finite());
        wrong.map_or(Ok(()), |place| {
            let channels = self.channels().len().max(1);
            let why = format!(
                "{}: cannot predict: sample {}: {}, expected a number",
                self.card.key,
                place / channels,
                into[place]
            );
            Err(ModelError::new(ErrorKind::DeviceFault, why))
        })
    }
}

/// Models of one maker with the same bytes are the same.
impl PartialEq for PluginRegressor {
    fn eq(&self, other: &PluginRegressor) -> bool {
        self.card == other.card
            && self.bytes == other.bytes
            && self.channels() == other.channels()
            && self.shape() == other.shape()
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
