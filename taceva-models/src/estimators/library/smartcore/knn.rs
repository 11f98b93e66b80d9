//! `smartcore/knn` and `smartcore/knn-classifier`: mean or majority label of the nearest training samples, weighted by 1 / distance.

use smartcore::algorithm::neighbour::linear_search::LinearKNNSearch;
use smartcore::metrics::distance::euclidian::Euclidian;
use taceva_core::{ErrorKind, ModelError};

use super::RELEASE;
use crate::estimators::library::adapter::{Adapter, Number, Unset, any, few_labels};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::damaged;
use crate::estimators::library::{
    LibraryModel, LibraryPredictor, LibrarySettings, LibrarySizes, LibraryTask, LibraryTensors,
    LoadedPredictor,
};
use crate::settings::SettingInfo;
use crate::training::file::tensors::Raw;
use crate::training::info::ModelInfo;

const NAME: &str = "smartcore/knn";
const CLASSIFIER_NAME: &str = "smartcore/knn-classifier";

const COUNT: Number = Number {
    info: SettingInfo {
        key: "neighbours",
        accepts: "a whole number from 1 to 1000",
        default: "chosen for each channel",
        about: "number of nearest training samples whose mean is the prediction",
    },
    range: [1.0, 1000.0],
    is_whole: true,
    unset: Unset::ChosenAmong(&COUNTS),
};

/// Candidate numbers of neighbours, ascending. Of numbers with equal errors, the last and greatest number is chosen.
const COUNTS: [f64; 8] = [1.0, 2.0, 3.0, 4.0, 5.0, 8.0, 12.0, 20.0];

/// Nearest neighbours by Euclidean distance, weighted by 1 / distance. If samples have distance 0, all other samples are ignored.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "smartcore: the mean of the nearest training samples",
            &[LibrarySettings::SCALE, COUNT.info, LibrarySettings::REFIT],
            |settings| ADAPTER.estimator(settings),
        ),
        release: RELEASE,
        work: |sizes| {
            let [samples, features, targets] = sizes.real();
            Some(9.0 * targets * samples * samples * features)
        },
        load: |tensors, sizes| Lookup::load(tensors, sizes, Answer::Mean),
    },
    numbers: &[COUNT],
    is_classifier: false,
    check: any,
    fit: |_, task| fit(task, Answer::Mean),
};

/// Predicts the label with the greatest sum of weights 1 / distance among the nearest neighbours. Of equal sums, the smallest label.
pub(super) static CLASSIFIER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            CLASSIFIER_NAME,
            "smartcore: the label that most of the nearest training samples have, for kinds, boards and levels",
            &[LibrarySettings::SCALE, COUNT.info, LibrarySettings::REFIT],
            |settings| CLASSIFIER.estimator(settings),
        ),
        release: RELEASE,
        // Not tried for measured channels.
        work: |_| None,
        load: |tensors, sizes| Lookup::load(tensors, sizes, Answer::Vote),
    },
    numbers: &[COUNT],
    is_classifier: true,
    check: |training| few_labels(CLASSIFIER_NAME, training),
    fit: |_, task| fit(task, Answer::Vote),
};

/// Rule that computes a prediction from the labels of neighbours.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    Mean,
    Vote,
}

/// Training samples in the search structure of the library, with their labels.
struct Lookup {
    search: LinearKNNSearch<Vec<f64>, Euclidian<f64>>,
    features: usize,
    rows: Vec<f32>,
    /// Labels, shape `[samples, targets]`.
    labels: Vec<f64>,
    /// Number of neighbours of each target.
    counts: Vec<u32>,
    answer: Answer,
}

const COUNTS_TENSOR: &str = "counts";
const LABELS: &str = "labels";
const ROWS: &str = "samples";

impl Lookup {
    fn new(
        rows: Vec<f32>,
        features: usize,
        labels: Vec<f64>,
        counts: Vec<u32>,
        answer: Answer,
    ) -> Result<Lookup, ModelError> {
        let samples = rows.chunks_exact(features);
        let samples: Vec<Vec<f64>> = samples
            .map(|row| row.iter().map(|&value| f64::from(value)).collect())
            .collect();
        let search = guarded(NAME, || LinearKNNSearch::new(samples, Euclidian::new()))?;
        Ok(Lookup {
            search,
            features,
            rows,
            labels,
            counts,
            answer,
        })
    }

