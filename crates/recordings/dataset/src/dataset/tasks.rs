//! Tasks of a dataset: their labels by row, and the cluster of each row.

use super::Dataset;
use super::union::SEPARATOR;
use crate::table::TaskColumn;
use crate::task::Task;

/// Columns whose values [`Dataset::joined`] makes distinct between recordings.
const DISTINCT: [&str; 2] = ["sample", "point_id"];

impl Dataset {
    /// Labels of each task, by name; empty for a recording without tasks.
    pub fn tasks(&self) -> &[TaskColumn] {
        self.table.tasks()
    }

    /// Cluster of each row for `task`: rows with equal texts resemble each other. A cluster of joined recordings is named by its recording too.
    pub fn clusters_of(&self, task: &Task) -> Vec<Option<String>> {
        let absent = || vec![None; self.table.rows()];
        let mut clusters = self.table.as_text(&task.cluster).unwrap_or_else(absent);
        if DISTINCT.contains(&task.cluster.as_str()) {
            return clusters;
        }
        for recording in self.recordings() {
            for cluster in clusters[recording.rows()].iter_mut().flatten() {
                *cluster = format!("{}{SEPARATOR}{cluster}", recording.name());
            }
        }
        clusters
    }
}
