//! Samples behind a result: truth, predictions and covariates.

use std::collections::BTreeMap;

use taceva_core::{Channel, Column, Field};
use taceva_dataset::Dataset;
use taceva_results::Samples;

use crate::error::EvaluateError;
use crate::predict::{Predicted, truth};
use crate::recordings;
use crate::rows::{BESIDE_CHANNELS, Divided};

/// Samples of `rows` of `dataset`, in that order, without predictions.
pub fn of(dataset: &Dataset, rows: &[usize]) -> Result<Samples, EvaluateError> {
    let table = dataset.table();
    let ids = rows
        .iter()
        .map(|&row| Some(table.samples()[row].clone()))
        .collect();
    let mut samples = Samples::new(ids, recordings::paths(dataset));
    if let Some(names) = recordings::names(dataset, rows) {
        samples.push_words("recording", names.into_iter().map(Some).collect());
    }
    for field in BESIDE_CHANNELS {
        if let Some(texts) = table.as_text(field.name()) {
            let words = rows.iter().map(|&row| texts[row].clone());
            samples.push_words(field.name(), words.collect());
        }
    }
    let zeros = table.zero_u_mm();
    let has_depths = table.channels().position("Pz").is_some();
    if has_depths && rows.iter().any(|&row| zeros[row].is_some()) {
        let mut column = Column::default();
        rows.iter().for_each(|&row| column.push(zeros[row]));
        samples.push_numbers(Samples::ZERO_U, column);
    }
    for channel in table.channels().iter() {
        samples.push_numbers(channel.name(), truth(dataset, channel, rows)?);
    }
    Ok(samples)
}

/// Adds the group and the fold of each of `rows`, if `divided` makes groups or folds.
pub fn add_division(samples: &mut Samples, rows: &[usize], divided: &Divided) {
    if let Some(groups) = &divided.groups {
        let words = rows.iter().map(|&row| Some(groups[row].clone()));
        samples.push_words(Samples::GROUP, words.collect());
    }
    if !divided.folds.is_empty() {
        let mut fold: BTreeMap<usize, String> = BTreeMap::new();
        for (number, tested) in (1_usize..).zip(&divided.folds) {
            fold.extend(tested.iter().map(|&row| (row, number.to_string())));
        }
        let words = rows.iter().map(|row| fold.get(row).cloned());
        samples.push_words(Samples::FOLD, words.collect());
    }
}

/// Protocol phases of each of `rows`, such as `calibration light-sweep`; an empty text for a row in no phase.
pub fn protocol(rows: &[usize], parts: &BTreeMap<&'static str, Vec<usize>>) -> Vec<Option<String>> {
    let words = rows.iter().map(|row| {
        let of_row = parts
            .iter()
            .filter(|(_, rows)| rows.binary_search(row).is_ok());
        Some(of_row.map(|(part, _)| *part).collect::<Vec<_>>().join(" "))
    });
    words.collect()
}

/// Adds predictions of `of_rows`, a subset of `rows`, to the samples of `rows`.
///
/// If a prediction was clipped to the bounds of the model, a second column contains the unclipped value, which some metrics read.
pub fn add_predictions(
    samples: &mut Samples,
    rows: &[usize],
    predicted: &Predicted,
    of_rows: &[usize],
) {
    let at: Vec<Option<usize>> = rows
        .iter()
        .map(|row| of_rows.binary_search(row).ok())
        .collect();
    let spread = |numbers: &Column| {
        let mut column = Column::default();
        at.iter()
            .for_each(|at| column.push(at.and_then(|at| numbers.get(at))));
        column
    };
    let both = predicted.prediction().iter().zip(predicted.unbounded());
    for (channel, (bounded, unbounded)) in predicted.channels().iter().zip(both) {
        let (bounded, unbounded) = (spread(bounded), spread(unbounded));
        let is_cut = bounded != unbounded;
        samples.push_prediction(channel, bounded);
        if is_cut {
            samples.push_unbounded(channel, unbounded);
        }
    }
}

/// Samples with the names `ids`, from two columns for each channel: truth and prediction.
pub(crate) fn of_pairs(
    ids: Vec<Option<String>>,
    points: Option<Vec<Option<String>>>,
    channels: impl IntoIterator<Item = (Channel, Column, Column)>,
) -> Samples {
    let mut samples = Samples::new(ids, Vec::new());
    if let Some(points) = points {
        samples.push_words(Field::Point.name(), points);
    }
    for (channel, truth, prediction) in channels {
        samples.push_numbers(channel.name(), truth);
        samples.push_prediction(&channel, prediction);
    }
    samples
}
