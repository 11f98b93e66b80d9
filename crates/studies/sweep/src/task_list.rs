//! The tasks of a sweep as a file, so that a job elsewhere runs what was planned here.

mod file;
mod selection;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_dataset::Digest;

use crate::error::SweepError;
use crate::file::SweepFile;
use crate::grid::{Grid, PlannedTables, sensor_digest};
use crate::task::Task;

pub use selection::Counts;

/// The schema of the list.
const SCHEMA: &str = "taceva.sweep-tasks/1.1";

/// The tasks of a sweep, with everything needed to run and collect them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TaskList {
    schema: String,
    taceva: String,
    /// The digest of the file that the list was made from.
    file: Digest,
    /// Name of the sweep.
    pub name: String,
    /// The view of recordings whose samples have several pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The file of sensor facts.
    pub sensor: Option<PathBuf>,
    /// The digest of that file when the sweep was planned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) sensor_digest: Option<Digest>,
    /// The file of limits for each unit.
    pub limits: Option<PathBuf>,
    /// Settings that vary, each with its values in order.
    pub vary: Vec<(String, Vec<String>)>,
    /// The tasks, in the order of the table.
    pub tasks: Vec<Task>,
    /// The tables whose shards are the tasks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) tables: Option<PlannedTables>,
}

impl TaskList {
    /// The tasks of `grid`.
    ///
    /// # Errors
    /// [`SweepError::Io`] if the working folder is unknown.
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
        })
    }

    /// True if the file at `path` is unchanged since the list was made from it, or cannot be read.
    pub fn is_of(&self, path: &Path) -> bool {
        std::fs::read(path).map_or(true, |text| Digest::of(&text) == self.file)
    }

    /// True if tasks are shards of two tables.
    pub fn is_of_tables(&self) -> bool {
        self.tables.is_some()
    }
}
