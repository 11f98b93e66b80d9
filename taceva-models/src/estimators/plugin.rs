//! Models of estimators that this crate does not have: those of plugins. They are kept as their makers' bytes.

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use taceva_core::{
    Args, Channels, ErrorKind, EstimatorFactory, FeatureShape, Features, FitRequest, ModelError,
    Progress, Regressor, Saved, SavedRegressor, TrainingSet,
};

use crate::training::choice::{Choice, errors};
use crate::training::fit::{ModelEstimator, ModelFit, ModelRegressor, estimator};
use crate::training::problem::Problem;

/// What a card says of the plugin that fitted a model and is needed to ask it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PluginCard {
    /// The plugin.
    pub id: String,
    /// The estimator in it, `id/word`.
    pub key: String,
    /// The digest of the library that fitted it, `sha256:…`; `None` where it was linked into the program.
    pub build: Option<String>,
}

impl PluginCard {
    fn of(factory: &dyn EstimatorFactory) -> Result<PluginCard, ModelError> {
        let key = factory.key().as_str();
        let (id, _) = key.rsplit_once('/').unwrap_or((key, ""));
        Ok(PluginCard {
            id: id.to_owned(),
            key: key.to_owned(),
            build: factory.build()?,
        })
    }
}

/// An estimator of a plugin with its settings, not fitted yet.
pub(crate) struct PluginEstimator {
    pub(crate) factory: Arc<dyn EstimatorFactory>,
    pub(crate) settings: Args,
}

estimator!(PluginEstimator, |own| own.factory.key().as_str());

impl ModelEstimator for PluginEstimator {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let validation = problem.validation(validation)?.and(validation);
        let fitted = self.factory.fit(
            &FitRequest::new(&self.settings, training, progress).with_validation(validation),
        )?;
        let bytes = fitted.save()?;
        let kind = (training.targets.channels, training.features.shape());
        let card = PluginCard::of(&*self.factory)?;
        let regressor = PluginRegressor::new(card, fitted, (bytes, kind))?;
        let errors = match validation {
            Some(set) => errors(&regressor, set)?,
            None => vec![None; training.targets.channels.len()],
        };
        Ok(ModelFit {
            // What a plugin makes of the validation part, it does not say.
            choice: Choice::nobodys(errors),
            regressor: ModelRegressor::Plugin(regressor),
            scaling: problem.scaling,
            refitted: false,
        })
    }
}

/// A fitted model of a plugin: its maker answers, and its maker's bytes are kept.
#[derive(Clone)]
pub struct PluginRegressor {
    card: PluginCard,
    fitted: Arc<dyn SavedRegressor>,
    bytes: Arc<[u8]>,
}

impl PluginRegressor {
    fn new(
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

    /// What its maker loads it from.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
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
