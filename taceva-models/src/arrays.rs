//! Fitting and prediction with arrays of the crate `ndarray`.

use std::borrow::Cow;

use ndarray::{Array2, ArrayView2, CowArray, Ix2};
use taceva_core::{
    Channels, ErrorKind, FeatureShape, Features, ModelError, Progress, Regressor, Targets,
    TrainingSet,
};

use crate::training::fit::{ModelEstimator, ModelFit};

/// Converts a matrix of features, one sample per row, to [`Features`]. An owned `f32` matrix in standard layout is moved without a
/// copy. A view or another layout is copied once.
///
/// # Shapes
/// `matrix`: samples × features. Each sample becomes a flat list.
/// # Errors
/// [`ModelError`] if there are samples but no features.
///
/// ```
/// use ndarray::array;
/// use taceva_models::features_of;
/// let matrix = array![[1.0_f32, 2.0], [3.0, 4.0]];
/// assert_eq!(features_of(matrix.t())?.values(), [1.0, 3.0, 2.0, 4.0]);
/// assert_eq!(features_of(matrix)?.samples(), 2);
/// # Ok::<(), taceva_core::ModelError>(())
/// ```
pub fn features_of<'a>(matrix: impl Into<CowArray<'a, f32, Ix2>>) -> Result<Features, ModelError> {
    let matrix = matrix.into();
    let (samples, features) = matrix.dim();
    if features == 0 && samples > 0 {
        return Err(invalid(format!("{samples} samples without features")));
    }
    let whole = matrix.is_standard_layout();
    let values = if whole && matrix.is_owned() {
        let (mut values, offset) = matrix.into_owned().into_raw_vec_and_offset();
        let start = offset.unwrap_or_default();
        values.truncate(start + samples * features);
        values.drain(..start);
        values
    } else {
        matrix.iter().copied().collect()
    };
    Features::new(FeatureShape::flat(features), values)
}

/// Fits any estimator to `ndarray` arrays.
pub trait EstimatorArrays {
    /// Fits a model that predicts `targets` from `features`, one sample per row. Settings without a value from the user are chosen on the training
    /// samples.
    ///
    /// # Shapes
    /// `features`: samples × features, copied once. `targets`: samples × channels, in the order of `channels`, copied only if not in standard layout.
    /// # Units
    /// Targets have the unit of their channel: mm for positions, N for forces.
    /// # Errors
    /// [`ModelError`] if shapes do not match, the data is unsuitable for a fit, or `progress` was cancelled.
    ///
    /// ```
    /// use ndarray::Array2;
    /// use taceva_core::{Channel, Channels, SilentProgress};
    /// use taceva_models::{EstimatorArrays, RegressorArrays, ModelSettings, find};
    /// let features = Array2::from_shape_fn((40, 3), |(row, column)| ((row * (column + 2)) % 7) as f32);
    /// let forces = features.map(|value| f64::from(*value)).sum_axis(ndarray::Axis(1)).insert_axis(ndarray::Axis(1));
    /// let channels = Channels::new([Channel::FZ])?;
    /// let settings = ModelSettings::parse(["refit=false"])?;
    /// let fit = find("ridge")?.estimator(&settings)?.fit_arrays(features.view(), forces.view(), &channels, &SilentProgress)?;
    /// let predicted = fit.regressor.predict_array(features.view())?;
    /// assert_eq!(predicted.dim(), (40, 1));
    /// assert!((&predicted - &forces).iter().all(|error| error.abs() < 0.1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn fit_arrays(
        &self,
        features: ArrayView2<'_, f32>,
        targets: ArrayView2<'_, f64>,
        channels: &Channels,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError>;
}

impl<E: ModelEstimator + ?Sized> EstimatorArrays for E {
    fn fit_arrays(
        &self,
        features: ArrayView2<'_, f32>,
        targets: ArrayView2<'_, f64>,
        channels: &Channels,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let expected = (features.nrows(), channels.len());
        if targets.dim() != expected {
            let (rows, columns) = targets.dim();
            return Err(invalid(format!(
                "targets of {rows} samples and {columns} channels, expected {} and {}",
                expected.0, expected.1
            )));
        }
        let features = features_of(features)?;
        let values = match targets.to_slice() {
            Some(values) => Cow::Borrowed(values),
            None => Cow::Owned(targets.iter().copied().collect()),
        };
        let training = TrainingSet::new(&features, Targets::new(channels, &values));
        self.fit_model(&training, None, progress)
    }
}

/// Predicts `ndarray` arrays with any fitted model.
pub trait RegressorArrays {
    /// Predicts all samples of `features`.
    ///
    /// # Shapes
    /// `features`: samples × features, copied once; returns samples × channels, in the order of the model's channels.
    /// # Units
    /// Units of the channels: mm for positions, N for forces.
    /// # Errors
    /// [`ModelError`] if the number of features differs from the fitted model, or a prediction is not finite.
    ///
    /// ```
    /// use ndarray::{Array2, array};
    /// use taceva_core::{Channel, Channels, SilentProgress};
    /// use taceva_models::{EstimatorArrays, RegressorArrays, ModelSettings, find};
    /// let channels = Channels::new([Channel::FZ])?;
    /// let estimator = find("baseline")?.estimator(&ModelSettings::default())?;
    /// let features = Array2::<f32>::zeros((2, 1));
    /// let fit = estimator.fit_arrays(features.view(), array![[1.0], [3.0]].view(), &channels, &SilentProgress)?;
    /// assert_eq!(fit.regressor.predict_array(features.view())?, array![[2.0], [2.0]]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn predict_array(&self, features: ArrayView2<'_, f32>) -> Result<Array2<f64>, ModelError>;
}

impl<R: Regressor + ?Sized> RegressorArrays for R {
    fn predict_array(&self, features: ArrayView2<'_, f32>) -> Result<Array2<f64>, ModelError> {
        let (rows, found) = features.dim();
        let shape = self.shape();
        if found != shape.len() {
            let expected = shape.len();
            return Err(invalid(format!(
                "samples of {found} features, expected {expected}"
            )));
        }
        let features = Features::new(shape, features.iter().copied().collect())?;
        let mut predicted = Array2::zeros((rows, self.channels().len()));
        if let Some(into) = predicted.as_slice_mut() {
            self.predict(&features, into)?;
        }
        Ok(predicted)
    }
}

fn invalid(message: String) -> ModelError {
    ModelError::new(ErrorKind::InvalidArgument, message)
}
