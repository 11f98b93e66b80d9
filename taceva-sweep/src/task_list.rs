//! The tasks of a sweep as a file, so that a job elsewhere carries out what was planned here.

mod kept;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_dataset::Digest;

use crate::condition::Condition;
use crate::error::SweepError;
use crate::file::SweepFile;
use crate::folder::SweepFolder;
use crate::grid::{Grid, PlannedTables, sensor_digest};
use crate::task::Task;

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

/// How far a sweep is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// Tasks with a result.
    pub scored: usize,
    /// Tasks that failed.
    pub failed: usize,
    /// Tasks without either.
    pub left: usize,
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

    /// The positions of the tasks of which `only` holds; of all without it.
    ///
    /// # Errors
    /// [`SweepError::Condition`] for a word that no task has, and where it holds of none.
    pub fn matching(&self, only: Option<&Condition>) -> Result<Vec<usize>, SweepError> {
        let Some(only) = only else {
            return Ok((0..self.tasks.len()).collect());
        };
        let settings = self
            .tasks
            .iter()
            .flat_map(|task| task.settings.keys().cloned());
        only.check_names(&settings.collect())?;
        let matching: Vec<usize> = (0..self.tasks.len())
            .filter(|at| only.holds(&self.tasks[*at]))
            .collect();
        match matching.is_empty() {
            true => Err(SweepError::Condition {
                text: only.text().to_owned(),
                problem: format!("none of the {} tasks is meant", self.tasks.len()),
            }),
            false => Ok(matching),
        }
    }

    /// Those of the tasks at `wanted` that are still to be carried out.
    ///
    /// # Errors
    /// [`SweepError`] if the folder cannot be read.
    pub fn without_result(
        &self,
        folder: &SweepFolder,
        wanted: &[usize],
        retry_failed: bool,
    ) -> Result<Vec<usize>, SweepError> {
        let (results, failures) = (folder.results()?, folder.failures()?);
        let is_left = |at: &usize| {
            let key = self.tasks[*at].key.as_str();
            !results.contains(key) && (retry_failed || !failures.contains(key))
        };
        Ok(wanted.iter().copied().filter(is_left).collect())
    }

    /// How far the sweep is, by the names of its files.
    ///
    /// # Errors
    /// [`SweepError`] if the folder cannot be read.
    pub fn counts(&self, folder: &SweepFolder) -> Result<Counts, SweepError> {
        let (results, failures) = (folder.results()?, folder.failures()?);
        let mut counts = Counts::default();
        for task in &self.tasks {
            let key = task.key.as_str();
            match (results.contains(key), failures.contains(key)) {
                (true, _) => counts.scored += 1,
                (false, true) => counts.failed += 1,
                (false, false) => counts.left += 1,
            }
        }
        Ok(counts)
    }
}
