//! From the numbers of a model to predictions, with what the table of the dataset holds of the same rows.

use taceva_core::{Column, Field};
use taceva_dataset::Dataset;

use super::{Predicted, Predictor, Target};
use crate::error::EvaluateError;
use crate::rows::BESIDE_CHANNELS;

/// The numbers of whatever predicted with the labels of the same rows.
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

/// The other columns of the table for `rows` that `score` reads.
fn beside(dataset: &Dataset, rows: &[usize]) -> Vec<(&'static str, Vec<Option<String>>)> {
    let column = |field: Field| {
        let texts = dataset.table().as_text(field.name())?;
        Some((
            field.name(),
            rows.iter().map(|&row| texts[row].clone()).collect(),
        ))
    };
    // Points have a column of their own.
    let others = BESIDE_CHANNELS
        .into_iter()
        .filter(|field| *field != Field::Point);
    others.filter_map(column).collect()
}

/// The truth of `rows`; a channel that the dataset does not have is absent in every row.
pub fn truth(
    dataset: &Dataset,
    channel: &taceva_core::Channel,
    rows: &[usize],
) -> Result<Column, EvaluateError> {
    let table = dataset.table();
    let known = table.channels().by_name(channel.name());
    if let Some(known) = known.filter(|known| known.unit() != channel.unit()) {
        return Err(EvaluateError::Unsuited(format!(
            "the model predicts {channel} in {}, the dataset has it in {}",
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
