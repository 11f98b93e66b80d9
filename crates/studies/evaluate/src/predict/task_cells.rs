//! Cells of predicted labels of a task: names of classes and their probabilities, or poses, and clusters.

use taceva_core::Features;
use taceva_dataset::{Dataset, RotationVector, Task, TaskKind};
use taceva_models::{ClassProbabilities, Model, TaskCard};

use crate::error::EvaluateError;

/// Suffixes of the columns of a pose: translation in mm, then the quaternion.
const POSE: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// Task of predictions, with the cells of tables in addition to predicted classes.
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

    /// Columns of the labels: one column for classes, or seven columns for a pose.
    pub(super) fn label_columns(&self) -> Vec<String> {
        let ends = POSE.iter().filter(|_| self.is_pose());
        let of_pose: Vec<String> = ends
            .map(|end| format!("{}.{end}", self.card.name))
            .collect();
        match of_pose.is_empty() {
            true => vec![self.card.name.clone()],
            false => of_pose,
        }
    }

    /// Cells of the [columns](TaskCells::label_columns) from the values of all channels in a row; empty without a label.
    pub(super) fn label_cells(&self, values: &[Option<f64>]) -> Vec<String> {
        let text = |number: f64| format!("{number:?}");
        let known: Option<Vec<f64>> = values.iter().copied().collect();
        match known.as_deref() {
            Some([x, y, z, rotation @ ..]) if self.is_pose() && rotation.len() == 3 => {
                let turned = RotationVector::new([rotation[0], rotation[1], rotation[2]]);
                let numbers = [*x, *y, *z].into_iter().chain(turned.quaternion());
                numbers.map(text).collect()
            }
            Some([class]) => {
                let name = self.card.class(*class).map(str::to_owned);
                vec![name.unwrap_or_else(|| text(*class))]
            }
            _ => vec![String::new(); self.label_columns().len()],
        }
    }

    /// Channels of the labels, in the order of [`label_cells`](TaskCells::label_cells).
    pub(super) fn channels(&self) -> Vec<String> {
        let kind = match self.is_pose() {
            true => TaskKind::Pose,
            false => TaskKind::Class,
        };
        Task::new(self.card.name.as_str(), kind, "").channels()
    }

    fn is_pose(&self) -> bool {
        self.card.kind == TaskKind::Pose.name()
    }

    /// Column with the clusters; `None` if the table already has this column.
    pub(super) fn cluster_column<'a>(&'a self, head: &[&str]) -> Option<&'a str> {
        let column = self.card.cluster.as_str();
        (!head.contains(&column)).then_some(column)
    }

    /// Cluster of a row; empty if unknown.
    pub(super) fn cluster(&self, row: usize) -> String {
        self.clusters[row].clone().unwrap_or_default()
    }

    /// Columns of the probabilities, one column for each class; empty if the model does not estimate probabilities.
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
