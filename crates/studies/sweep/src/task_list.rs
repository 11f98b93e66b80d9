//! Task list of a sweep, stored so that jobs on other machines run the planned tasks.

mod file;
mod selection;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_dataset::Digest;

use crate::error::SweepError;
use crate::file::SweepFile;
use crate::grid::{Grid, PlannedLabels, PlannedTables, sensor_digest};
use crate::task::Task;

pub use selection::Counts;

/// Schema of the list.
const SCHEMA: &str = "taceva.sweep-tasks/1.1";

/// The tasks of a sweep, with everything needed to run and collect them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TaskList {
    schema: String,
    taceva: String,
    /// Digest of the sweep file that the list was planned from.
    file: Digest,
    /// Name of the sweep.
    pub name: String,
    /// View of recordings whose samples have several pictures, if stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// Names of metrics and of groups of metrics.
    pub metrics: Vec<String>,
    /// File of sensor facts, if any.
    pub sensor: Option<PathBuf>,
    /// Digest of the file of sensor facts at the time of planning; `None` without such a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) sensor_digest: Option<Digest>,
    /// Path of the file of limits, if any, against which each unit is checked.
    pub limits: Option<PathBuf>,
    /// Varied settings, each with its values in order.
    pub vary: Vec<(String, Vec<String>)>,
    /// Tasks, in the order of the table.
    pub tasks: Vec<Task>,
    /// Planned tables, whose shards are the tasks; `None` without tables.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) tables: Option<PlannedTables>,
    /// Planned tables with tasks to score, whose shards are the tasks of the list; `None` without such tables.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) label_tables: Option<PlannedLabels>,
}

impl TaskList {
    /// Tasks of `grid`.
    ///
    /// # Errors
    /// [`SweepError::Io`] if the working directory cannot be determined.
    pub fn new(file: &SweepFile, grid: Grid) -> Result<TaskList, SweepError> {
        let absolute =
            |path: &PathBuf| std::path::absolute(path).map_err(SweepError::io("find", path));
        Ok(TaskList {
            schema: SCHEMA.to_owned(),
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            file: file.digest,
            name: file.name.clone(),
            view: file.view.clone(),
            metrics: file.metrics.clone(),
            sensor: file.sensor.as_ref().map(absolute).transpose()?,
            sensor_digest: sensor_digest(file)?,
            limits: file.limits.as_ref().map(absolute).transpose()?,
            vary: file.vary.clone().into_iter().collect(),
            tasks: grid.tasks,
            tables: grid.tables,
            label_tables: grid.label_tables,
        })
    }

    /// True if the sweep file at `path` has not changed since planning, or cannot be read.
    pub fn is_of(&self, path: &Path) -> bool {
        std::fs::read(path).map_or(true, |text| Digest::of(&text) == self.file)
    }

    /// True if the tasks score labels, such as slip, and not channels.
    pub(crate) fn is_of_labels(&self) -> bool {
        self.tasks.iter().any(|task| task.labels.is_some())
    }

    /// True if the tasks are shards of two tables.
    pub fn is_of_tables(&self) -> bool {
        self.tables.is_some() || self.label_tables.is_some()
    }
}
