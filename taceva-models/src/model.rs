//! Fitted models, with the provenance of their training data.

mod angles;
mod bounds;
mod card;
mod finer_features;
mod input;

use taceva_core::{
    Channel, Channels, ErrorKind, Features, Input, InputInfo, ModelError, Progress, Regressor,
    Targets, TrainingSet,
};

pub(crate) use self::angles::LearntChannels;
pub use self::bounds::LabelBounds;
pub use self::finer_features::CloserFeatures;
pub use self::input::FitInput;
use crate::features::choice::FeatureChoice;
use crate::features::signals::{divided, spread};
use crate::features::{Extractor, FeatureDistance, FeatureError, Pca};
use crate::linalg::invalid;
use crate::training::card::{AngleCard, ChannelCard, DistanceCard, ModelCard, ValidationCard};
use crate::training::regressor::{ClassProbabilities, ModelRegressor};

/// Fitted model that predicts channels, in their units, from pixels or signals.
///
/// If all steps from features to predictions are linear, scaling, principal components and weights are stored as one set of weights. A network's
/// preprocessing is stored with its weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub(crate) card: ModelCard,
    pub(crate) regressor: ModelRegressor,
    pub(crate) channels: LearntChannels,
    /// Distance of features from the training part; `None` if it is not available.
    pub(crate) distance: Option<FeatureDistance>,
}

impl Model {
    /// Fits `input.estimator`, after the computation of principal components if they are requested.
    ///
    /// The estimator learns sine and cosine of an angle with a period. Predictions are converted back to angles.
    ///
    /// # Errors
    /// [`ModelError`] if the parts do not match, the data is unsuitable for a fit, or `progress` was cancelled.
    pub fn fit(input: FitInput<'_>, progress: &dyn Progress) -> Result<Model, ModelError> {
        let targets = input.training.targets;
        let asked = targets.channels;
        if !targets.values.len().is_multiple_of(asked.len().max(1)) {
            return Model::fit_learnt(input, Vec::new(), asked, progress);
        }
        let angles = AngleCard::of_labels(asked, targets.values);
        if angles.is_empty() {
            return Model::fit_learnt(input, angles, asked, progress);
        }
        let channels = LearntChannels::new(asked, &angles);
        let channels = channels.map_err(|error| {
            invalid("an angle with a period is learnt as NAME_sin and NAME_cos: rename the channel")
                .because(error)
        })?;
        let values = channels.labels(targets.values);
        let held = input
            .validation
            .map(|set| channels.labels(set.targets.values));
        // Shortens the lifetime of the input to the lifetime of the labels.
        let mut input = input;
        input.training.targets = Targets::new(&channels.learnt, &values);
        if let Some((set, held)) = input.validation.as_mut().zip(held.as_ref()) {
            set.targets = Targets::new(&channels.learnt, held);
        }
        Model::fit_learnt(input, angles, asked, progress)
    }

    /// Fits the channels that the estimator learns, with sine and cosine in place of angles. `asked` contains the channels that the model predicts.
    fn fit_learnt(
        input: FitInput<'_>,
        angles: Vec<AngleCard>,
        asked: &Channels,
        progress: &dyn Progress,
    ) -> Result<Model, ModelError> {
        let shape = input.features.shape();
        if input.training.features.shape() != shape {
            return Err(invalid(format!(
                "training features of shape {}, expected {}",
                input.training.features.shape(),
                shape
            )));
        }
        let is_of_signals = input.features.channels.is_some();
        let spread = is_of_signals.then(|| spread(input.training.features));
        let even = |features| spread.as_ref().map(|spread| divided(features, spread));
        let learnt = even(input.training.features);
        let held = input.validation.and_then(|set| even(set.features));
        let pca = match input.features.pca {
            None => None,
            Some(count) => {
                let training = learnt.as_ref().unwrap_or(input.training.features);
                Some(Pca::fit(training, count as usize, progress)?)
            }
        };
        let distance = FeatureDistance::fit(
            learnt.as_ref().unwrap_or(input.training.features),
            input.training.groups,
            progress,
        )?;
        let seen = |even: Option<Features>, features: &Features| match &pca {
            None => Ok(even),
            Some(pca) => pca.transform(even.as_ref().unwrap_or(features)).map(Some),
        };
        let learnt = seen(learnt, input.training.features)?;
        let held = match &input.validation {
            Some(set) => seen(held, set.features)?,
            None => None,
        };
        let training = with_features(input.training, learnt.as_ref());
        let validation = input
            .validation
            .map(|set| with_features(set, held.as_ref()));
        let of_signals = match input.input {
            InputInfo::Signals(info) => input.estimator.of_signals(info),
            _ => Ok(None),
        };
        let of_signals = of_signals.map_err(|error| invalid(error.to_string()).because(error))?;
        let estimator = of_signals.as_deref().unwrap_or(input.estimator);
        let chosen = estimator.choose(&training, validation.as_ref(), None, progress)?;
        let estimator = chosen
            .as_ref()
            .map_or(estimator, |chosen| &*chosen.estimator);
        let fit = estimator.fit_model(&training, validation.as_ref(), progress)?;
        let kept = pca.as_ref().map(|pca| pca.variance_ratio().iter().sum());
        let regressor = match pca {
            None => fit.regressor.clone(),
            Some(pca) => fit.regressor.clone().through(pca)?,
        };
        let auto = chosen.as_ref().map(|chosen| chosen.card.clone());
        let mut card = ModelCard::new(&input, &fit, estimator.name(), auto, kept, spread);
        let distance = distance.filter(|_| regressor.reads_features());
        card.distance = distance.as_ref().map(DistanceCard::of);
        let channels = LearntChannels::new(asked, &angles)
            .map_err(|error| invalid(error.to_string()).because(error))?;
        card.angles = angles;
        Ok(Model {
            card,
            regressor,
            channels,
            distance,
        })
    }

