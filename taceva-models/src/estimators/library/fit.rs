//! One fit by a library. Features and channels that do not vary are removed first.

use faer::Mat;
use taceva_core::{Features, ModelError, Progress};

use super::LibraryLearner;
use super::answers::Fitted;
use super::task::{LibrarySizes, LibraryTask};
use crate::linalg::progress::interrupted;
use crate::linalg::standard::Standard;

/// Fits `learner` to `features` and `labels`, one row per sample. `values` has one value per channel for the setting that is being chosen.
pub(super) fn fit(
    learner: &dyn LibraryLearner,
    features: &Features,
    labels: &Mat<f64>,
    values: &[f64],
    progress: &dyn Progress,
) -> Result<Fitted, ModelError> {
    interrupted(progress)?;
    let standard = Standard::of(features, learner.settings().scale);
    let kept = varying(features);
    let varies = |channel: &usize| {
        let labels = labels.col_as_slice(*channel);
        labels
            .iter()
            .any(|label| label.to_bits() != labels[0].to_bits())
    };
    let live: Vec<usize> = (0..labels.ncols()).filter(varies).collect();
    let is_nothing = kept.is_empty() || live.is_empty();
    let base = |channel: usize| {
        let labels = labels.col_as_slice(channel);
        match (varies(&channel), learner.is_classifier()) {
            (false, _) => labels[0],
            (true, false) => labels.iter().sum::<f64>() / labels.len() as f64,
            (true, true) if is_nothing => commonest(labels),
            (true, true) => 0.0,
        }
    };
    let base: Vec<f64> = (0..labels.ncols()).map(base).collect();
    if is_nothing {
        return Ok(Fitted {
            standard,
            kept: Vec::new(),
            live: Vec::new(),
            base,
            predictor: None,
        });
    }
    let rows = standard.rows(features);
    let samples = rows.chunks_exact(features.shape().len());
    let rows: Vec<f64> = samples
        .flat_map(|sample| kept.iter().map(|&feature| f64::from(sample[feature])))
        .collect();
    let places = (0..labels.nrows()).flat_map(|row| live.iter().map(move |&c| (row, c)));
    let labels: Vec<f64> = places
        .map(|(row, channel)| labels[(row, channel)] - base[channel])
        .collect();
    let values: Vec<f64> = match values {
        [] => Vec::new(),
        values => live.iter().map(|&channel| values[channel]).collect(),
    };
    let predictor = learner.fit(&LibraryTask {
        sizes: LibrarySizes {
            samples: features.samples(),
            features: kept.len(),
            targets: live.len(),
        },
        rows: &rows,
        labels: &labels,
        values: &values,
        progress,
    })?;
    Ok(Fitted {
        standard,
        kept,
        live,
        base,
        predictor: Some(predictor),
    })
}

/// Indices of features that vary between samples.
fn varying(features: &Features) -> Vec<usize> {
    let first = features.sample(0);
    let mut varies = vec![false; first.len()];
    for sample in 1..features.samples() {
        let pairs = features.sample(sample).iter().zip(first);
        for (place, (value, first)) in varies.iter_mut().zip(pairs) {
            *place |= value.to_bits() != first.to_bits();
        }
    }
    (0..first.len())
        .filter(|&feature| varies[feature])
        .collect()
}

/// Most frequent label; of equally frequent labels, the smallest.
fn commonest(labels: &[f64]) -> f64 {
    let mut sorted = labels.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut best = (0, f64::NAN);
    for run in sorted.chunk_by(|a, b| a.total_cmp(b).is_eq()) {
        if run.len() > best.0 {
            best = (run.len(), run[0]);
        }
    }
    best.1
}
