//! The tasks of a sweep as a file, so that a job elsewhere carries out what was planned here.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_dataset::{Digest, SensorFile};

use crate::condition::Condition;
use crate::error::SweepError;
use crate::file::SweepFile;
use crate::folder::SweepFolder;
use crate::grid::{Grid, sensor_digest};
use crate::task::Task;

/// The schema of the list.
const SCHEMA: &str = "taceva.sweep-tasks/1.0";

/// The tasks of a sweep, with all that is needed to carry them out and to collect them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TaskList {
    schema: String,
    taceva: String,
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
            name: file.name.clone(),
            metrics: file.metrics.clone(),
            sensor: file.sensor.as_ref().map(absolute).transpose()?,
            sensor_digest: sensor_digest(file)?,
            limits: file.limits.as_ref().map(absolute).transpose()?,
            vary: file.vary.clone().into_iter().collect(),
            tasks: grid.tasks,
        })
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

    /// Writes the list into `folder`, under a name that only equal lists have, and as the last one; returns where.
    ///
    /// # Errors
    /// [`SweepError::Io`].
    pub fn write(&self, folder: &SweepFolder) -> Result<PathBuf, SweepError> {
        let latest = latest(folder);
        let text = serde_json::to_string(self).map_err(|error| SweepError::Kept {
            path: latest.clone(),
            problem: error.to_string(),
        })?;
        let digest = Digest::of(text.as_bytes()).as_bytes()[..8]
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect::<String>();
        let lists = folder.path().join("tasks");
        fs::create_dir_all(&lists).map_err(SweepError::io("make", &lists))?;
        let own = lists.join(format!("{digest}.json"));
        if !own.exists() {
            folder.write(&own, text.as_bytes())?;
        }
        folder.write(&latest, text.as_bytes())?;
        Ok(own)
    }

    /// The list at `path`.
    ///
    /// # Errors
    /// [`SweepError::Kept`] if it is none, or one of another version.
    pub fn read(path: &Path) -> Result<TaskList, SweepError> {
        let wrong = |problem: String| SweepError::Kept {
            path: path.to_owned(),
            problem,
        };
        let text = fs::read_to_string(path).map_err(|error| {
            wrong(format!(
                "no list of tasks: {error}; is the folder of the sweep shared with this machine?"
            ))
        })?;
        let list: TaskList =
            serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        if list.schema != SCHEMA || list.taceva != env!("CARGO_PKG_VERSION") {
            return Err(wrong(format!(
                "planned by TacEva {}, this is {}; start the sweep again",
                list.taceva,
                env!("CARGO_PKG_VERSION")
            )));
        }
        Ok(list)
    }

    /// What is known of the sensor, as it was when the sweep was planned.
    ///
    /// # Errors
    /// [`SweepError::Kept`] if its file is another one now; [`SweepError`] if it cannot be read.
    pub(crate) fn read_sensor(&self) -> Result<Option<SensorFile>, SweepError> {
        let Some(path) = &self.sensor else {
            return Ok(None);
        };
        let bytes = fs::read(path).map_err(SweepError::io("read", path))?;
        if self
            .sensor_digest
            .is_some_and(|digest| digest != Digest::of(&bytes))
        {
            return Err(SweepError::Kept {
                path: path.clone(),
                problem:
                    "it is another file than when the sweep was planned; start the sweep again"
                        .to_owned(),
            });
        }
        Ok(Some(SensorFile::read(path)?))
    }

    /// The last list that was written into `folder`.
    ///
    /// # Errors
    /// As [`read`](TaskList::read).
    pub fn latest(folder: &SweepFolder) -> Result<TaskList, SweepError> {
        TaskList::read(&latest(folder))
    }
}

fn latest(folder: &SweepFolder) -> PathBuf {
    folder.path().join("tasks.json")
}
