//! Rows of a dataset by cluster: a model predicts each cluster that it has not seen.

use std::collections::BTreeMap;

use taceva_core::{Column, shown};
use taceva_dataset::{Dataset, Task};
use taceva_models::Split;

use super::task::MOST_FOLDS;
use crate::error::EvaluateError;
use crate::fit::{FitPlan, FitRequest, Recipe};
use crate::predict::{Predicted, Target, predict_target};
use crate::rows::Divided;
use crate::work::Work;

/// Place of a row in its cluster.
pub(super) struct InCluster<'a> {
    pub(super) name: &'a str,
    /// Number of the cluster, counted from 0.
    number: usize,
    /// Number of rows of the cluster before this row.
    pub(super) place: u32,
}

/// A row with its prediction by a model that has not seen its cluster.
pub(super) struct Unseen<'p, 'a> {
    pub(super) row: usize,
    pub(super) of: &'p InCluster<'a>,
    predicted: &'p Predicted,
    at: usize,
}

impl Unseen<'_, '_> {
    /// Truth and prediction of `channel`; `None` unless both are known.
    pub(super) fn pair(&self, channel: &str) -> Option<[f64; 2]> {
        let position = self.predicted.channels().position(channel)?;
        let number = |columns: &[Column]| columns.get(position)?.get(self.at);
        let truth = number(self.predicted.truth())?;
        Some([truth, number(self.predicted.prediction())?])
    }
}

/// Clusters of rows, in the order of their first rows.
pub(super) struct ClusteredRows<'a> {
    by_row: BTreeMap<usize, InCluster<'a>>,
    count: usize,
}

impl<'a> ClusteredRows<'a> {
    /// Sorts `rows` into clusters. `names` has the cluster of every row of the dataset. Rows without a cluster are left out.
    pub(super) fn of(names: &'a [Option<String>], rows: &[usize]) -> ClusteredRows<'a> {
        let mut lengths: BTreeMap<&str, (usize, u32)> = BTreeMap::new();
        let mut by_row = BTreeMap::new();
        for &row in rows {
            let Some(name) = names[row].as_deref() else {
                continue;
            };
            let next = lengths.len();
            let (number, length) = lengths.entry(name).or_insert((next, 0));
            let of = InCluster {
                name,
                number: *number,
                place: *length,
            };
            *length += 1;
            by_row.insert(row, of);
        }
        ClusteredRows {
            by_row,
            count: lengths.len(),
        }
    }

    /// Number of folds: five, or one for each cluster if there are fewer than five clusters.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for fewer than two clusters of `task`; the message names the column `cluster`.
    pub(super) fn folds(&self, task: &Task, cluster: &str) -> Result<usize, EvaluateError> {
        let folds = self.count.min(MOST_FOLDS);
        if folds >= 2 {
            return Ok(folds);
        }
        Err(EvaluateError::Request(format!(
            "task `{}`: {} different values of `{}`, expected two or more",
            shown(&task.name),
            self.count,
            shown(cluster)
        )))
    }

    /// Fits a model by `fit` once for each of `folds` folds of clusters. Calls `each` with every row that this model has not seen.
    pub(super) fn predict_unseen(
        &self,
        dataset: &Dataset,
        folds: usize,
        fit: &FitRequest,
        work: Work<'_>,
        mut each: impl FnMut(&Unseen<'_, 'a>) -> Result<(), EvaluateError>,
    ) -> Result<(), EvaluateError> {
        for fold in 0..folds {
            let divided = self.divided(dataset, fold, folds, fit.seed)?;
            let fitted = FitPlan::on(dataset, fit, Recipe::of(fit)?, divided)?.run(work)?;
            let model = &fitted.model;
            let target = Target::of(dataset, Some(fitted.divided), None, model.reads_frames())?;
            let predicted = predict_target(dataset, model, &target, work)?;
            for (at, row) in target.rows.iter().enumerate() {
                if let Some(of) = self.by_row.get(row) {
                    each(&Unseen {
                        row: *row,
                        of,
                        predicted: &predicted,
                        at,
                    })?;
                }
            }
        }
        Ok(())
    }

    /// Division with the clusters whose number is `fold` modulo `folds` in the test part, and all other clusters in the training part.
    fn divided(
        &self,
        dataset: &Dataset,
        fold: usize,
        folds: usize,
        seed: u64,
    ) -> Result<Divided, EvaluateError> {
        let is_tested = |row: &usize| self.by_row[row].number % folds == fold;
        let (test, train) = self.by_row.keys().copied().partition(is_tested);
        let all = dataset.all_rows();
        let name = |row: &usize| self.by_row.get(row).map_or("", |of| of.name).to_owned();
        Ok(Divided {
            spec: format!("cv:{folds} by-point").parse()?,
            seed,
            groups: Some(all.iter().map(name).collect()),
            split: Split {
                train,
                test,
                left_out: all
                    .into_iter()
                    .filter(|row| !self.by_row.contains_key(row))
                    .collect(),
                ..Split::default()
            },
            neighbours: None,
            are_independent: false,
            folds: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_a_cluster_have_its_number_and_their_places_and_a_row_without_one_is_left_out() {
        let names = ["a", "b", "a", "b", "a"].map(|name| Some(name.to_owned()));
        let names: Vec<Option<String>> = names.into_iter().chain([None]).collect();
        let rows = ClusteredRows::of(&names, &[1, 2, 3, 4, 5]);
        assert_eq!(rows.count, 2);
        let found: Vec<(usize, u32)> = rows
            .by_row
            .values()
            .map(|of| (of.number, of.place))
            .collect();
        assert_eq!(found, [(0, 0), (1, 0), (0, 1), (1, 1)]);
    }
}
