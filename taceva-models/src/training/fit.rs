//! What fitting gives, whichever kind of model it is: a regressor that a model file can keep, and what was chosen on the way.

use taceva_core::{
    Channels, Estimator, FeatureShape, Features, ModelError, Progress, Regressor, SignalInfo,
    TrainingSet,
};

use crate::estimators::auto::AutoCard;
use crate::estimators::discriminant::ClassRegressor;
use crate::estimators::kernel::KernelRegressor;
use crate::estimators::library::LibraryRegressor;
use crate::estimators::linear::{LinearEstimator, LinearRegressor};
use crate::estimators::neighbours::NeighbourRegressor;
use crate::estimators::network::{Checkpoints, EnsembleRegressor, NetworkRegressor};
use crate::estimators::plugin::PluginRegressor;
use crate::estimators::projected::ProjectedRegressor;
use crate::estimators::trees::TreeRegressor;
use crate::features::{FeatureError, Pca};
use crate::linalg::invalid;
use crate::training::choice::Choice;
use crate::training::file::tensors::Raw;
use crate::training::label_scaling::LabelScaling;

/// The error of a network on features that are a list.
pub(crate) const NO_PICTURE: &str = "a network reads pictures, and principal components are none";

/// The error of the model of a plugin on principal components.
const OPAQUE: &str = "the model of a plugin reads pixels; it cannot be joined with principal components, and may find its own";

/// Implements [`Estimator`] for a [`ModelEstimator`]: its name, and the regressor that it fits.
macro_rules! estimator {
    ($estimator:ty, |$own:pat_param| $name:expr) => {
        impl taceva_core::Estimator for $estimator {
            fn name(&self) -> &str {
                let $own = self;
                $name
            }

            fn fit(
                &self,
                training: &taceva_core::TrainingSet<'_>,
                validation: Option<&taceva_core::TrainingSet<'_>>,
                progress: &dyn taceva_core::Progress,
            ) -> Result<Box<dyn taceva_core::Regressor>, taceva_core::ModelError> {
                use crate::training::fit::ModelEstimator as _;
                let fit = self.fit_model(training, validation, progress)?;
                Ok(Box::new(fit.regressor))
            }
        }
    };
}
pub(crate) use estimator;

/// An estimator whose regressor a model file can keep, and that can say what it chose.
pub trait ModelEstimator: Estimator {
    /// The estimator that takes the place of this one on `training`, and why; `None` for every one but that which only chooses. Some of those that it
    /// chooses from see finer features, `closer`, of the same samples, where there are such.
    ///
    /// # Errors
    /// As [`Estimator::fit`].
    fn choose(
        &self,
        _training: &TrainingSet<'_>,
        _closer: Option<&Features>,
        _progress: &dyn Progress,
    ) -> Result<Option<Chosen>, ModelError> {
        Ok(None)
    }

    /// Whether it would look at finer features in [`choose`](ModelEstimator::choose): so many samples of so many such features, and channels. `false`
    /// for every one but that which only chooses.
    fn looks_closer(&self, _: [usize; 3]) -> bool {
        false
    }

    /// The same with `share` of its training, for a first look at what it can do; `None` for every one but those that are trained step by step.
    fn first_look(&self, _share: f64) -> Option<Box<dyn ModelEstimator>> {
        None
    }

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

    /// The estimator that takes the place of this one where signals of `info` are learnt from; `None` for every one but those that are made for
    /// pictures.
    ///
    /// # Errors
    /// [`FeatureError::NarrowGrid`] if it cannot learn from a grid of so few places.
    fn of_signals(
        &self,
        _info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        Ok(None)
    }

