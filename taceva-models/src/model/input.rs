//! All that a model is fitted from.

use taceva_core::{InputInfo, TrainingSet};

use crate::features::FeatureSpec;
use crate::settings::ModelSettings;
use crate::training::card::Provenance;
use crate::training::fit::ModelEstimator;

/// All that a model is fitted from.
pub struct FitInput<'a> {
    /// The model, not fitted yet.
    pub estimator: &'a dyn ModelEstimator,
    /// The settings it was made with, as typed.
    pub settings: &'a ModelSettings,
    /// What it sees of a frame, or of signals.
    pub features: FeatureSpec,
    /// What the features were taken from: frames of a kind, or signals of a grid.
    pub input: InputInfo,
    /// What is learnt from. Its features are those of an [`Extractor`](crate::Extractor); principal components are found here.
    pub training: TrainingSet<'a>,
    /// What settings are chosen by.
    pub validation: Option<TrainingSet<'a>>,
    /// Where the samples come from.
    pub provenance: Provenance,
}