    /// Description and provenance of the model.
    pub fn card(&self) -> &ModelCard {
        &self.card
    }

    /// Records in the model card how the features were chosen.
    #[must_use]
    pub fn with_features_chosen(mut self, how: FeatureChoice) -> Model {
        self.card.feature_choice = Some(how);
        self
    }

    /// Records in the model card the cross-validation of models fitted in the same way.
    #[must_use]
    pub fn with_validation(mut self, validation: ValidationCard) -> Model {
        self.card.provenance.validation = Some(validation);
        self
    }

    /// Predicted channels.
    pub fn channels(&self) -> &Channels {
        &self.channels.asked
    }

    /// Best constant prediction of each channel: the mean training label, or the mean direction of an angle with a period.
    pub fn constants(&self) -> impl Iterator<Item = (&str, f64)> {
        let learnt = self.card.channels.iter();
        let means = learnt.map(|channel| (channel.name.as_str(), channel.mean));
        let means = means.filter(|(name, _)| self.channels.asked.position(name).is_some());
        let angles = self.card.angles.iter();
        means.chain(angles.map(|angle| (angle.name.as_str(), angle.mean)))
    }

    /// Regressor that predicts the learnt channels, with sine and cosine in place of angles. Reads features of pixels, or signals divided by their
    /// spread.
    pub fn regressor(&self) -> &ModelRegressor {
        &self.regressor
    }

    /// True if predictions depend on features. Otherwise the caller need not decode frames or read signals.
    pub fn reads_features(&self) -> bool {
        self.regressor.reads_features()
    }

    /// True if predictions depend on frames.
    pub fn reads_frames(&self) -> bool {
        self.reads_features() && matches!(self.card.input, InputInfo::Frame(_))
    }

    /// Builds the extractor of this model's features for frames or signals of `info`.
    ///
    /// # Errors
    /// [`FeatureError`] if `info` differs from the training data, if a needed `reference` is missing, or if the model reads windows of frames.
    pub fn extractor(
        &self,
        info: impl Into<InputInfo>,
        reference: Option<Input<'_>>,
    ) -> Result<Extractor, FeatureError> {
        match self.card.features.window {
            Some(window) => Err(FeatureError::Window { window }),
            None => self.frame_extractor(info, reference),
        }
    }

    /// Builds the extractor of the features of each frame, also for a model that reads windows of frames.
    ///
    /// # Errors
    /// Errors of [`extractor`](Model::extractor), except the error for windows.
    pub fn frame_extractor(
        &self,
        info: impl Into<InputInfo>,
        reference: Option<Input<'_>>,
    ) -> Result<Extractor, FeatureError> {
        match (self.card.input, info.into()) {
            (InputInfo::Frame(expected), InputInfo::Frame(found)) if expected != found => {
                Err(FeatureError::Kind { expected, found })
            }
            (expected, found) if expected != found => Err(FeatureError::Input { expected, found }),
            (_, info) => Extractor::new(self.card.features, info, reference),
        }
    }

    /// Predicts every sample of `features`, clipped to the [bounds](Model::label_bounds) of each channel.
    ///
    /// # Shapes
    /// Returns `[samples, channels]`.
    /// # Units
    /// Predictions have the units of the channels.
    /// # Errors
    /// [`ModelError`] if the shape of `features` differs from the model's, or a prediction is not finite.
    pub fn predict(&self, features: &Features) -> Result<Vec<f64>, ModelError> {
        let mut predictions = self.predict_unbounded(features)?;
        self.label_bounds().bound(&mut predictions);
        Ok(predictions)
    }