    /// Keeps checkpoints of trainings from now on, and resumes from what is found there; a model that is fitted in one step keeps none.
    fn keep_checkpoints(&mut self, _: Checkpoints) {}
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

/// A model that was chosen among others.
pub struct Chosen {
    /// The model.
    pub estimator: Box<dyn ModelEstimator>,
    /// What was tried, and what came of it.
    pub card: AutoCard,
    /// Whether it sees the finer features.
    pub is_closer: bool,
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
    /// Linear in a kernel of landmarks.
    Kernel(Box<KernelRegressor>),
    /// The mean of the nearest training samples.
    Neighbours(Box<NeighbourRegressor>),
    /// One of the labels of the training part.
    Classes(Box<ClassRegressor>),
    /// Trees whose answers are added up.
    Trees(Box<TreeRegressor>),
    /// A network that reads features as a picture.
    Network(Box<NetworkRegressor>),
    /// The mean of several networks.
    Ensemble(Box<EnsembleRegressor>),
    /// Of another library, whose parameters are kept.
    Library(Box<LibraryRegressor>),
    /// Of a plugin, which answers.
    Plugin(PluginRegressor),
    /// Any of them but the linear, the network and that of a plugin, on principal components.
    Projected(Box<ProjectedRegressor>),
}

impl ModelRegressor {
    /// The regressor of pixels that equals `self` on the components of `pca`.
    ///
    /// # Errors
    /// [`ModelError`] for a network, which reads pictures, and for a plugin's, whose weights are not accessible.
    pub(crate) fn through(self, pca: Pca) -> Result<ModelRegressor, ModelError> {
        match self {
            ModelRegressor::Linear(linear) => linear.through(&pca).map(ModelRegressor::Linear),
            ModelRegressor::Network(_) | ModelRegressor::Ensemble(_) => Err(invalid(NO_PICTURE)),
            ModelRegressor::Plugin(_) => Err(invalid(OPAQUE)),
            other => {
                let projected = ProjectedRegressor::new(pca, other);
                Ok(ModelRegressor::Projected(Box::new(projected)))
            }
        }
    }

    /// Whether predictions depend on what is seen: a linear model without weights needs no frame.
    pub(crate) fn reads_features(&self) -> bool {
        match self {
            ModelRegressor::Linear(linear) => {
                linear.weights().iter().any(|weight| weight.abs() > 0.0)
            }
            ModelRegressor::Kernel(kernel) => kernel.reads_features(),
            ModelRegressor::Neighbours(neighbours) => neighbours.reads_features(),
            ModelRegressor::Classes(classes) => classes.reads_features(),
            ModelRegressor::Trees(trees) => trees.reads_features(),
            ModelRegressor::Network(network) => network.reads_features(),
            ModelRegressor::Ensemble(ensemble) => ensemble.reads_features(),
            ModelRegressor::Library(library) => library.reads_features(),
            ModelRegressor::Plugin(_) => true,
            ModelRegressor::Projected(projected) => projected.inner().reads_features(),
        }
    }

    /// Whether it knows the standard deviations of its predictions.
    pub fn knows_deviations(&self) -> bool {
        match self {
            ModelRegressor::Kernel(kernel) => kernel.knows_deviations(),
            ModelRegressor::Projected(projected) => projected.inner().knows_deviations(),
            _ => false,
        }
    }

    /// The standard deviation of every prediction; `None` for a model that does not know it.
    ///
    /// # Shapes
    /// `[samples, channels]`.
    /// # Units
    /// Those of the channels.
    /// # Errors
    /// [`ModelError`] if the features are of another shape.
    pub fn deviations(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        match self {
            ModelRegressor::Kernel(kernel) => kernel.deviations(features),
            ModelRegressor::Projected(projected) => projected.deviations(features),
            _ => Ok(None),
        }
    }

    /// The tensors of a file.
    pub(crate) fn tensors(&self) -> Vec<Raw> {
        match self {
            ModelRegressor::Linear(linear) => linear.tensors(),
            ModelRegressor::Kernel(kernel) => kernel.tensors(),
            ModelRegressor::Neighbours(neighbours) => neighbours.tensors(),
            ModelRegressor::Classes(classes) => classes.tensors(),
            ModelRegressor::Trees(trees) => trees.tensors(),
            ModelRegressor::Network(network) => {
                let tensors = network.tensors().into_iter();
                tensors
                    .map(|tensor| Raw::singles(&tensor.name, tensor.shape, &tensor.values))
                    .collect()
            }
            ModelRegressor::Ensemble(ensemble) => ensemble.tensors(),
            ModelRegressor::Library(library) => library.tensors(),
            ModelRegressor::Plugin(plugin) => vec![plugin.tensor()],
            ModelRegressor::Projected(projected) => projected.tensors(),
        }
    }

    fn inner(&self) -> &dyn Regressor {
        match self {
            ModelRegressor::Linear(linear) => linear,
            ModelRegressor::Kernel(kernel) => &**kernel,
            ModelRegressor::Neighbours(neighbours) => &**neighbours,
            ModelRegressor::Classes(classes) => &**classes,
            ModelRegressor::Trees(trees) => &**trees,
            ModelRegressor::Network(network) => &**network,
            ModelRegressor::Ensemble(ensemble) => &**ensemble,
            ModelRegressor::Library(library) => &**library,
            ModelRegressor::Plugin(plugin) => plugin,
            ModelRegressor::Projected(projected) => &**projected,
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
