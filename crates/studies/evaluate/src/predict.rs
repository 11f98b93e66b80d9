//! The prediction stage.

mod csv_tables;
mod predictions;
mod predictor;
mod target;
mod task_cells;

use taceva_core::{Channel, Column, Features, Field, Input, InputInfo, shown};
use taceva_dataset::Dataset;
use taceva_models::{Extractor, FeatureError, Model};

use crate::error::EvaluateError;
use crate::features::{Sight, blank, extract_as, rows_read};
use crate::grouping::Grouping;
use crate::rows::{BESIDE_CHANNELS, DataPart};
use crate::work::Work;

pub use predictions::{AtBound, Predicted};
pub use predictor::Predictor;
pub use target::Target;
use task_cells::TaskCells;

/// Predicts a part of `dataset`. The default is the unseen data: the test part of the model's own dataset, or all rows of any other dataset. Each prediction
/// includes the distance of its frame from the training part, if the model computes it.
///
/// # Errors
/// [`EvaluateError`] if the model cannot be used on the dataset, or the dataset cannot be read.
pub fn predict(
    dataset: &Dataset,
    model: &Model,
    part: Option<DataPart>,
    work: Work<'_>,
) -> Result<Predicted, EvaluateError> {
    let target = Target::new(dataset, model, part)?;
    let features = features_of(dataset, model, &target, work)?;
    let predicted = predict_features(dataset, model, &target, &features)?;
    Ok(Predicted {
        distance: model.distances(&features)?,
        points: predicted.points.or_else(|| groups(dataset, &target)),
        ..predicted
    })
}

/// Group of each row of `target`, from the split of the model, or else from a column of groups. A group replaces a missing contact point.
fn groups(dataset: &Dataset, target: &Target) -> Option<Vec<String>> {
    let divided = target.divided.as_ref();
    if let Some(groups) = divided.and_then(|divided| divided.groups.as_ref()) {
        return Some(target.rows.iter().map(|&row| groups[row].clone()).collect());
    }
    let Grouping::Column(name) = Grouping::of(dataset, &dataset.all_rows()) else {
        return None;
    };
    let cells = dataset.table().as_text(&name)?;
    target.rows.iter().map(|&row| cells[row].clone()).collect()
}

