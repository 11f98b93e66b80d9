//! A fitted model with all that is needed to use it and to know where it comes from.

mod bounds;
mod card;
mod input;
mod of_plugin;

use taceva_core::{
    Channel, Channels, ErrorKind, Features, Frame, FrameInfo, ModelError, Progress, Regressor,
    TrainingSet,
};

pub use self::card::{ChannelCard, Form, ModelCard, Provenance, SampleCounts, Source, SplitCard};
pub use self::input::FitInput;
pub(crate) use self::of_plugin::plugin_from;
use crate::features::choice::FeatureChoice;
use crate::features::{Extractor, FeatureError, Pca};
use crate::training::fit::ModelRegressor;
use crate::training::problem::invalid;

/// A fitted model: from pixels to the channels, in their units.
///
/// Where every step after the extraction is linear, scaling, principal components and weights are kept as one set of weights;
/// a network keeps what it does to pictures beside its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub(crate) card: ModelCard,
    pub(crate) regressor: ModelRegressor,
}

impl Model {
    /// Fits `input.estimator`, and the principal components before it, if any are asked for.
    ///
    /// # Errors
    /// [`ModelError`] if the parts do not fit each other, nothing can be learnt from them, or `progress` was cancelled.
    pub fn fit(input: FitInput<'_>, progress: &dyn Progress) -> Result<Model, ModelError> {
        let shape = input.features.shape();
        if input.training.features.shape() != shape {
            return Err(invalid(format!(
                "training features of shape {:?}, asked for {:?}",
                input.training.features.shape(),
                shape
            )));
        }
        let pca = match input.features.pca {
            None => None,
            Some(count) => Some(Pca::fit(input.training.features, count as usize, progress)?),
        };
        let seen =
            |features: &Features| pca.as_ref().map(|pca| pca.transform(features)).transpose();
        let learnt = seen(input.training.features)?;
        let held = match &input.validation {
            Some(set) => seen(set.features)?,
            None => None,
        };
        let training = with_features(input.training, learnt.as_ref());
        let validation = input
            .validation
            .map(|set| with_features(set, held.as_ref()));
        let chosen = input.estimator.choose(&training, progress)?;
        let estimator = chosen
            .as_ref()
            .map_or(input.estimator, |chosen| &*chosen.estimator);
        let fit = estimator.fit_model(&training, validation.as_ref(), progress)?;
        let kept = pca.as_ref().map(|pca| pca.variance_ratio().iter().sum());
        let regressor = match pca {
            None => fit.regressor.clone(),
            Some(pca) => fit.regressor.clone().through(pca)?,
        };
        let how = (
            estimator.name(),
            chosen.as_ref().map(|chosen| chosen.card.clone()),
        );
        let card = ModelCard::new(&input, &fit, how, kept);
        Ok(Model { card, regressor })
    }

    /// What it is and where it comes from.
    pub fn card(&self) -> &ModelCard {
        &self.card
    }

    /// The same, its card saying how its features were chosen.
    #[must_use]
    pub fn with_features_chosen(mut self, how: FeatureChoice) -> Model {
        self.card.feature_choice = Some(how);
        self
    }

    /// Whether files of its format carry a seal, so that a change of them is noticed.
    pub fn is_sealed(&self) -> bool {
        crate::file::is_sealed(&self.card.format)
    }

    /// What it predicts.
    pub fn channels(&self) -> &Channels {
        self.regressor.channels()
    }

    /// What predicts the channels from the features of pixels.
    pub fn regressor(&self) -> &ModelRegressor {
        &self.regressor
    }

    /// Whether its predictions depend on what is seen; if not, no frame need be decoded for it.
    pub fn reads_features(&self) -> bool {
        self.regressor.reads_features()
    }

    /// Takes the features that this model was fitted on from frames of `info`.
    ///
    /// # Errors
    /// [`FeatureError`] if the model was fitted on frames of another kind, or needs a `reference` frame and gets none.
    pub fn extractor(
        &self,
        info: FrameInfo,
        reference: Option<&Frame>,
    ) -> Result<Extractor, FeatureError> {
        if info != self.card.frame {
            return Err(FeatureError::Kind {
                expected: self.card.frame,
                found: info,
            });
        }
        Extractor::new(self.card.features, info, reference)
    }

    /// The prediction for every sample of `features`, within the [bounds](Model::bounds) of its channel.
    ///
    /// # Shapes
    /// `[samples, channels]`.
    /// # Units
    /// Those of the channels.
    /// # Errors
    /// [`ModelError`] if the features are of another shape, or a prediction is not finite.
    pub fn predict(&self, features: &Features) -> Result<Vec<f64>, ModelError> {
        let mut predictions = self.predict_unbounded(features)?;
        self.bound(&mut predictions);
        Ok(predictions)
    }

    /// The prediction for every sample of `features` as the model gives it, however far from the labels of the training part.
    ///
    /// # Shapes
    /// `[samples, channels]`.
    /// # Units
    /// Those of the channels.
    /// # Errors
    /// As [`predict`](Model::predict).
    pub fn predict_unbounded(&self, features: &Features) -> Result<Vec<f64>, ModelError> {
        let mut predictions = vec![0.0; features.samples() * self.channels().len()];
        self.regressor.predict(features, &mut predictions)?;
        Ok(predictions)
    }

    /// The standard deviation of every prediction, before bounds; `None` for a model that does not know it.
    ///
    /// # Shapes
    /// `[samples, channels]`.
    /// # Units
    /// Those of the channels.
    /// # Errors
    /// [`ModelError`] if the features are of another shape.
    pub fn deviations(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        self.regressor.deviations(features)
    }
}

/// The same samples, seen as `features` where there are others.
fn with_features<'s>(mut set: TrainingSet<'s>, features: Option<&'s Features>) -> TrainingSet<'s> {
    set.features = features.unwrap_or(set.features);
    set
}

/// The channels that a card lists.
pub(crate) fn channels_of(card: &ModelCard) -> Result<Channels, ModelError> {
    let named = |channel: &ChannelCard| Channel::named(&channel.name, channel.unit);
    let list: Result<Vec<Channel>, _> = card.channels.iter().map(named).collect();
    let refuse =
        |error| ModelError::new(ErrorKind::Protocol, "a channel of the card").because(error);
    let channels = Channels::new(list.map_err(refuse)?).map_err(refuse)?;
    let in_order = channels
        .iter()
        .zip(&card.channels)
        .all(|(channel, own)| channel.name() == own.name);
    if in_order && !channels.is_empty() {
        Ok(channels)
    } else {
        Err(ModelError::new(
            ErrorKind::Protocol,
            "the channels of the card are not in canonical order",
        ))
    }
}
