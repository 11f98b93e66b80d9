//! What a model promises: an [`Estimator`] is fitted and gives a [`Regressor`]; the unfitted one cannot predict.

use std::error::Error;
use std::fmt;

use crate::channel::Channels;
use crate::error::ErrorKind;
use crate::progress::Progress;

/// The shape of one sample's features: a small picture, or a flat list. A plain value, which gets no further fields.
///
/// ```
/// use taceva_core::FeatureShape;
/// let picture = FeatureShape { height: 32, width: 32, depth: 3 };
/// assert_eq!((picture.len(), FeatureShape::flat(20).len()), (3072, 20));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FeatureShape {
    /// Rows; 1 for a flat list.
    pub height: usize,
    /// Columns; the length of a flat list.
    pub width: usize,
    /// Numbers a place: 1 for gray and for a flat list, 3 for RGB.
    pub depth: usize,
}

impl FeatureShape {
    /// A flat list of `length` numbers.
    pub const fn flat(length: usize) -> FeatureShape {
        FeatureShape {
            height: 1,
            width: length,
            depth: 1,
        }
    }

    /// Numbers a sample.
    pub const fn len(&self) -> usize {
        self.height * self.width * self.depth
    }

    /// Whether a sample has no number.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The features of some samples, sample by sample.
///
/// # Shapes
/// `[samples, height, width, depth]`, contiguous.
///
/// ```
/// use taceva_core::{FeatureShape, Features};
/// let features = Features::new(FeatureShape::flat(2), vec![0.1, 0.2, 0.3, 0.4])?;
/// assert_eq!((features.samples(), features.sample(1)), (2, &[0.3, 0.4][..]));
/// # Ok::<(), taceva_core::ModelError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Features {
    shape: FeatureShape,
    values: Vec<f32>,
}

impl Features {
    /// Features of `shape`; the number of samples follows from the number of values.
    ///
    /// # Errors
    /// [`ModelError`] if the values are no whole number of samples.
    pub fn new(shape: FeatureShape, values: Vec<f32>) -> Result<Features, ModelError> {
        let whole = match shape.len() {
            0 => values.is_empty(),
            length => values.len() % length == 0,
        };
        if !whole {
            let message = format!(
                "{} values are no whole number of samples of {}",
                values.len(),
                shape.len()
            );
            return Err(ModelError::new(ErrorKind::InvalidArgument, message));
        }
        Ok(Features { shape, values })
    }

    /// The shape of one sample.
    pub fn shape(&self) -> FeatureShape {
        self.shape
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        match self.shape.len() {
            0 => 0,
            length => self.values.len() / length,
        }
    }

    /// All values.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The values of one sample.
    pub fn sample(&self, position: usize) -> &[f32] {
        let length = self.shape.len();
        &self.values[position * length..(position + 1) * length]
    }

    /// The samples at `positions`, in that order.
    pub fn select(&self, positions: &[usize]) -> Features {
        let values = positions
            .iter()
            .flat_map(|&position| self.sample(position))
            .copied()
            .collect();
        Features {
            shape: self.shape,
            values,
        }
    }
}

/// What should be predicted, sample by sample.
///
/// # Shapes
/// `values`: `[samples, channels]`.
///
/// ```
/// use taceva_core::{Channel, Channels, Targets};
/// let channels = Channels::new([Channel::PZ, Channel::FZ])?;
/// let targets = Targets::new(&channels, &[0.5, 1.0, 0.7, 1.6]);
/// assert_eq!(targets.values.len(), 2 * channels.len());
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Targets<'a> {
    /// What each column means.
    pub channels: &'a Channels,
    /// Every value is finite.
    pub values: &'a [f64],
}

impl<'a> Targets<'a> {
    /// A value of each of `channels`, sample by sample; an estimator refuses `values` of another length than its features have samples.
    pub const fn new(channels: &'a Channels, values: &'a [f64]) -> Targets<'a> {
        Targets { channels, values }
    }
}

/// Samples to learn from, or to choose settings by.
///
/// ```
/// use taceva_core::{Channel, Channels, FeatureShape, Features, Targets, TrainingSet};
/// let channels = Channels::new([Channel::FZ])?;
/// let features = Features::new(FeatureShape::flat(2), vec![0.1, 0.2, 0.3, 0.4])?;
/// let targets = Targets::new(&channels, &[1.0, 1.6]);
/// let training = TrainingSet::new(&features, targets).with_groups(&[0, 1][..]);
/// assert_eq!(training.groups, Some(&[0, 1][..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct TrainingSet<'a> {
    /// What is seen.
    pub features: &'a Features,
    /// What is true.
    pub targets: Targets<'a>,
    /// Which samples belong together, a number a sample; for settings chosen by leaving one group out.
    pub groups: Option<&'a [u32]>,
}

