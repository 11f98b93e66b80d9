//! The stage that predicts.

mod predicted;
mod predictor;
mod table;
mod target;
mod write;

use taceva_core::Column;
use taceva_dataset::Dataset;
use taceva_models::Model;

use crate::error::StudyError;
use crate::features::{Sight, blank, extract};
use crate::rows::DataPart;
use crate::work::Work;

pub use predicted::Predicted;
pub(crate) use predictor::Predictor;
pub(crate) use table::{table, truth};
pub(crate) use target::Target;

/// Predicts a part of `dataset`; by default what the model has not seen: the test part of its own dataset, all of another.
///
/// # Errors
/// [`StudyError`] if the model does not fit the dataset, or the dataset cannot be read.
pub fn predict(
    dataset: &Dataset,
    model: &Model,
    part: Option<DataPart>,
    work: Work<'_>,
) -> Result<Predicted, StudyError> {
    let target = Target::new(dataset, model, part)?;
    run(dataset, model, &target, work)
}

pub(crate) fn run(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Predicted, StudyError> {
    let numbers = numbers(dataset, model, target, work)?;
    table(dataset, Predictor::of(model), target, &numbers)
}

/// Predictions of `model` for the rows of `target`, not clipped to its bounds, and standard deviations where the model gives them.
///
/// # Shapes
/// `[rows, channels]`, row after row; behind it standard deviations in the same order, or nothing.
pub(crate) fn numbers(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Column, StudyError> {
    let rows = &target.rows;
    let features = if model.reads_features() {
        extract(dataset, |recording| extractor(recording, model), rows, work)?
    } else {
        blank(model.card().features.shape(), rows.len())?
    };
    let mut numbers = model.predict_unbounded(&features)?;
    numbers.extend(model.deviations(&features)?.into_iter().flatten());
    Ok(Column::full(numbers))
}

/// The extractor of a fitted model on the frames, or the signals, of `dataset`.
pub(crate) fn extractor(
    dataset: &Dataset,
    model: &Model,
) -> Result<taceva_models::Extractor, StudyError> {
    let sight = Sight::of(dataset, &model.card().features)?;
    let sight = sight.map_err(|absent| {
        StudyError::Unsuited(format!("the dataset has no {absent}, the model needs them"))
    })?;
    Ok(model.extractor(sight.info(), sight.reference())?)
}
