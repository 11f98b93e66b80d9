//! Repeats the fit of a model file on its recording.

use std::path::{Path, PathBuf};

use taceva_models::ModelSettings;
use taceva_results::{Provenance, Samples};

use crate::error::EvaluateError;
use crate::fit::{FitPlan, FitRequest, Recipe};
use crate::predict::{Target, predict_target};
use crate::prediction_check::{compiled_model, compiled_models, dataset_of, part_named};
use crate::rows::Divided;
use crate::samples;
use crate::work::Work;

/// Outcome of a repeated fit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refit {
    /// The repeated fit gives the same model file, byte for byte.
    Equal,
    /// The repeated fit gives another model. Contains its predictions of the scored part.
    Other(Box<Samples>),
}

/// Repeats the fit of the model file at `model` on the recording in `datasets`. Split, seed and settings are read from the model's card.
///
/// `provenance`, which belongs to the results, names the recording and the part. No plugin is loaded.
///
/// # Errors
/// [`EvaluateError::Request`] if no recording has the digest of the results, or the model was fitted on another recording. The same error rejects a
/// model that was fitted on every sample after a cross-validation. Otherwise errors of [`fit`](crate::fit()).
pub fn refit(
    model: &Path,
    datasets: &[PathBuf],
    provenance: &Provenance,
    work: Work<'_>,
) -> Result<Refit, EvaluateError> {
    let part = provenance.part.as_deref().map(part_named).transpose()?;
    let dataset = dataset_of(datasets, provenance)?;
    let model = compiled_model(model)?;
    let card = model.card();
    let divided = Divided::by_model(&dataset, &model)?;
    let divided = divided.filter(|_| card.provenance.validation.is_none());
    let Some(divided) = divided else {
        return Err(EvaluateError::Request(
            "the recording does not repeat the split of the model: the model was fitted on another recording, or on every sample"
                .to_owned(),
        ));
    };
    let channels = model.channels().iter();
    let channels = channels.map(|channel| channel.name().to_owned()).collect();
    let request = FitRequest {
        model: compiled_models().find(&card.model)?,
        settings: ModelSettings::parse(card.settings.iter().map(String::as_str))?,
        channels,
        split: Some(divided.spec.to_string()),
        seed: divided.seed,
    };
    let recipe = Recipe::of(&request)?;
    let again = FitPlan::on(&dataset, &request, recipe, divided)?.run(work)?;
    let again = again.model;
    if again.digest()? == model.digest()? {
        return Ok(Refit::Equal);
    }
    let target = Target::new(&dataset, &again, part)?;
    let predicted = predict_target(&dataset, &again, &target, work)?;
    let rows = &target.rows;
    let mut samples = samples::of(&dataset, rows)?;
    if let Some(divided) = &target.divided {
        samples::add_division(&mut samples, rows, divided);
    }
    samples::add_predictions(&mut samples, rows, &predicted, rows);
    Ok(Refit::Other(Box::new(samples)))
}
