//! Interfaces of models. An [`Estimator`] is fitted to samples, and the resulting [`Regressor`] predicts.

mod error;
mod features;
mod training;

pub use error::ModelError;
pub use features::{FeatureShape, Features};
pub use training::{Targets, TrainingSet};

use crate::channel::{Channel, Channels};
use crate::progress::Progress;

/// A model before the fit, with its settings.
///
/// ```
/// use taceva_core::{
///     Channel, Channels, Estimator, FeatureShape, Features, ModelError, Progress, Regressor, SilentProgress, Targets, TrainingSet,
/// };
///
/// /// Predicts the means of the training labels.
/// struct Mean;
///
/// impl Estimator for Mean {
///     fn name(&self) -> &str {
///         "mean"
///     }
///     fn fit(
///         &self,
///         training: &TrainingSet<'_>,
///         _: Option<&TrainingSet<'_>>,
///         _: &dyn Progress,
///     ) -> Result<Box<dyn Regressor>, ModelError> {
///         let channels = training.targets.channels.clone();
///         let rows = training.targets.values.chunks_exact(channels.len());
///         let mut means = vec![0.0; channels.len()];
///         let count = rows.len() as f64;
///         rows.for_each(|row| means.iter_mut().zip(row).for_each(|(mean, value)| *mean += value / count));
///         Ok(Box::new(Fitted { channels, shape: training.features.shape(), means }))
///     }
/// }
///
/// struct Fitted {
///     channels: Channels,
///     shape: FeatureShape,
///     means: Vec<f64>,
/// }
///
/// impl Regressor for Fitted {
///     fn channels(&self) -> &Channels {
///         &self.channels
///     }
///     fn shape(&self) -> FeatureShape {
///         self.shape
///     }
///     fn predict(&self, _: &Features, into: &mut [f64]) -> Result<(), ModelError> {
///         into.chunks_exact_mut(self.means.len()).for_each(|row| row.copy_from_slice(&self.means));
///         Ok(())
///     }
/// }
///
/// let channels = Channels::new([Channel::FZ])?;
/// let features = Features::new(FeatureShape::flat(1), vec![0.1, 0.2])?;
/// let training = TrainingSet::new(&features, Targets::new(&channels, &[1.0, 2.0]));
/// let fitted = Mean.fit(&training, None, &SilentProgress)?;
/// let mut predicted = [0.0; 2];
/// fitted.predict(&features, &mut predicted)?;
/// assert_eq!(predicted, [1.5, 1.5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Estimator: Send + Sync {
    /// Name by which users select the estimator, such as `ridge`, or the key of a plugin's estimator.
    fn name(&self) -> &str;

    /// Fits a model to `training`. An estimator may choose its free settings by the error on `validation`.
    ///
    /// # Errors
    /// [`ModelError`] if the two sets differ in channels or feature shape, the samples cannot determine a model, or `progress` was cancelled.
    fn fit(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Regressor>, ModelError>;
}

/// A fitted model.
///
/// ```
/// use taceva_core::{Channel, Channels, FeatureShape, Features, ModelError, Regressor};
///
/// /// Predicts a force proportional to the brightness of the picture.
/// struct Brightness {
///     channels: Channels,
///     newton_per_step: f64,
/// }
///
/// impl Regressor for Brightness {
///     fn channels(&self) -> &Channels {
///         &self.channels
///     }
///     fn shape(&self) -> FeatureShape {
///         FeatureShape::flat(1)
///     }
///     fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
///         for (force, brightness) in into.iter_mut().zip(features.values()) {
///             *force = self.newton_per_step * f64::from(*brightness);
///         }
///         Ok(())
///     }
/// }
///
/// let model = Brightness { channels: Channels::new([Channel::FZ])?, newton_per_step: 0.5 };
/// let features = Features::new(model.shape(), vec![1.0, 3.0])?;
/// let mut forces = [0.0; 2];
/// model.predict(&features, &mut forces)?;
/// assert_eq!(forces, [0.5, 1.5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Regressor: Send + Sync {
    /// Channels that the model predicts.
    fn channels(&self) -> &Channels;

    /// Shape of the features that the model takes.
    fn shape(&self) -> FeatureShape;

    /// Predicts all channels for every sample of `features`.
    ///
    /// # Shapes
    /// `into`: `[samples, channels]`, allocated by the caller.
    /// # Errors
    /// [`ModelError`] if a shape differs, or a prediction is not finite.
    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError>;
}

