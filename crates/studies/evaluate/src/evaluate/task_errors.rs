//! Samples of a task whose predicted class is wrong.

use std::collections::BTreeMap;

use taceva_dataset::{Dataset, Task};
use taceva_tasks::{TaskState, WorstSample};

/// Sample whose predicted class is wrong.
pub(super) struct TaskMistake<'a> {
    /// Row of the dataset.
    pub(super) row: usize,
    pub(super) cluster: &'a str,
    /// Index of the true class among the classes of the task.
    pub(super) truth: u32,
    pub(super) predicted: u32,
}

/// Adds the wrong samples to the worst samples that `state` lists. The error of a sample is the number of samples with the same true and predicted
/// class.
pub(super) fn add(
    state: &mut TaskState,
    wrong: Vec<TaskMistake<'_>>,
    dataset: &Dataset,
    task: &Task,
) {
    let mut counts: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    for own in &wrong {
        *counts.entry([own.truth, own.predicted]).or_default() += 1;
    }
    let name = |class: u32| task.names.get(class as usize).map_or("", String::as_str);
    for own in wrong {
        let count = counts[&[own.truth, own.predicted]];
        let sample = dataset.table().samples()[own.row].as_str();
        let unit = "samples with this error";
        let mut worst = WorstSample::new(own.row, sample, own.cluster, f64::from(count), unit);
        worst.words = format!("{} as {}", name(own.truth), name(own.predicted));
        state.evidence.add_worst(worst);
    }
}
