//! Compares labels and predictions in a table of samples with a recording and a model file.

mod beside_channels;

use std::path::{Path, PathBuf};

use taceva_core::{Channel, FeatureShape, counted, shown};
use taceva_dataset::Dataset;
use taceva_models::{FormatError, Model, ModelFileError, Models, library_models};
use taceva_results::{Provenance, SampleChannel, Samples};

use crate::error::EvaluateError;
use crate::predict::{Predicted, Predictor, Target, predicted_numbers, predicted_table};
use crate::rows::DataPart;
use crate::work::Work;
use beside_channels::other_columns;

/// Greatest allowed difference of predictions on two instruction sets, as a share of the label range.
const NEAR: f64 = 1e-5;
/// Maximum size of the features that an untrusted model file may request, in bytes.
const MOST_FEATURES: u64 = 16 << 30;

/// Outcome of the comparison of a table of samples with a recording and a model.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PredictionCheck {
    /// Labels and predictions are equal, bit for bit.
    Equal {
        /// Number of predicted samples.
        samples: usize,
    },
    /// Labels are equal. Predictions differ no more than between processors with different instruction sets.
    Near {
        /// Greatest difference, as a share of the label range.
        share: f64,
        /// Description of the first difference.
        first: String,
    },
    /// Samples, labels or predictions differ. Contains a description of the first difference.
    Differs(String),
}

/// Compares `samples` with the recording in `datasets`, and with predictions for it by the model file at `model`.
///
/// `provenance`, which belongs to the results, names the recording and the part. No plugin is loaded. If there are several folders, each is one
/// recording, or all are joined.
///
/// # Errors
/// [`EvaluateError::Request`] if no recording has the digest of the results, or if the model needs a plugin. [`EvaluateError::ModelFormat`] for a file that is
/// not a model of this program. Otherwise errors of [`predicted_numbers`].
pub fn check_predictions(
    model: &Path,
    datasets: &[PathBuf],
    provenance: &Provenance,
    samples: &Samples,
    work: Work<'_>,
) -> Result<PredictionCheck, EvaluateError> {
    let dataset = dataset_of(datasets, provenance)?;
    let model = compiled_model(model)?;
    let part = provenance.part.as_deref().map(part_named).transpose()?;
    let planned = part.map(|part| Target::new(&dataset, &model, Some(part)));
    let planned = planned.transpose()?;
    // The table of a run holds every sample, and predictions where a metric reads them.
    let rows = planned
        .as_ref()
        .map_or_else(|| dataset.all_rows(), |target| target.rows.clone());
    let differs = other_samples(&dataset, &rows, samples);
    let differs = differs.or_else(|| other_labels(&dataset, &rows, samples));
    let differs = differs.or_else(|| other_columns(&dataset, &rows, samples));
    if let Some(problem) = differs {
        return Ok(PredictionCheck::Differs(problem));
    }
    let target = planned.unwrap_or_else(|| Target {
        part: DataPart::All,
        rows: predicted_rows(&model, samples),
        divided: None,
        left_out: 0,
    });
    if target.rows.is_empty() {
        let problem = "the model predicts no sample of the table".to_owned();
        return Ok(PredictionCheck::Differs(problem));
    }
    check_features(model.card().features.shape(), target.rows.len())?;
    let numbers = predicted_numbers(&dataset, &model, &target, work)?;
    let predicted = predicted_table(&dataset, Predictor::of(&model), &target, &numbers)?;
    let found = target.rows.iter().map(|row| rows.binary_search(row).ok());
    let lines: Vec<usize> = found.flatten().collect();
    Ok(compared(&dataset, &predicted, &lines, samples))
}

/// Models that are compiled into this program, without plugins.
pub(crate) fn compiled_models() -> Models {
    Models::builtin().with_libraries(library_models())
}

/// Reads the model at `path`. The file is untrusted, so no plugin is loaded for it.
pub(crate) fn compiled_model(path: &Path) -> Result<Model, EvaluateError> {
    compiled_models().open(path).map_err(|error| match error {
        ModelFileError::Format {
            source: FormatError::NoPlugin { id, key },
            ..
        } => EvaluateError::Request(format!(
            "the model was fitted by `{}` of the plugin `{}`, and no plugin is loaded for an untrusted model file; if you trust the model, evaluate the recording by `taceva evaluate --with`",
            shown(&key),
            shown(&id)
        )),
        ModelFileError::Format { source, .. } => EvaluateError::ModelFormat(source),
        error => EvaluateError::Request(error.to_string()),
    })
}