/// Describes the first prediction that is not finite by sample, channel and value. `predictions` has one row per sample and one column per channel.
///
/// ```
/// use taceva_core::{Channel, Channels, not_finite};
/// let channels = Channels::new([Channel::PX, Channel::FZ])?;
/// assert_eq!(not_finite(&channels, &[0.5, 1.0]), None);
/// let found = not_finite(&channels, &[0.5, 1.0, 0.5, f64::NAN]);
/// assert_eq!(found.as_deref(), Some("sample 1, `Fz`: NaN, expected a number"));
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
pub fn not_finite(channels: &Channels, predictions: &[f64]) -> Option<String> {
    let place = predictions.iter().position(|value| !value.is_finite())?;
    let width = channels.len().max(1);
    let channel = channels.as_slice().get(place % width);
    let channel = channel.map_or("", Channel::name);
    let (sample, value) = (place / width, predictions[place]);
    Some(format!(
        "sample {sample}, `{channel}`: {value}, expected a number"
    ))
}

/// A fitted model that can be saved as bytes in its own format.
///
/// ```
/// # use taceva_core::{Channel, Channels, FeatureShape, Features, Regressor};
/// use taceva_core::{ModelError, SavedRegressor};
///
/// struct Scaled {
///     channels: Channels,
///     factor: f64,
/// }
/// # impl Regressor for Scaled {
/// #     fn channels(&self) -> &Channels {
/// #         &self.channels
/// #     }
/// #     fn shape(&self) -> FeatureShape {
/// #         FeatureShape::flat(1)
/// #     }
/// #     fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
/// #         into.iter_mut().zip(features.values()).for_each(|(to, from)| *to = self.factor * f64::from(*from));
/// #         Ok(())
/// #     }
/// # }
///
/// impl SavedRegressor for Scaled {
///     fn save(&self) -> Result<Vec<u8>, ModelError> {
///         Ok(self.factor.to_le_bytes().to_vec())
///     }
/// }
///
/// let model = Scaled { channels: Channels::new([Channel::FZ])?, factor: 0.5 };
/// assert_eq!(model.save()?, 0.5_f64.to_le_bytes());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait SavedRegressor: Regressor {
    /// Serialises the model. The estimator that fitted the model can load these bytes on every machine.
    ///
    /// # Errors
    /// [`ModelError`] if the model cannot be serialised.
    fn save(&self) -> Result<Vec<u8>, ModelError>;
}

/// A saved model: bytes in the format of its estimator, with its channels and the shape of its features.
///
/// ```
/// use taceva_core::{Channel, Channels, FeatureShape, Saved};
/// let channels = Channels::new([Channel::FZ])?;
/// let bytes = 0.5_f64.to_le_bytes();
/// let saved = Saved::new(&bytes, &channels, FeatureShape::flat(1));
/// assert_eq!(saved.bytes.len(), 8);
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Saved<'a> {
    /// Bytes from [`SavedRegressor::save`].
    pub bytes: &'a [u8],
    /// Channels that the model predicts.
    pub channels: &'a Channels,
    /// Shape of the features that the model takes.
    pub shape: FeatureShape,
}

impl<'a> Saved<'a> {
    /// A saved model from its `bytes`. The model predicts `channels` from features of `shape`.
    pub const fn new(bytes: &'a [u8], channels: &'a Channels, shape: FeatureShape) -> Saved<'a> {
        Saved {
            bytes,
            channels,
            shape,
        }
    }
}
