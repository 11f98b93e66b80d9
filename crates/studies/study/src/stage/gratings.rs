//! Predicts the spacing of the board in each press on a grating. The model is fitted on other presses.

mod model;
mod network;
mod spectrum;

use std::collections::BTreeMap;

use taceva_core::{Column, GratingKind, Nanometre};
use taceva_dataset::Dataset;

use self::spectrum::ByFold;
use super::RunContext;
use crate::classifier::SpacingClassifier;
use taceva_evaluate::EvaluateError;
use taceva_evaluate::{CachedStage, Key};
use taceva_evaluate::{Need, usable};

/// Number of folds into which the presses on each board are divided. A classifier that is fitted on the other folds classifies the presses of a fold.
const FOLDS: usize = 3;
const NM_A_MM: f64 = 1e6;

/// Predicted spacing by row of the dataset.
type SpacingOfRow = BTreeMap<usize, Nanometre>;

/// Predicted spacing of each press on a grating.
pub(super) struct PredictedSpacings {
    /// Rows of the dataset for which spacings were requested, ascending.
    pub(super) rows: Vec<usize>,
    /// Predicted spacing of each of `rows`, in whole nm; no value for a row without a frame.
    pub(super) spacings: Column,
    pub(super) frames_decoded: u64,
}

impl PredictedSpacings {
    /// Predicts the spacings of `rows`, separately for lines and dots.
    pub(super) fn of(
        dataset: &Dataset,
        rows: Vec<usize>,
        classifier: &SpacingClassifier,
        RunContext { work, cache, .. }: RunContext<'_>,
    ) -> Result<PredictedSpacings, EvaluateError> {
        let boards = boards(dataset, &rows);
        let key = Key::of(CachedStage::Classify)
            .part("dataset", &dataset.digest().to_string())
            .whole("rows", &rows)
            .whole("classifier", classifier)
            .finish();
        let spacings = cache.value(&key, || {
            let mut predicted = SpacingOfRow::new();
            for presses in boards.values() {
                match classifier {
                    SpacingClassifier::Spectrum => {
                        let by = ByFold::Discriminants;
                        spectrum::classify(dataset, presses, by, &mut predicted, work)?
                    }
                    SpacingClassifier::Model(model) => {
                        let by = ByFold::Model(model);
                        spectrum::classify(dataset, presses, by, &mut predicted, work)?
                    }
                    SpacingClassifier::Network(network) => {
                        network::classify(dataset, presses, network, &mut predicted, work)?;
                    }
                }
            }
            let mut spacings = Column::default();
            for row in &rows {
                spacings.push(predicted.get(row).map(|spacing| spacing.to_f64()));
            }
            Ok::<_, EvaluateError>(spacings)
        })?;
        let presses = boards.values().map(|presses| {
            let times = match classifier {
                SpacingClassifier::Spectrum | SpacingClassifier::Model(_) => {
                    spectrum::times_decoded(dataset, presses.len())
                }
                SpacingClassifier::Network(_) => 1,
            };
            times * presses.len() as u64
        });
        let frames_decoded = presses.sum();
        Ok(PredictedSpacings {
            rows,
            spacings,
            frames_decoded,
        })
    }
}

impl PredictedSpacings {
    /// Predicted spacing of each of `rows`, in mm; no value for a row without a prediction.
    pub(super) fn in_millimetres(&self, rows: &[usize]) -> Column {
        let mut column = Column::default();
        for row in rows {
            let at = self.rows.binary_search(row).ok();
            let spacing = at.and_then(|at| self.spacings.get(at));
            column.push(spacing.map(|nanometres| nanometres / NM_A_MM));
        }
        column
    }
}

/// Rows of presses with a frame, each with the spacing of its board. They are grouped by the kind of grating.
fn boards(dataset: &Dataset, rows: &[usize]) -> BTreeMap<GratingKind, Vec<(usize, Nanometre)>> {
    let table = dataset.table();
    let need = Need {
        frame: true,
        labels: None,
    };
    let mut presses: BTreeMap<GratingKind, Vec<(usize, Nanometre)>> = BTreeMap::new();
    for row in usable(dataset, rows, need) {
        if let (Some(kind), Some(spacing)) = (table.kind()[row], table.spacing()[row]) {
            presses.entry(kind).or_default().push((row, spacing));
        }
    }
    presses
}

/// Index of the fold of each press. The presses of one board are assigned to the folds in turn.
fn folds(presses: &[(usize, Nanometre)]) -> Vec<usize> {
    let mut numbers: BTreeMap<Nanometre, usize> = BTreeMap::new();
    let folds = presses.iter().map(|(_, spacing)| {
        let number = numbers.entry(*spacing).or_default();
        *number += 1;
        (*number - 1) % FOLDS
    });
    folds.collect()
}
