//! Features of some rows, for a caller's own model.

use taceva_core::Features;
use taceva_dataset::Dataset;
use taceva_models::{FeatureSpec, ModelSettings};

use super::{extract_as, extractor, kinds};
use crate::error::EvaluateError;
use crate::work::Work;

/// Features of some rows, with their specification.
#[derive(Debug)]
pub struct FeatureTable {
    /// Features, shape `[rows, height, width, depth]`.
    pub features: Features,
    /// Specification of the features of each row.
    pub spec: FeatureSpec,
}

/// Features of `rows`, in this order, by `settings`; the default is 32×32 gray. A built-in model with these settings reads the same features.
///
/// # Errors
/// [`EvaluateError`] for an unknown setting of features, for rows without a frame or without signals, and if the dataset cannot be read.
pub fn feature_table(
    dataset: &Dataset,
    settings: &ModelSettings,
    rows: &[usize],
    work: Work<'_>,
) -> Result<FeatureTable, EvaluateError> {
    let (frame, signals) = kinds(dataset);
    let asked = FeatureSpec::DEFAULT.changed_by(settings)?;
    let spec = match (frame, signals) {
        (None, Some(info)) => asked.of_signals(info),
        _ => asked,
    };
    let clusters = dataset.labelled_by().map(|task| task.cluster.as_str());
    let of = |recording: &Dataset| extractor(recording, spec);
    let features = extract_as(dataset, &spec, clusters, of, rows, work)?;
    Ok(FeatureTable { features, spec })
}