    /// Predicts every sample of `features` without clipping to bounds.
    ///
    /// # Shapes
    /// Returns `[samples, channels]`.
    /// # Units
    /// Predictions have the units of the channels.
    /// # Errors
    /// Errors of [`predict`](Model::predict).
    pub fn predict_unbounded(&self, features: &Features) -> Result<Vec<f64>, ModelError> {
        let even = self.even(features)?;
        let learnt = self.learnt(even.as_ref().unwrap_or(features))?;
        Ok(match self.card.angles.is_empty() {
            true => learnt,
            false => self.channels.answers(&learnt),
        })
    }

    /// Predicts the learnt channels, with sine and cosine in place of angles, for every sample of `features`.
    fn learnt(&self, features: &Features) -> Result<Vec<f64>, ModelError> {
        let mut predictions = vec![0.0; features.samples() * self.channels.learnt.len()];
        self.regressor.predict(features, &mut predictions)?;
        Ok(predictions)
    }

    /// Distance of samples from the training part, with the limit of this distance.
    ///
    /// `None` for a model that uses no features, was fitted to fewer than 20 samples, or comes from an older file.
    pub fn feature_distance(&self) -> Option<&FeatureDistance> {
        self.distance.as_ref()
    }

    /// [Distance](FeatureDistance) of every sample of `features`, where 1 is the limit; `None` if the model has no distance.
    ///
    /// # Errors
    /// [`ModelError`] if the shape of `features` differs from the model's.
    pub fn distances(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        let Some(distance) = &self.distance else {
            return Ok(None);
        };
        let even = self.even(features)?;
        distance.of_all(even.as_ref().unwrap_or(features)).map(Some)
    }

    /// Standard deviation of every prediction before clipping to bounds; `None` if the model does not estimate deviations.
    ///
    /// # Shapes
    /// Returns `[samples, channels]`.
    /// # Units
    /// Deviations have the units of the channels.
    /// # Errors
    /// [`ModelError`] if the shape of `features` differs from the model's.
    pub fn deviations(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        let even = self.even(features)?;
        let features = even.as_ref().unwrap_or(features);
        let Some(found) = self.regressor.deviations(features)? else {
            return Ok(None);
        };
        Ok(Some(match self.card.angles.is_empty() {
            true => found,
            false => self.channels.deviations(&found, &self.learnt(features)?),
        }))
    }

    /// Probabilities of the classes of the only channel, for every sample of `features`; `None` if the model does not estimate them.
    ///
    /// # Errors
    /// [`ModelError`] if the shape of `features` differs from the model's.
    pub fn probabilities(
        &self,
        features: &Features,
    ) -> Result<Option<ClassProbabilities>, ModelError> {
        let even = self.even(features)?;
        let features = even.as_ref().unwrap_or(features);
        self.regressor.probabilities(features)
    }

    /// Divides signals by their spread over the training part; `None` for frames, which are not divided.
    fn even(&self, features: &Features) -> Result<Option<Features>, ModelError> {
        let Some(spread) = &self.card.spread else {
            return Ok(None);
        };
        let (found, expected) = (features.shape(), self.card.features.shape());
        if found != expected {
            return Err(invalid(format!(
                "signals of shape {found}, expected {expected}"
            )));
        }
        Ok(Some(divided(features, spread)))
    }
}

/// Replaces the features of the training set by `features`, if given.
fn with_features<'s>(mut set: TrainingSet<'s>, features: Option<&'s Features>) -> TrainingSet<'s> {
    set.features = features.unwrap_or(set.features);
    set
}

/// Learnt channels of the model of a card. Learnt sines and cosines belong to the angles that the card lists.
pub(crate) fn learnt_channels_of(
    card: &ModelCard,
    learnt: &Channels,
) -> Result<LearntChannels, ModelError> {
    let refuse =
        |error| ModelError::new(ErrorKind::Protocol, "an angle of the card").because(error);
    let is_part = |name: &str| {
        let mut angles = card.angles.iter();
        angles.any(|angle| angle.sine() == name || angle.cosine() == name)
    };
    let plain = learnt.iter().filter(|channel| !is_part(channel.name()));
    let plain = plain.cloned().map(Ok);
    let angles = card
        .angles
        .iter()
        .map(|angle| Channel::named(&angle.name, angle.unit)?.with_period(angle.period));
    let asked: Result<Vec<Channel>, _> = plain.chain(angles).collect();
    let asked = asked.and_then(Channels::new).map_err(refuse)?;
    let channels = LearntChannels::new(&asked, &card.angles).map_err(refuse)?;
    match channels.learnt == *learnt {
        true => Ok(channels),
        false => Err(ModelError::new(
            ErrorKind::Protocol,
            "the angles of the card are not among its channels",
        )),
    }
}

/// Channels listed in a card.
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
