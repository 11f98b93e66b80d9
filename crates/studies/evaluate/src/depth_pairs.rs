//! Pairs of true and predicted depth maps of a task, from which its scores are computed.

use taceva_core::{counted, shown};
use taceva_dataset::{Dataset, Task};
use taceva_tasks::depth::{DepthError, DepthMap, DepthState, DepthTask};
use taceva_tasks::{TaskState, WorstSample};

use crate::error::EvaluateError;

/// Pairs of true and predicted depth maps of a task.
pub(crate) struct DepthPairs<'a> {
    dataset: &'a Dataset,
    task: &'a Task,
    clusters: Vec<Option<String>>,
    maps: DepthState,
    state: TaskState,
    left_out: usize,
}

impl<'a> DepthPairs<'a> {
    /// Creates an empty list of pairs for `task`, with the clusters of `dataset`.
    pub(crate) fn new(
        dataset: &'a Dataset,
        task: &'a Task,
        definition: DepthTask,
    ) -> DepthPairs<'a> {
        DepthPairs {
            dataset,
            task,
            clusters: dataset.clusters_of(task),
            maps: DepthState::new(definition),
            state: TaskState::new(task.name.as_str(), task.kind.name(), task.cluster.as_str()),
            left_out: 0,
        }
    }

    /// Adds the true map of `row`, and the map that `predicted` computes. A row without a true map is skipped, and counted as left out.
    ///
    /// # Errors
    /// [`EvaluateError`] for a row without a cluster, for maps of different sizes, and the errors of `predicted`.
    pub(crate) fn push(
        &mut self,
        row: usize,
        predicted: impl FnOnce() -> Result<DepthMap, EvaluateError>,
    ) -> Result<(), EvaluateError> {
        let (dataset, task) = (self.dataset, self.task);
        let Some(map) = dataset.depth_map(&task.name, row)? else {
            self.left_out += 1;
            return Ok(());
        };
        let sample = dataset.table().samples()[row].as_str();
        let cluster = self.clusters[row].as_deref().ok_or_else(|| {
            EvaluateError::Request(format!(
                "task `{}`: the sample `{}` has no value in the cluster column `{}`: fill the column in, or name another",
                shown(&task.name),
                shown(sample),
                shown(&task.cluster)
            ))
        })?;
        let refused = |error: DepthError| of_sample(dataset, task, row, &error);
        let truth = DepthMap::new(map.rows, map.columns, map.mm).map_err(refused)?;
        let predicted = predicted()?;
        let number = row as u64 + 1;
        let pushed = self.maps.push(cluster, number, &truth, &predicted);
        pushed.map_err(refused)?;
        if let Some(error) = mean_error_mm(&truth, &predicted) {
            let worst = WorstSample::new(row, sample, cluster, error, "mm");
            self.state.evidence.add_worst(worst);
        }
        Ok(())
    }

    /// Sums over all pairs, from which the scores of the task are computed. `part` names the part of the dataset in an error, such as ` of the test
    /// part`.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] without a map.
    pub(crate) fn into_state(self, part: &str) -> Result<TaskState, EvaluateError> {
        if self.maps.maps() == 0 {
            return Err(EvaluateError::Request(format!(
                "task `{}`: no sample{part} has a depth map",
                shown(&self.task.name)
            )));
        }
        let mut state = self.state;
        if self.left_out > 0 {
            let samples = counted(self.left_out, "sample");
            let note = format!("{samples} without a depth map, left out");
            state.notes.push(note);
        }
        state.depth = Some(self.maps);
        Ok(state)
    }
}

/// Definition of `task`, with the pixel size that the dataset states.
pub(crate) fn definition(task: &Task) -> Result<DepthTask, EvaluateError> {
    let own = DepthTask::default();
    match task.maps.as_ref().and_then(|maps| maps.pixel_mm) {
        Some(pixel_mm) => own.with_pixel_mm(pixel_mm).map_err(|error| {
            EvaluateError::Request(format!("task `{}`: {error}", shown(&task.name)))
        }),
        None => Ok(own),
    }
}

/// Error for the map of `row`.
pub(crate) fn of_sample(
    dataset: &Dataset,
    task: &Task,
    row: usize,
    error: &DepthError,
) -> EvaluateError {
    EvaluateError::Request(format!(
        "task `{}`, sample `{}`: {error}",
        shown(&task.name),
        shown(&dataset.table().samples()[row])
    ))
}

/// Mean absolute error of a map over the pixels that are valid in both; `None` without such a pixel.
fn mean_error_mm(truth: &DepthMap, predicted: &DepthMap) -> Option<f64> {
    let pairs = truth.mm().iter().zip(predicted.mm());
    let errors = pairs.map(|(truth, predicted)| (truth - predicted).abs());
    let valid: Vec<f64> = errors.filter(|error| !error.is_nan()).collect();
    (!valid.is_empty()).then(|| valid.iter().sum::<f64>() / valid.len() as f64)
}
