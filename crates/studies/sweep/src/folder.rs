//! The folder of a sweep: results by key, and other files.
//!
//! ```text
//! FOLDER/results/KEY.json       scores of a task: absent or whole
//!       /evaluations/KEY.json   the whole evaluation, as `taceva evaluate` writes it
//!       /failed/KEY.json        why a task has no scores
//!       /logs/KEY.log           what it did, stage by stage
//!       /times/KEY.json         how long it took, and where
//!       /claims/KEY             who is at it
//!       /scenes/NAME/           the run of a scene whose recordings tasks are of
//!       /cache/                 what tasks have in common
//!       /slurm/                 scripts, lists of tasks, words of jobs
//!       table.csv, table.parquet, times.csv, page.html, times.html
//! ```

mod keys;

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::SweepError;
use crate::key::TaskKey;

/// The folder of a sweep.
#[derive(Clone, Debug)]
pub struct SweepFolder {
    path: PathBuf,
}

impl SweepFolder {
    /// The folder at `path`, which may not be there yet.
    pub fn new(path: PathBuf) -> SweepFolder {
        SweepFolder { path }
    }

    /// The default folder for results, beside the sweep file: `which.sweep` of `which.toml`.
    pub fn beside(file: &Path) -> SweepFolder {
        SweepFolder::new(file.with_extension("sweep"))
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The cache that tasks share.
    pub fn cache(&self) -> PathBuf {
        self.path.join("cache")
    }

    /// The folder of the runs of scenes, each under the name of its scene.
    pub fn scenes(&self) -> PathBuf {
        self.path.join("scenes")
    }

    /// The claim for acquiring the scene `name`.
    pub fn scene_claim(&self, name: &str) -> PathBuf {
        self.path.join(format!("claims/scene-{name}"))
    }

    /// The folder of the times of scenes.
    pub(crate) fn scene_times(&self) -> PathBuf {
        self.path.join("times/scenes")
    }

    /// Creates the folder and its subfolders.
    ///
    /// # Errors
    /// [`SweepError::Io`].
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

    pub(crate) fn failure(&self, key: &TaskKey) -> PathBuf {
        self.path.join(format!("failed/{key}.json"))
    }

    /// The log of a task, stage by stage.
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

    /// Scripts of the scheduler.
    pub fn slurm(&self) -> PathBuf {
        self.path.join("slurm")
    }

    /// Writes a file atomically: it is absent or complete at any moment. Two processes that write one file write the same.
    ///
    /// # Errors
    /// [`SweepError::Io`].
    pub fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
        taceva_files::replace(path, |staged| fs::write(staged, bytes))
            .map_err(SweepError::io("write", path))
    }
}
