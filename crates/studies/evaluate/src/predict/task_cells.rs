//! Cells of predicted labels of a task: names of classes and their probabilities, or poses, and clusters.

use taceva_core::Features;
use taceva_dataset::{Dataset, RotationVector, Task, TaskKind};
use taceva_models::{ClassProbabilities, Model, TaskCard};

use crate::error::EvaluateError;

/// Suffixes of the columns of a pose: translation in mm, then the quaternion.
const POSE: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// Task that a model predicts, with the clusters and the probabilities of the rows.
#[derive(Debug)]
pub(super) struct TaskCells {
    card: TaskCard,
    /// Cluster of each row.
    clusters: Vec<Option<String>>,
    /// Probabilities of all classes, row by row; `None` if the model does not estimate them.
    shares: Option<Vec<f64>>,
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
        let known = model.probabilities(features)?;
        Ok(Some(TaskCells {
            clusters: rows.iter().map(|&row| clusters[row].clone()).collect(),
            shares: known.map(|known| of_all_classes(&known, card.names.len())),
            card,
        }))
    }

    /// Cells of the rows of `self`, followed by the cells of the rows of `other`.
    pub(super) fn followed_by(mut self, other: TaskCells) -> TaskCells {
        self.clusters.extend(other.clusters);
        self.shares = self.shares.zip(other.shares).map(|(mut own, other)| {
            own.extend(other);
            own
        });
        self
    }

    /// Cells of the rows with the indices `order`, in this order.
    pub(super) fn in_order(self, order: &[usize]) -> TaskCells {
        let shares = self.shares.as_ref().map(|_| {
            let rows = order.iter().flat_map(|&row| self.scores(row));
            rows.copied().collect()
        });
        TaskCells {
            clusters: order
                .iter()
                .map(|&row| self.clusters[row].clone())
                .collect(),
            shares,
            card: self.card,
        }
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
        let names = names.filter(|_| self.shares.is_some());
        names
            .map(|class| format!("{}.p.{class}", self.card.name))
            .collect()
    }

    /// Probabilities of a row, in the order of [`score_columns`](TaskCells::score_columns).
    pub(super) fn scores(&self, row: usize) -> &[f64] {
        let width = self.card.names.len();
        match &self.shares {
            Some(shares) => &shares[row * width..][..width],
            None => &[],
        }
    }

    /// Probabilities of all rows, row by row; `None` if the model does not estimate them.
    pub(super) fn shares(&self) -> Option<&[f64]> {
        self.shares.as_deref()
    }
}

/// Probabilities of `count` classes, row by row. A class without a training sample has the probability 0.
fn of_all_classes(known: &ClassProbabilities, count: usize) -> Vec<f64> {
    let place = |class: u32| {
        let mut labels = known.labels.iter();
        labels.position(|label| (f64::from(class) - label).abs() < 1e-6)
    };
    let places: Vec<Option<usize>> = (0_u32..).take(count).map(place).collect();
    let mut shares = Vec::with_capacity(known.shares.len());
    for row in known.samples() {
        shares.extend(places.iter().map(|place| place.map_or(0.0, |at| row[at])));
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(known: &ClassProbabilities) -> TaskCells {
        let mut task = Task::new("slip", TaskKind::Class, "stroke");
        task.names = ["a", "b", "c"].map(str::to_owned).to_vec();
        TaskCells {
            card: crate::task_view::task_card(&task),
            clusters: vec![None; known.samples().count()],
            shares: Some(of_all_classes(known, task.names.len())),
        }
    }

    #[test]
    fn models_that_learnt_different_classes_have_one_table_of_probabilities() {
        let first = ClassProbabilities {
            labels: vec![0.0, 2.0],
            shares: vec![0.75, 0.25],
        };
        let second = ClassProbabilities {
            labels: vec![1.0, 2.0],
            shares: vec![0.5, 0.5, 0.125, 0.875],
        };
        let both = cells(&first)
            .followed_by(cells(&second))
            .in_order(&[2, 0, 1]);
        let expected = [0.0, 0.125, 0.875, 0.75, 0.0, 0.25, 0.0, 0.5, 0.5];
        assert_eq!(both.shares(), Some(expected.as_slice()));
    }
}