/// Rejects a model whose features of `rows` samples, at four bytes each, would exceed the memory limit.
fn check_features(shape: FeatureShape, rows: usize) -> Result<(), EvaluateError> {
    let bytes = [shape.len(), rows].map(|count| count as u64);
    let bytes = bytes.into_iter().fold(4, u64::saturating_mul);
    match bytes <= MOST_FEATURES {
        true => Ok(()),
        false => Err(EvaluateError::Request(format!(
            "the model reads {bytes} bytes of features of {}, expected at most {MOST_FEATURES}; if you trust the model, evaluate the recording by `taceva evaluate --with`",
            counted(rows, "sample")
        ))),
    }
}

/// The recording whose digest the results state: one of `datasets`, or all of them joined.
pub(crate) fn dataset_of(
    datasets: &[PathBuf],
    provenance: &Provenance,
) -> Result<Dataset, EvaluateError> {
    let stated = provenance.dataset.as_deref().unwrap_or("no recording");
    let (mut found, mut opened) = (Vec::new(), Vec::new());
    for path in datasets {
        let dataset = Dataset::open(path)?;
        let view = provenance.view.as_deref();
        // A recording of another study may lack the view.
        let seen = view.and_then(|view| dataset.seen(view).ok());
        let dataset = seen.unwrap_or(dataset);
        let digest = dataset.digest().to_string();
        if digest == stated {
            return Ok(dataset);
        }
        found.push(digest);
        opened.push(dataset);
    }
    // Recordings of several studies need not join.
    if opened.len() > 1
        && let Ok(joined) = Dataset::joined(opened)
    {
        let digest = joined.digest().to_string();
        if digest == stated {
            return Ok(joined);
        }
        found.push(digest);
    }
    Err(EvaluateError::Request(format!(
        "the recording is {}, and the results are of {}: name that recording by --dataset",
        found.join(", "),
        shown(stated)
    )))
}

pub(crate) fn part_named(name: &str) -> Result<DataPart, EvaluateError> {
    let mut parts = [
        DataPart::Train,
        DataPart::Validation,
        DataPart::Test,
        DataPart::All,
    ]
    .into_iter();
    parts.find(|part| part.name() == name).ok_or_else(|| {
        let name = shown(name);
        EvaluateError::Request(format!(
            "part `{name}` of the results, expected train, validation, test or all"
        ))
    })
}

/// Rows of the table with a prediction of the model. The table also contains rows without a prediction.
fn predicted_rows(model: &Model, samples: &Samples) -> Vec<usize> {
    let channels = model.channels().iter();
    let channels: Vec<SampleChannel<'_>> = channels
        .filter_map(|channel| samples.channel(channel.name()))
        .collect();
    let is_predicted = |row: &usize| {
        let mut channels = channels.iter();
        channels.any(|channel| channel.prediction(*row).is_some())
    };
    (0..samples.rows()).filter(is_predicted).collect()
}

/// Description of the first difference between the samples of the table and `rows` of `dataset`; `None` without a difference.
fn other_samples(dataset: &Dataset, rows: &[usize], samples: &Samples) -> Option<String> {
    if samples.rows() != rows.len() {
        return Some(format!(
            "the table has {}, and the recording has {} of that part",
            counted(samples.rows(), "sample"),
            rows.len()
        ));
    }
    rows.iter().enumerate().find_map(|(at, row)| {
        let found = samples.word(Samples::KEY, at).unwrap_or_default();
        // A joined recording is named after its folder, which may have another name here.
        let (expected, own) = match dataset.recording_of(*row) {
            Some((own, row)) => (
                own.table().samples()[row].as_str(),
                found.split_once('/').map_or("", |(_, own)| own),
            ),
            None => (dataset.table().samples()[*row].as_str(), found),
        };
        (own != expected).then(|| {
            format!(
                "line {} of the table is sample `{}`, and the recording has `{}` there",
                at + 2,
                shown(found),
                shown(expected)
            )
        })
    })
}

