//! Folder of a sweep: results by key, and its other files.
//!
//! ```text
//! FOLDER/results/KEY.json       scores of a task: absent or complete
//!       /evaluations/KEY.json   the whole evaluation, as `taceva evaluate` writes it
//!       /evaluations/KEY.state  its state, if it scores the labels of a task, as `--state-out` writes it
//!       /failed/KEY.json        reason why a task has no scores
//!       /logs/KEY.log           log of a task, stage by stage
//!       /times/KEY.json         run time and host of a task
//!       /claims/KEY             claim of the worker that runs a task
//!       /scenes/NAME/           run of a scene that acquires recordings for tasks
//!       /cache/                 cache that tasks share
//!       /slurm/                 scripts, task lists and output of jobs
//!       table.csv, table.parquet, times.csv, page.html, times.html
//! ```

mod keys;

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::SweepError;
use crate::key::TaskKey;

/// Folder of a sweep.
#[derive(Clone, Debug)]
pub struct SweepFolder {
    path: PathBuf,
}

impl SweepFolder {
    /// Folder at `path`, which may not exist yet.
    pub fn new(path: PathBuf) -> SweepFolder {
        SweepFolder { path }
    }

    /// Default folder for results, next to the sweep file: `which.sweep` for `which.toml`.
    pub fn beside(file: &Path) -> SweepFolder {
        SweepFolder::new(file.with_extension("sweep"))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Path of the cache shared by all tasks.
    pub fn cache(&self) -> PathBuf {
        self.path.join("cache")
    }

    /// Folder of the runs of scenes, each named after its scene.
    pub fn scenes(&self) -> PathBuf {
        self.path.join("scenes")
    }

    /// Claim file for acquiring the scene `name`.
    pub fn scene_claim(&self, name: &str) -> PathBuf {
        self.path.join(format!("claims/scene-{name}"))
    }

    /// Folder of the acquisition times of scenes.
    pub(crate) fn scene_times(&self) -> PathBuf {
        self.path.join("times/scenes")
    }

    /// Creates the folder and its subfolders.
    ///
    /// # Errors
    /// [`SweepError::Io`] if a folder cannot be created.
    pub fn make(&self) -> Result<(), SweepError> {
        for name in [
            "results",
            "evaluations",
            "failed",
            "logs",
            "times",
            "claims",
        ] {
            let folder = self.path.join(name);
            fs::create_dir_all(&folder).map_err(SweepError::io("make", &folder))?;
        }
        Ok(())
    }

    pub(crate) fn result(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("results/{key}.json"))
    }

    pub(crate) fn evaluation(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("evaluations/{key}.json"))
    }

    /// Path of a task's file with the sums behind its label scores, for paired comparisons.
    pub(crate) fn label_state(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("evaluations/{key}.state"))
    }

    pub(crate) fn failure(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("failed/{key}.json"))
    }

    /// Log file of a task, stage by stage.
    pub fn log(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("logs/{key}.log"))
    }

    pub(crate) fn times(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("times/{key}.json"))
    }

    pub(crate) fn claims(&self) -> PathBuf {
        self.path.join("claims")
    }

    pub(crate) fn claim(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("claims/{key}"))
    }

    /// Folder of the Slurm scripts.
    pub fn slurm(&self) -> PathBuf {
        self.path.join("slurm")
    }

    /// Writes a file atomically, so that readers find either no file or a complete file. Two processes that write to one path write the same content.
    ///
    /// # Errors
    /// [`SweepError::Io`] if the file cannot be written.
    pub fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
        taceva_files::replace(path, |staged| fs::write(staged, bytes))
            .map_err(SweepError::io("write", path))
    }
}