impl<'a> TrainingSet<'a> {
    /// Samples of which nobody says which belong together.
    pub const fn new(features: &'a Features, targets: Targets<'a>) -> TrainingSet<'a> {
        TrainingSet {
            features,
            targets,
            groups: None,
        }
    }

    /// The same samples with the group of each.
    #[must_use]
    pub fn with_groups(self, groups: impl Into<Option<&'a [u32]>>) -> TrainingSet<'a> {
        TrainingSet {
            groups: groups.into(),
            ..self
        }
    }
}

/// A model with its settings, not fitted yet.
///
/// ```
/// use taceva_core::{
///     Channel, Channels, Estimator, FeatureShape, Features, ModelError, Progress, Regressor, SilentProgress, Targets, TrainingSet,
/// };
///
/// /// Predicts the means of what it was fitted on.
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
    /// The name by which people choose it: `ridge`, or the key of a plugin's.
    fn name(&self) -> &str;

    /// Learns from `training`; settings left open are chosen on `validation`, where there is one.
    ///
    /// # Errors
    /// [`ModelError`] if the sets do not fit each other, nothing can be learnt from them, or `progress` was cancelled.
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
/// /// A force in proportion to how bright the picture is.
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
    /// What it predicts.
    fn channels(&self) -> &Channels;

    /// The shape of features it takes.
    fn shape(&self) -> FeatureShape;

    /// Predicts every sample of `features`.
    ///
    /// # Shapes
    /// `into`: `[samples, channels]`, the caller's.
    /// # Errors
    /// [`ModelError`] if a shape differs, or a prediction is not finite.
    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError>;
}

/// A fitted model that can be kept as bytes of its own: that of a plugin.
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
    /// The model as bytes from which its maker loads it again, on every machine.
    ///
    /// # Errors
    /// [`ModelError`] if it cannot be written.
    fn save(&self) -> Result<Vec<u8>, ModelError>;
}

/// A model as it was kept: its bytes are its maker's, what it takes and gives is ours.
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
    /// What [`SavedRegressor::save`] gave.
    pub bytes: &'a [u8],
    /// What it predicts.
    pub channels: &'a Channels,
    /// The shape of features it takes.
    pub shape: FeatureShape,
}

impl<'a> Saved<'a> {
    /// The `bytes` of a model that predicts `channels` from features of `shape`.
    pub const fn new(bytes: &'a [u8], channels: &'a Channels, shape: FeatureShape) -> Saved<'a> {
        Saved {
            bytes,
            channels,
            shape,
        }
    }
}

/// Why a model could not be fitted or used.
///
/// ```
/// use taceva_core::{ErrorKind, ModelError};
/// let error = ModelError::new(ErrorKind::InvalidArgument, "cannot fit `ridge`: 1 sample, expected at least 2");
/// assert_eq!(error.kind(), ErrorKind::InvalidArgument);
/// ```
#[derive(Debug)]
pub struct ModelError {
    kind: ErrorKind,
    message: String,
    source: Option<Box<dyn Error + Send + Sync>>,
}

impl ModelError {
    /// An error of `kind` that says what was being done and on what.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> ModelError {
        ModelError {
            kind,
            message: message.into(),
            source: None,
        }
    }

    /// The same error with what caused it.
    #[must_use]
    pub fn because(mut self, source: impl Into<Box<dyn Error + Send + Sync>>) -> ModelError {
        self.source = Some(source.into());
        self
    }

    /// What kind of failure it was.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for ModelError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.source
            .as_deref()
            .map(|source| source as &(dyn Error + 'static))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selected_samples_come_in_the_order_asked_for() {
        let features = Features::new(FeatureShape::flat(2), vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0])
            .expect("three samples");
        assert_eq!(features.select(&[2, 0]).values(), [4.0, 5.0, 0.0, 1.0]);
    }

    #[test]
    fn a_broken_sample_is_refused() {
        let error =
            Features::new(FeatureShape::flat(2), vec![0.0; 3]).expect_err("one and a half samples");
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    }
}
