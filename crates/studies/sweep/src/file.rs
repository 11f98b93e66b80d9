//! The sweep file: settings that vary, and settings that stay.

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

pub use model_entry::ModelEntry;
pub use tables::TablesEntry;

/// The sweep file, parsed and checked; no recording was read.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SweepFile {
    /// Path of the file.
    pub path: PathBuf,
    /// The digest of its text.
    pub digest: Digest,
    /// Name of the sweep.
    pub name: String,
    /// Folders of recordings, and patterns of such, relative to the folder of the file.
    pub datasets: Vec<String>,
    /// The view of recordings whose samples have several pictures, or several side by side: `left+right`.
    pub view: Option<String>,
    /// Scenes whose recordings are acquired first: files, relative to the folder of the file, or names of built-in scenes.
    pub scenes: Vec<String>,
    /// The models, each with its own settings.
    pub models: Vec<ModelEntry>,
    /// The seeds.
    pub seeds: Vec<u64>,
    /// The splits; a single `None` for the default split of each recording.
    pub splits: Vec<Option<String>>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The file of sensor facts.
    pub sensor: Option<PathBuf>,
    /// The file of limits for each unit.
    pub limits: Option<PathBuf>,
    /// Settings that vary, each with its values.
    pub vary: BTreeMap<String, Vec<String>>,
    /// Combinations to skip.
    pub skip: Vec<Condition>,
    /// Tables that are scored in shards, instead of recordings and models.
    pub tables: Option<TablesEntry>,
    /// Resources that jobs request.
    pub slurm: SlurmSpec,
}

impl SweepFile {
    /// The folder that paths of the file are relative to.
    pub fn folder(&self) -> &Path {
        folder_of(&self.path)
    }

    /// The error for a value below `key`, with its line.
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
