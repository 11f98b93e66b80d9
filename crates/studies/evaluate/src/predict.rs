//! The stage that predicts.

mod csv_tables;
mod predictions;
mod predictor;
mod table;
mod target;

use taceva_core::Column;
use taceva_dataset::Dataset;
use taceva_models::Model;

use crate::error::EvaluateError;
use crate::features::{Sight, blank, extract};
use crate::rows::DataPart;
use crate::work::Work;

pub use predictions::Predicted;
pub use predictor::Predictor;
pub use table::{predicted_table, truth};
pub use target::Target;

/// Predicts a part of `dataset`; by default what the model has not seen: the test part of its own dataset, all of another.
///
/// # Errors
/// [`EvaluateError`] if the model does not fit the dataset, or the dataset cannot be read.
pub fn predict(
    dataset: &Dataset,
    model: &Model,
    part: Option<DataPart>,
    work: Work<'_>,
) -> Result<Predicted, EvaluateError> {
    let target = Target::new(dataset, model, part)?;
    predict_target(dataset, model, &target, work)
}

/// Predictions of `model` for the rows of `target`, within the bounds of the model and as it gives them.
///
/// # Errors
/// [`EvaluateError`] if the model does not fit the dataset, or the dataset cannot be read.
pub fn predict_target(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Predicted, EvaluateError> {
    let numbers = predicted_numbers(dataset, model, target, work)?;
    predicted_table(dataset, Predictor::of(model), target, &numbers)
}

/// Predictions of `model` for the rows of `target`, not clipped to its bounds, and standard deviations where the model gives them.
///
/// # Shapes
/// `[rows, channels]`, row after row; behind it standard deviations in the same order, or nothing.
pub fn predicted_numbers(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Column, EvaluateError> {
    let rows = &target.rows;
    let features = if model.reads_features() {
        extract(
            dataset,
            |recording| model_extractor(recording, model),
            rows,
            work,
        )?
    } else {
        blank(model.card().features.shape(), rows.len())?
    };
    let mut numbers = model.predict_unbounded(&features)?;
    numbers.extend(model.deviations(&features)?.into_iter().flatten());
    Ok(Column::full(numbers))
}

/// The extractor of a fitted model on the frames, or the signals, of `dataset`.
pub fn model_extractor(
    dataset: &Dataset,
    model: &Model,
) -> Result<taceva_models::Extractor, EvaluateError> {
    let sight = Sight::of(dataset, &model.card().features)?;
    let sight = sight.map_err(|absent| {
        EvaluateError::Unsuited(format!("the dataset has no {absent}, the model needs them"))
    })?;
    Ok(model.extractor(sight.info(), sight.reference())?)
}
