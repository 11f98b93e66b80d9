//! Cells of predicted classes: their names, their clusters and the probabilities of all classes.

use taceva_core::Features;
use taceva_dataset::{Dataset, Task, TaskKind};
use taceva_models::{ClassProbabilities, Model, TaskCard};

use crate::error::EvaluateError;

/// Task of predictions, with what tables say beside the predicted classes.
#[derive(Debug)]
pub(super) struct TaskCells {
    card: TaskCard,
    /// Cluster of each row.
    clusters: Vec<Option<String>>,
    probabilities: Option<ClassProbabilities>,
}

impl TaskCells {
    /// Cells of the predictions of `model` for `rows`; `None` for a model of measured channels.
    pub(super) fn of(
        dataset: &Dataset,
        model: &Model,
        features: &Features,
        rows: &[usize],
    ) -> Result<Option<TaskCells>, EvaluateError> {
        let Some(card) = model.card().provenance.task.clone() else {
            return Ok(None);
        };
        let clusters = dataset.clusters_of(&Task::new("", TaskKind::Class, card.cluster.as_str()));
        Ok(Some(TaskCells {
            clusters: rows.iter().map(|&row| clusters[row].clone()).collect(),
            probabilities: model.probabilities(features)?,
            card,
        }))
    }

    /// Name of the class with the position `number`.
    pub(super) fn class(&self, number: f64) -> String {
        let class = self.card.class(number).map(str::to_owned);
        class.unwrap_or_else(|| format!("{number:?}"))
    }

    /// Column with the clusters; `None` if the table has it already.
    pub(super) fn cluster_column<'a>(&'a self, head: &[&str]) -> Option<&'a str> {
        let column = self.card.cluster.as_str();
        (!head.contains(&column)).then_some(column)
    }

    /// Cluster of a row; empty if unknown.
    pub(super) fn cluster(&self, row: usize) -> String {
        self.clusters[row].clone().unwrap_or_default()
    }

    /// Columns of the probabilities, one for each class; none if the model does not estimate them.
    pub(super) fn score_columns(&self) -> Vec<String> {
        let names = self.card.names.iter();
        let names = names.filter(|_| self.probabilities.is_some());
        names
            .map(|class| format!("{}.p.{class}", self.card.name))
            .collect()
    }

    /// Probabilities of a row, in the order of [`score_columns`](TaskCells::score_columns). A class without a training sample has the probability 0.
    pub(super) fn scores(&self, row: usize) -> Vec<f64> {
        let Some(known) = &self.probabilities else {
            return Vec::new();
        };
        let shares = known.samples().nth(row).unwrap_or_default();
        let share = |class: u32| {
            let own = known.labels.iter().zip(shares);
            let mut own = own.filter(|(label, _)| (f64::from(class) - **label).abs() < 1e-6);
            own.next().map_or(0.0, |(_, share)| *share)
        };
        (0_u32..)
            .zip(&self.card.names)
            .map(|(class, _)| share(class))
            .collect()
    }
}
