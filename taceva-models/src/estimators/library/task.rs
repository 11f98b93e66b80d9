//! What a library gets, and what it gives back.

use taceva_core::{ModelError, Progress};

use crate::training::file::tensors::Raw;

/// Sizes that a model of a library is fitted on, or was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LibrarySizes {
    /// Training samples; 0 for a model that is read back.
    pub(crate) samples: usize,
    /// Features that vary over them.
    pub(crate) features: usize,
    /// Channels whose labels vary over them.
    pub(crate) targets: usize,
}

/// What a library gets: features that all vary, labels that all vary, every number finite.
#[derive(Clone, Copy)]
pub(crate) struct LibraryTask<'a> {
    /// How many samples, features and targets.
    pub(crate) sizes: LibrarySizes,
    /// `[samples, features]`, centred and scaled; each is exactly a single-precision number.
    pub(crate) rows: &'a [f64],
    /// `[samples, targets]`: labels scaled to 0..1 by the training part and centred; as they are where they are classes.
    pub(crate) labels: &'a [f64],
    /// `[targets]`: the value of the setting that is chosen, for each target; empty where there is none.
    pub(crate) values: &'a [f64],
    /// Receives progress, and may cancel between calls of the library.
    pub(crate) progress: &'a dyn Progress,
}

impl LibraryTask<'_> {
    /// The labels of one target, sample by sample.
    pub(crate) fn target(&self, target: usize) -> Vec<f64> {
        let labels = self.labels.iter().skip(target);
        labels.step_by(self.sizes.targets.max(1)).copied().collect()
    }
}

/// Fitted parameters of a library's estimator, and how they predict.
pub(crate) trait LibraryPredictor: Send + Sync {
    /// What a file keeps of it; [`LibraryModel::load`](crate::LibraryModel::load) makes the same predictor of them, to the bit.
    fn tensors(&self) -> Vec<Raw>;

    /// Predicts one sample.
    ///
    /// # Shapes
    /// `sample`: `[features]`, as the rows of [`LibraryTask`]; `into`: `[targets]`, in the labels of the task.
    /// # Errors
    /// [`ModelError`] if the library refuses or panics.
    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError>;
}

/// A predictor that is read back, or why tensors are none.
pub(crate) type LoadedPredictor = Result<Box<dyn LibraryPredictor>, ModelError>;
