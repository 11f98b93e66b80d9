//! Input of a model fit.

use taceva_core::{InputInfo, TrainingSet};

use crate::features::FeatureSpec;
use crate::settings::ModelSettings;
use crate::training::card::Provenance;
use crate::training::fit::ModelEstimator;

/// Estimator, samples and provenance for a fit.
pub struct FitInput<'a> {
    /// Unfitted model.
    pub estimator: &'a dyn ModelEstimator,
    /// Settings of the model, as the user typed them.
    pub settings: &'a ModelSettings,
    /// Features of the model.
    pub features: FeatureSpec,
    /// Source of the features: frames of one kind, or signals of one grid.
    pub input: InputInfo,
    /// Training part, with features of an [`Extractor`](crate::Extractor). Principal components are computed later.
    pub training: TrainingSet<'a>,
    /// Validation part, on which settings are chosen; `None` without this part.
    pub validation: Option<TrainingSet<'a>>,
    /// Provenance of the samples.
    pub provenance: Provenance,
}
