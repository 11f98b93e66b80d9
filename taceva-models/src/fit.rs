//! What fitting gives, whichever kind of model it is: a regressor that a model file can keep, and what was chosen on the way.

use taceva_core::{
    Channels, Estimator, FeatureShape, Features, ModelError, Progress, Regressor, TrainingSet,
};

use crate::choice::Choice;
use crate::features::Pca;
use crate::label_scaling::LabelScaling;
use crate::linear::{LinearEstimator, LinearRegressor};
use crate::network::{Checkpoints, NetworkRegressor};
use crate::plugin::PluginRegressor;
use crate::problem::invalid;

/// What a network says to features that are a list.
pub(crate) const NO_PICTURE: &str = "a network reads pictures, and principal components are none";

/// What the model of a plugin says to principal components.
const OPAQUE: &str = "the model of a plugin reads pixels; it cannot be joined with principal components, and may find its own";

/// An estimator whose regressor a model file can keep, and that can say what it chose.
pub trait ModelEstimator: Estimator {
    /// Learns as [`Estimator::fit`] does.
    ///
    /// # Errors
    /// As [`Estimator::fit`].
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError>;

    /// From now on puts aside what was learnt so far, and goes on from what is found there; a model that is fitted in one go
    /// has nothing to put aside.
    fn put_aside(&mut self, _: Checkpoints) {}
}

impl<L: LinearEstimator> ModelEstimator for L {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let fit = self.fit_linear(training, validation, progress)?;
        Ok(ModelFit {
            regressor: ModelRegressor::Linear(fit.regressor),
            choice: fit.choice,
            scaling: fit.scaling,
            refitted: fit.refitted,
        })
    }
}

/// What fitting gave.
#[derive(Clone, Debug)]
pub struct ModelFit {
    /// The fitted model, in the units of the channels.
    pub regressor: ModelRegressor,
    /// What was chosen for each channel, and how well it did.
    pub choice: Choice,
    /// The label ranges of the training part.
    pub scaling: LabelScaling,
    /// Whether the validation part was learnt from too, once the settings were chosen.
    pub refitted: bool,
}

/// A fitted model of a kind that a file can keep.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModelRegressor {
    /// Linear in the features.
    Linear(LinearRegressor),
    /// A network that reads features as a picture.
    Network(Box<NetworkRegressor>),
    /// Of a plugin, which answers.
    Plugin(PluginRegressor),
}

impl ModelRegressor {
    /// The regressor of pixels that equals `self` on the components of `pca`.
    ///
    /// # Errors
    /// [`ModelError`] for a network, which reads pictures, and for a plugin's, which nobody can look into.
    pub(crate) fn through(&self, pca: &Pca) -> Result<ModelRegressor, ModelError> {
        match self {
            ModelRegressor::Linear(linear) => linear.through(pca).map(ModelRegressor::Linear),
            ModelRegressor::Network(_) => Err(invalid(NO_PICTURE)),
            ModelRegressor::Plugin(_) => Err(invalid(OPAQUE)),
        }
    }

    /// Whether predictions depend on what is seen: a linear model without weights needs no frame.
    pub(crate) fn reads_features(&self) -> bool {
        match self {
            ModelRegressor::Linear(linear) => {
                linear.weights().iter().any(|weight| weight.abs() > 0.0)
            }
            ModelRegressor::Network(network) => network.reads_features(),
            ModelRegressor::Plugin(_) => true,
        }
    }

    fn inner(&self) -> &dyn Regressor {
        match self {
            ModelRegressor::Linear(linear) => linear,
            ModelRegressor::Network(network) => &**network,
            ModelRegressor::Plugin(plugin) => plugin,
        }
    }
}

impl Regressor for ModelRegressor {
    fn channels(&self) -> &Channels {
        self.inner().channels()
    }

    fn shape(&self) -> FeatureShape {
        self.inner().shape()
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        self.inner().predict(features, into)
    }
}
