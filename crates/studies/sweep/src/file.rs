//! Sweep file: varied and fixed settings of a sweep.

mod labels_entry;
mod model_entry;
mod place;
mod reader;
mod tables;
mod vary;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use taceva_dataset::Digest;

use crate::condition::Condition;
use crate::error::SweepError;
use crate::slurm_spec::SlurmSpec;
use place::FilePlace;

pub use labels_entry::LabelsEntry;
pub use model_entry::ModelEntry;
pub use tables::TablesEntry;

/// Name that selects all metrics.
pub(crate) const ALL_METRICS: &str = "all";

/// A parsed and checked sweep file. Recordings are not read.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SweepFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Digest of the file's text.
    pub digest: Digest,
    /// Name of the sweep.
    pub name: String,
    /// Folders of recordings, or patterns of folders, relative to the folder of the file.
    pub datasets: Vec<String>,
    /// View to read from recordings with several pictures per sample, if stated; `left+right` joins two views side by side.
    pub view: Option<String>,
    /// Scenes whose recordings are acquired first: files relative to the folder of the file, or names of built-in scenes.
    pub scenes: Vec<String>,
    /// Tasks of the recordings whose labels are predicted, such as `slip`; empty for channels.
    pub labels: Vec<String>,
    /// Models, each with its own settings.
    pub models: Vec<ModelEntry>,
    /// Seeds of the sweep.
    pub seeds: Vec<u64>,
    /// Splits; a single `None` means the default split of each recording.
    pub splits: Vec<Option<String>>,
    /// Names of metrics and of groups of metrics.
    pub metrics: Vec<String>,
    /// Path of the file of sensor facts, if any.
    pub sensor: Option<PathBuf>,
    /// Path of the file of limits, if any, against which each unit is checked.
    pub limits: Option<PathBuf>,
    /// Varied settings, each with its list of values.
    pub vary: BTreeMap<String, Vec<String>>,
    /// Conditions that select combinations to skip.
    pub skip: Vec<Condition>,
    /// Tables that are scored in shards, if any. A sweep has either tables, or recordings and models.
    pub tables: Option<TablesEntry>,
    /// Resources that Slurm jobs request.
    pub slurm: SlurmSpec,
}

impl SweepFile {
    /// Base folder of relative paths in the file.
    pub fn folder(&self) -> &Path {
        folder_of(&self.path)
    }

    /// Error for an invalid value of `key`, with its line.
    pub fn wrong(&self, key: &str, problem: String) -> SweepError {
        let text = fs::read_to_string(&self.path).unwrap_or_default();
        FilePlace {
            path: &self.path,
            text: &text,
        }
        .wrong(key, problem)
    }
}

fn folder_of(path: &Path) -> &Path {
    taceva_files::parent_of(path)
}