/// Predictions of `model` for the rows of `target`, clipped to the bounds of the model, and unclipped.
///
/// # Errors
/// [`EvaluateError`] if the model cannot be used on the dataset, or the dataset cannot be read.
pub fn predict_target(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Predicted, EvaluateError> {
    let features = features_of(dataset, model, target, work)?;
    predict_features(dataset, model, target, &features)
}

/// Predictions of `model` from the features of the rows of `target`.
fn predict_features(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    features: &Features,
) -> Result<Predicted, EvaluateError> {
    let numbers = numbers_of(model, features)?;
    Ok(Predicted {
        task: TaskCells::of(dataset, model, features, &target.rows)?,
        frames_decoded: frames_decoded(dataset, model, &target.rows)?,
        ..predicted_table(dataset, Predictor::of(model), target, &numbers)?
    })
}

/// Number of frames decoded to predict `rows`.
fn frames_decoded(dataset: &Dataset, model: &Model, rows: &[usize]) -> Result<u64, EvaluateError> {
    Ok(match model.reads_frames() {
        true => rows_read_by(dataset, model, rows)?.len() as u64,
        false => 0,
    })
}

/// Unclipped predictions of `model` for the rows of `target`, and standard deviations if the model predicts them.
///
/// # Shapes
/// Predictions: `[rows, channels]`, row by row. Standard deviations: the same order, or empty.
pub fn predicted_numbers(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Column, EvaluateError> {
    numbers_of(model, &features_of(dataset, model, target, work)?)
}

/// Features of the rows of `target`; blank features for a model that reads no features.
fn features_of(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Features, EvaluateError> {
    let rows = &target.rows;
    match model.reads_features() {
        true => extract_as(
            dataset,
            &model.card().features,
            clusters_of(model),
            |recording| extractor_of(recording, model, Model::frame_extractor),
            rows,
            work,
        ),
        false => blank(model.card().features.shape(), rows.len()),
    }
}

/// Column with the clusters that windows of frames of a model never cross; `None` for a model without a task.
fn clusters_of(model: &Model) -> Option<&str> {
    let task = model.card().provenance.task.as_ref();
    task.map(|task| task.cluster.as_str())
}

/// Rows whose inputs `model` reads to predict `rows`: these rows, or all rows of their windows of frames.
///
/// # Errors
/// [`EvaluateError::Request`] for a row without a cluster.
pub(crate) fn rows_read_by(
    dataset: &Dataset,
    model: &Model,
    rows: &[usize],
) -> Result<Vec<usize>, EvaluateError> {
    rows_read(dataset, &model.card().features, clusters_of(model), rows)
}

fn numbers_of(model: &Model, features: &Features) -> Result<Column, EvaluateError> {
    let mut numbers = model.predict_unbounded(features)?;
    numbers.extend(model.deviations(features)?.into_iter().flatten());
    Ok(Column::full(numbers))
}

/// Extractor of a fitted model on the frames or signals of `dataset`.
pub fn model_extractor(dataset: &Dataset, model: &Model) -> Result<Extractor, EvaluateError> {
    extractor_of(dataset, model, Model::extractor)
}

/// Function that creates an extractor of a model from the input and the contact-free reference.
type Build = fn(&Model, InputInfo, Option<Input<'_>>) -> Result<Extractor, FeatureError>;

fn extractor_of(
    dataset: &Dataset,
    model: &Model,
    build: Build,
) -> Result<Extractor, EvaluateError> {
    let sight = Sight::of(dataset, &model.card().features)?;
    let sight = sight.map_err(|absent| {
        EvaluateError::Unsuited(format!("the model needs {absent}, which the dataset lacks"))
    })?;
    let extractor = build(model, sight.info(), sight.reference());
    extractor.map_err(|error| match error {
        FeatureError::Kind { expected, found } => EvaluateError::Unsuited(format!(
            "{} has frames of {found}, but the model was fitted on frames of {expected}; import pictures of the size and format of the model, or fit \
             a model on these pictures",
            shown(&dataset.path())
        )),
        error => error.into(),
    })
}

/// Combines predicted numbers with the labels of the same rows.
pub fn predicted_table(
    dataset: &Dataset,
    predictor: Predictor,
    target: &Target,
    numbers: &Column,
) -> Result<Predicted, EvaluateError> {
    let rows = &target.rows;
    let channels = predictor.channels;
    let width = channels.len();
    let columns = |numbers: &[f64]| -> Vec<Column> {
        let column = |position: usize| numbers.iter().skip(position).step_by(width).copied();
        let columns = (0..width).map(|position| Column::full(column(position).collect()));
        columns.collect()
    };
    let (numbers, deviations) = numbers.values().split_at(rows.len() * width);
    let mut bounded = numbers.to_vec();
    predictor.bounds.bound(&mut bounded);
    let points: Option<Vec<String>> = rows
        .iter()
        .map(|&row| dataset.table().point_id()[row].clone())
        .collect();
    Ok(Predicted {
        part: target.part,
        ids: rows
            .iter()
            .map(|&row| dataset.table().samples()[row].clone())
            .collect(),
        points,
        beside: beside(dataset, rows),
        truth: channels
            .iter()
            .map(|channel| truth(dataset, channel, rows))
            .collect::<Result<_, _>>()?,
        prediction: columns(&bounded),
        unbounded: columns(numbers),
        deviation: (!deviations.is_empty()).then(|| columns(deviations)),
        beyond: (0..width)
            .map(|position| {
                let own = numbers.iter().skip(position).step_by(width);
                own.map(|value| predictor.bounds.is_beyond(position, *value))
                    .collect()
            })
            .collect(),
        distance: None,
        task: None,
        constants: predictor.constants,
        frames_decoded: if predictor.reads_frames {
            rows.len() as u64
        } else {
            0
        },
        left_out: target.left_out,
        channels,
    })
}

/// Columns of `rows` that `score` can read, except contact points and channels.
fn beside(dataset: &Dataset, rows: &[usize]) -> Vec<(&'static str, Vec<Option<String>>)> {
    let column = |field: Field| {
        let texts = dataset.table().as_text(field.name())?;
        Some((
            field.name(),
            rows.iter().map(|&row| texts[row].clone()).collect(),
        ))
    };
    // Contact points have their own column.
    let others = BESIDE_CHANNELS
        .into_iter()
        .filter(|field| *field != Field::Point);
    others.filter_map(column).collect()
}

/// Truth of `rows`. A channel that the dataset lacks is undefined in every row.
pub fn truth(
    dataset: &Dataset,
    channel: &Channel,
    rows: &[usize],
) -> Result<Column, EvaluateError> {
    let table = dataset.table();
    let known = table.channels().by_name(channel.name());
    if let Some(known) = known.filter(|known| known.unit() != channel.unit()) {
        return Err(EvaluateError::Unsuited(format!(
            "the model predicts {channel} in {}, but the dataset has it in {}",
            channel.unit(),
            known.unit()
        )));
    }
    let position = table.channels().position(channel.name());
    let mut column = Column::default();
    rows.iter()
        .for_each(|&row| column.push(position.and_then(|position| table.truth(position).get(row))));
    Ok(column)
}
