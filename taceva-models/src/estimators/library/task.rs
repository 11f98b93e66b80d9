//! Input and output of a library fit.

use taceva_core::{ModelError, Progress};

use crate::training::file::tensors::Raw;

/// Numbers of samples, features and targets of a library fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LibrarySizes {
    /// Number of training samples; 0 for a loaded model.
    pub(crate) samples: usize,
    /// Number of varying features.
    pub(crate) features: usize,
    /// Number of channels with varying labels.
    pub(crate) targets: usize,
}

impl LibrarySizes {
    /// Numbers of samples, features and targets as `f64`, for estimates of work.
    pub(crate) fn real(self) -> [f64; 3] {
        [self.samples, self.features, self.targets].map(|size| size as f64)
    }
}

/// Input of a library fit: varying features and labels, all finite.
#[derive(Clone, Copy)]
pub(crate) struct LibraryTask<'a> {
    /// Numbers of samples, features and targets.
    pub(crate) sizes: LibrarySizes,
    /// Feature values, shape `[samples, features]`, centred and scaled. Each value is exact in single precision.
    pub(crate) rows: &'a [f64],
    /// Labels, shape `[samples, targets]`, divided by their range in the training part and centred. Labels of classifiers are unchanged.
    pub(crate) labels: &'a [f64],
    /// Value for each target of the setting that is chosen by held-out error, shape `[targets]`. Empty if the model has no such setting.
    pub(crate) values: &'a [f64],
    /// Progress receiver, which may cancel the fit between library calls.
    pub(crate) progress: &'a dyn Progress,
}

impl LibraryTask<'_> {
    /// Labels of one target, by sample.
    pub(crate) fn target(&self, target: usize) -> Vec<f64> {
        let labels = self.labels.iter().skip(target);
        labels.step_by(self.sizes.targets.max(1)).copied().collect()
    }
}

/// Predictor with the fitted parameters of a library.
pub(crate) trait LibraryPredictor: Send + Sync {
    /// Tensors for a file. [`LibraryModel::load`](crate::LibraryModel::load) restores the same predictor bit by bit.
    fn tensors(&self) -> Vec<Raw>;

    /// Predicts one sample.
    ///
    /// # Shapes
    /// `sample`: `[features]`, scaled like the rows of [`LibraryTask`]; `into`: `[targets]`, scaled like its labels.
    /// # Errors
    /// [`ModelError`] if the library fails or panics.
    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError>;
}

/// Predictor that was built from a fit or a model file, or the error.
pub(crate) type LoadedPredictor = Result<Box<dyn LibraryPredictor>, ModelError>;
