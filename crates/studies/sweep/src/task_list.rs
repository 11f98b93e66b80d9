//! The tasks of a sweep as a file, so that a job elsewhere carries out what was planned here.

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

/// The tasks of a sweep, with all that is needed to carry them out and to collect them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TaskList {
    schema: String,
    taceva: String,
    /// The digest of the file that the list was made from.
    file: Digest,
    /// What the sweep is called.
    pub name: String,
    /// The view of recordings whose samples have several pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The file that says what is known of the sensor.
    pub sensor: Option<PathBuf>,
    /// The digest of that file when the sweep was planned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) sensor_digest: Option<Digest>,
    /// The file of limits that each unit is held to.
    pub limits: Option<PathBuf>,
    /// Settings that vary, each with its values in their order.
    pub vary: Vec<(String, Vec<String>)>,
    /// The tasks, in the order of the table.
    pub tasks: Vec<Task>,
    /// The tables that tasks are shards of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) tables: Option<PlannedTables>,
}

impl TaskList {
    /// The tasks of `grid`.
    ///
    /// # Errors
    /// [`SweepError::Io`] where the working folder is not known.
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

    /// Whether the file at `path` says what it said when the list was made from it; so, too, where it cannot be read.
    pub fn is_of(&self, path: &Path) -> bool {
        std::fs::read(path).map_or(true, |text| Digest::of(&text) == self.file)
    }

    /// Whether tasks are shards of two tables.
    pub fn is_of_tables(&self) -> bool {
        self.tables.is_some()
    }
}