/// Description of the first difference between the labels of the table and the labels of `rows` of `dataset`; `None` without a difference.
fn other_labels(dataset: &Dataset, rows: &[usize], samples: &Samples) -> Option<String> {
    let table = dataset.table();
    table
        .channels()
        .iter()
        .enumerate()
        .find_map(|(position, channel)| {
            let (own, labels) = (samples.channel(channel.name()), table.truth(position));
            rows.iter().enumerate().find_map(|(at, row)| {
                let found = own.and_then(|own| own.truth(at));
                let expected = labels.get(*row);
                (!is_same(found, expected)).then(|| {
                    format!(
                        "the label {} in line {}: {} in the table, {} in the recording",
                        channel.name(),
                        at + 2,
                        words(found),
                        words(expected)
                    )
                })
            })
        })
}

/// Compares the predictions in `lines` of the table with `predicted`.
fn compared(
    dataset: &Dataset,
    predicted: &Predicted,
    lines: &[usize],
    samples: &Samples,
) -> PredictionCheck {
    let (mut first, mut differing, mut most) = (None, 0_u64, 0.0_f64);
    for (position, channel) in predicted.channels().iter().enumerate() {
        let own = samples.channel(channel.name());
        let range = label_range(dataset, channel);
        let bounded = &predicted.prediction()[position];
        let unbounded = &predicted.unbounded()[position];
        for (at, &line) in lines.iter().enumerate() {
            let pairs = [
                [own.and_then(|own| own.prediction(line)), bounded.get(at)],
                [samples.unbounded(channel.name(), line), unbounded.get(at)],
            ];
            let mut pairs = pairs.into_iter();
            let Some([found, again]) = pairs.find(|[found, again]| !is_same(*found, *again)) else {
                continue;
            };
            differing += 1;
            // The unclipped prediction differs at least as much as the clipped one, so both are compared.
            for [found, again] in pairs.chain([[found, again]]) {
                most = most.max(share(distance(channel, found, again), range));
            }
            first.get_or_insert_with(|| {
                format!(
                    "{} in line {}: {} in the table, {} by the model",
                    channel.name(),
                    line + 2,
                    words(found),
                    words(again)
                )
            });
        }
    }
    match first {
        None => PredictionCheck::Equal {
            samples: lines.len(),
        },
        Some(first) if most <= NEAR => PredictionCheck::Near { share: most, first },
        Some(first) => PredictionCheck::Differs(format!(
            "{} from the predictions of the model, the first: {first}",
            counted(differing, "difference")
        )),
    }
}

/// Range of the labels of `channel` in the whole recording; 0 without labels.
fn label_range(dataset: &Dataset, channel: &Channel) -> f64 {
    let table = dataset.table();
    let Some(position) = table.channels().position(channel.name()) else {
        return 0.0;
    };
    let labels = table.truth(position);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for label in (0..table.rows()).filter_map(|row| labels.get(row)) {
        (low, high) = (low.min(label), high.max(label));
    }
    (high - low).max(0.0)
}

/// Ratio of `distance` to `range`; infinite if the ratio is not a number, as for a missing prediction.
fn share(distance: f64, range: f64) -> f64 {
    if distance <= 0.0 {
        return 0.0;
    }
    let share = distance / range;
    if share.is_nan() { f64::INFINITY } else { share }
}

/// Distance between two predictions. For an angle with a period, the shorter way around is used.
fn distance(channel: &Channel, one: Option<f64>, other: Option<f64>) -> f64 {
    let (Some(one), Some(other)) = (one, other) else {
        return match one.is_none() && other.is_none() {
            true => 0.0,
            false => f64::INFINITY,
        };
    };
    let distance = (one - other).abs();
    let period = channel.period_in_unit();
    period.map_or(distance, |period| distance.min((period - distance).abs()))
}

fn is_same(one: Option<f64>, other: Option<f64>) -> bool {
    one.map(f64::to_bits) == other.map(f64::to_bits)
}

fn words(number: Option<f64>) -> String {
    number.map_or_else(|| "none".to_owned(), |number| format!("{number:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prediction_that_is_no_number_is_never_near() {
        let to_nan = |one| share(distance(&Channel::FZ, Some(one), Some(f64::NAN)), 1.0);
        assert!(to_nan(0.5) > NEAR);
        assert!(share(1e-9, 0.0) > NEAR);
        assert!(share(0.0, 0.0) <= NEAR);
    }

    #[test]
    fn features_that_would_fill_the_memory_are_refused() {
        let shape = |side| FeatureShape {
            height: side,
            width: side,
            depth: 3,
        };
        assert!(check_features(shape(100), 20_000).is_ok());
        let error = check_features(shape(1024), 20_000).expect_err("240 GB");
        assert!(
            error.to_string().contains("features of 20000 samples"),
            "{error}"
        );
    }
}
