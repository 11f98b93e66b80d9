//! Factories of models. A factory fits one kind of model and loads the models that it saved.

use crate::args::{ArgSpec, Args};
use crate::id::DriverKey;
use crate::model::{ModelError, Saved, SavedRegressor, TrainingSet};
use crate::progress::Progress;

/// Fits and loads models of one kind. Users select the factory by its key.
///
/// ```
/// use taceva_core::{
///     Args, Channel, Channels, DriverKey, ErrorKind, EstimatorFactory, FeatureShape, Features, FitRequest, ModelError, Regressor,
///     Saved, SavedRegressor, SilentProgress, Targets, TrainingSet,
/// };
///
/// /// Fits the force per step of the first feature.
/// struct Proportional {
///     key: DriverKey,
/// }
///
/// struct Fitted {
///     channels: Channels,
///     factor: f64,
/// }
///
/// impl EstimatorFactory for Proportional {
///     fn key(&self) -> &DriverKey {
///         &self.key
///     }
///     fn title(&self) -> &str {
///         "a line through the origin"
///     }
///     fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
///         let TrainingSet { features, targets, .. } = request.training;
///         let pairs = features.values().iter().zip(targets.values);
///         let (products, squares) = pairs.fold((0.0, 0.0), |(products, squares), (&feature, target)| {
///             let feature = f64::from(feature);
///             (products + feature * target, squares + feature * feature)
///         });
///         let channels = targets.channels.clone();
///         Ok(Box::new(Fitted { channels, factor: products / squares }))
///     }
///     fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
///         let bytes = saved.bytes.try_into();
///         let bytes = bytes.map_err(|_| ModelError::new(ErrorKind::Protocol, "expected 8 bytes"))?;
///         Ok(Box::new(Fitted { channels: saved.channels.clone(), factor: f64::from_le_bytes(bytes) }))
///     }
/// }
/// # impl Regressor for Fitted {
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
/// # impl SavedRegressor for Fitted {
/// #     fn save(&self) -> Result<Vec<u8>, ModelError> {
/// #         Ok(self.factor.to_le_bytes().to_vec())
/// #     }
/// # }
///
/// let channels = Channels::new([Channel::FZ])?;
/// let features = Features::new(FeatureShape::flat(1), vec![1.0, 2.0])?;
/// let training = TrainingSet::new(&features, Targets::new(&channels, &[0.5, 1.0]));
/// let factory = Proportional { key: "org.example/proportional".parse()? };
/// let fitted = factory.fit(&FitRequest::new(&Args::default(), &training, &SilentProgress))?;
/// let bytes = fitted.save()?;
/// let loaded = factory.load(&Saved::new(&bytes, &channels, fitted.shape()))?;
/// let mut forces = [0.0; 2];
/// loaded.predict(&features, &mut forces)?;
/// assert_eq!(forces, [0.5, 1.0]);
/// assert!(factory.load(&Saved::new(b"damaged", &channels, fitted.shape())).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait EstimatorFactory: Send + Sync {
    /// Key by which users select the estimator: the id of the plugin, `/`, and a word.
    fn key(&self) -> &DriverKey;

    /// Title of the estimator in lists, a few words.
    fn title(&self) -> &str;

    /// Declarations of the estimator's settings.
    fn settings(&self) -> &[ArgSpec] {
        &[]
    }

    /// Fits a model to the samples of `request`.
    ///
    /// # Errors
    /// The errors of [`Estimator::fit`](crate::Estimator::fit).
    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError>;

    /// Loads a saved model.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` for damaged or hostile bytes, which this estimator did not save.
    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError>;

    /// Digest of the plugin library with the estimator: `sha256:` and 64 hexadecimal digits. `None` if the estimator is linked into the program.
    ///
    /// # Errors
    /// [`ModelError`] if the library cannot be read.
    fn build(&self) -> Result<Option<String>, ModelError> {
        Ok(None)
    }

    /// Accepts or rejects a saved model; `fitted_by` is the digest of the library that fitted it. An implementation may only warn about another
    /// digest.
    ///
    /// # Errors
    /// [`ModelError`] of kind `PermissionDenied` if only the library that fitted the model may load it.
    fn admit(&self, fitted_by: Option<&str>) -> Result<(), ModelError> {
        let _ = fitted_by;
        Ok(())
    }
}

/// Input of a fit: settings, samples and progress.
///
/// ```
/// use taceva_core::{Args, Channel, Channels, FeatureShape, Features, FitRequest, SilentProgress, Targets, TrainingSet};
/// let channels = Channels::new([Channel::FZ])?;
/// let features = Features::new(FeatureShape::flat(1), vec![1.0, 2.0])?;
/// let training = TrainingSet::new(&features, Targets::new(&channels, &[0.5, 1.0]));
/// let settings = Args::default();
/// let request = FitRequest::new(&settings, &training, &SilentProgress).with_validation(&training);
/// assert!(request.validation.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
pub struct FitRequest<'a> {
    /// Settings, checked against the declarations of the estimator.
    pub settings: &'a Args,
    /// Samples on which the model is fitted.
    pub training: &'a TrainingSet<'a>,
    /// Samples on which settings are chosen; `None` if the request has none.
    pub validation: Option<&'a TrainingSet<'a>>,
    /// Receives the progress of the fit and can cancel the fit.
    pub progress: &'a dyn Progress,
}

impl<'a> FitRequest<'a> {
    /// Request for a fit on `training` without validation samples.
    pub fn new(
        settings: &'a Args,
        training: &'a TrainingSet<'a>,
        progress: &'a dyn Progress,
    ) -> FitRequest<'a> {
        FitRequest {
            settings,
            training,
            validation: None,
            progress,
        }
    }

    /// Adds samples on which settings are chosen.
    #[must_use]
    pub fn with_validation(
        self,
        validation: impl Into<Option<&'a TrainingSet<'a>>>,
    ) -> FitRequest<'a> {
        FitRequest {
            validation: validation.into(),
            ..self
        }
    }
}