    fn load(
        tensors: &LibraryTensors<'_>,
        sizes: LibrarySizes,
        answer: Answer,
    ) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        let samples = tensors.rows(ROWS)?;
        let counts = tensors.integers(COUNTS_TENSOR, &[sizes.targets])?;
        let is_met = |count: &u32| *count > 0 && *count as usize <= samples;
        if !counts.iter().all(is_met) {
            return Err(damaged(
                "the number of neighbours is 0, or exceeds the number of samples",
            ));
        }
        let rows = tensors.singles(ROWS, &[samples, sizes.features])?;
        let labels = tensors.doubles(LABELS, &[samples, sizes.targets])?;
        let features = sizes.features;
        Ok(Box::new(Lookup::new(
            rows, features, labels, counts, answer,
        )?))
    }
}

impl LibraryPredictor for Lookup {
    fn tensors(&self) -> Vec<Raw> {
        let targets = self.counts.len();
        let samples = self.labels.len() / targets.max(1);
        vec![
            Raw::integers(COUNTS_TENSOR, vec![targets], &self.counts),
            Raw::doubles(LABELS, vec![samples, targets], &self.labels),
            Raw::singles(ROWS, vec![samples, self.features], &self.rows),
        ]
    }

    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        let asked: Vec<f64> = sample.iter().map(|&value| f64::from(value)).collect();
        let targets = into.len();
        let mut last: Option<(u32, Vec<(usize, f64)>)> = None;
        for (target, place) in into.iter_mut().enumerate() {
            let count = self.counts[target];
            let near = match last.take() {
                Some((known, near)) if known == count => near,
                _ => self.nearest(&asked, count)?,
            };
            let labels = near.iter().map(|(sample, weight)| {
                let label = self.labels[sample * targets + target];
                (label, *weight)
            });
            *place = match self.answer {
                Answer::Mean => mean(labels),
                Answer::Vote => vote(labels),
            };
            last = Some((count, near));
        }
        Ok(())
    }
}

/// Weighted mean of labels. Each item is a label and its weight.
fn mean(labels: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for (label, weight) in labels {
        sum += weight * label;
        total += weight;
    }
    sum / total
}

/// Label with the greatest sum of weights. Each item is a label and its weight. Of equal sums, the smallest label.
fn vote(labels: impl Iterator<Item = (f64, f64)>) -> f64 {
    let mut sums: Vec<(f64, f64)> = Vec::new();
    for (label, weight) in labels {
        match sums
            .iter_mut()
            .find(|(known, _)| known.total_cmp(&label).is_eq())
        {
            Some((_, sum)) => *sum += weight,
            None => sums.push((label, weight)),
        }
    }
    let ahead = |best: (f64, f64), own: (f64, f64)| {
        let is_ahead = own.1 > best.1 || (own.1 >= best.1 && own.0 < best.0);
        if is_ahead { own } else { best }
    };
    let best = sums.into_iter().reduce(ahead);
    best.map_or(f64::NAN, |(label, _)| label)
}

impl Lookup {
    /// Indices of the `count` training samples nearest to the sample `asked`, with their weights, in ascending order.
    fn nearest(&self, asked: &Vec<f64>, count: u32) -> Result<Vec<(usize, f64)>, ModelError> {
        let found = guarded(NAME, || self.search.find(asked, count as usize))?;
        let mut near: Vec<(usize, f64)> = found
            .into_iter()
            .map(|(sample, distance, _)| (sample, distance))
            .collect();
        if near.is_empty() {
            let why = format!("{NAME}: no training sample is at a finite distance");
            return Err(ModelError::new(ErrorKind::OutOfRange, why));
        }
        near.sort_by_key(|(sample, _)| *sample);
        let is_met = near.iter().any(|(_, distance)| *distance <= 0.0);
        for (_, weight) in &mut near {
            *weight = match is_met {
                true => f64::from(u8::from(*weight <= 0.0)),
                false => 1.0 / *weight,
            };
        }
        Ok(near)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole numbers of neighbours, and rows that are single-precision numbers"
)]
fn fit(task: &LibraryTask<'_>, answer: Answer) -> LoadedPredictor {
    let rows = task.rows.iter().map(|&value| value as f32).collect();
    let most = task.sizes.samples.min(1000) as f64;
    let counts = task.values.iter().map(|value| value.min(most) as u32);
    Ok(Box::new(Lookup::new(
        rows,
        task.sizes.features,
        task.labels.to_vec(),
        counts.collect(),
        answer,
    )?))
}
