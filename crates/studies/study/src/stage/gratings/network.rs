//! Spacings of gratings, predicted by a network.

use taceva_core::{ModelError, Nanometre};
use taceva_dataset::Dataset;

use super::{FOLDS, SpacingOfRow, folds};
use crate::classifier::NetworkClassifier;
use taceva_evaluate::EvaluateError;
use taceva_evaluate::Work;
use taceva_evaluate::{extract, extractor};

/// Predicts the spacing of each of `presses` from the frames of `dataset`, one fold after another, and adds it to `predicted`.
pub(super) fn classify(
    dataset: &Dataset,
    presses: &[(usize, Nanometre)],
    classifier: &NetworkClassifier,
    predicted: &mut SpacingOfRow,
    work: Work<'_>,
) -> Result<(), EvaluateError> {
    let rows: Vec<usize> = presses.iter().map(|(row, _)| *row).collect();
    let extractor = |recording: &Dataset| extractor(recording, classifier.features);
    let pictures = extract(dataset, extractor, &rows, work)?;
    let folds = folds(presses);
    for fold in 0..FOLDS {
        let places = 0..presses.len();
        let (asked, taught): (Vec<usize>, Vec<usize>) = places.partition(|at| folds[*at] == fold);
        if asked.is_empty() || taught.is_empty() {
            continue;
        }
        let spacings: Vec<Nanometre> = taught.iter().map(|&at| presses[at].1).collect();
        let network = classifier.estimator.fit_spacings(
            &pictures.select(&taught),
            &spacings,
            classifier.output,
            work.progress,
        )?;
        let found: Result<Vec<Nanometre>, ModelError> = network.predict(&pictures.select(&asked));
        predicted.extend(asked.iter().map(|&at| presses[at].0).zip(found?));
    }
    Ok(())
}
