//! The file of a sweep: what varies, and what stays.

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

/// The file of a sweep, read and checked; nothing of the recordings was looked at.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SweepFile {
    /// Where it is.
    pub path: PathBuf,
    /// The digest of its text.
    pub digest: Digest,
    /// What it is called.
    pub name: String,
    /// Folders of recordings, and patterns of such, relative to the folder of the file.
    pub datasets: Vec<String>,
    /// The view of recordings whose samples have several pictures, or several side by side: `left+right`.
    pub view: Option<String>,
    /// Scenes whose recordings are acquired first: files, relative to the folder of the file, or names of those that are built in.
    pub scenes: Vec<String>,
    /// The models, each with settings of its own.
    pub models: Vec<ModelEntry>,
    /// The seeds.
    pub seeds: Vec<u64>,
    /// The splits; that of each recording where the file names none.
    pub splits: Vec<Option<String>>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The file that says what is known of the sensor.
    pub sensor: Option<PathBuf>,
    /// The file of limits that each unit is held to.
    pub limits: Option<PathBuf>,
    /// Settings, each with the values that it takes in turn.
    pub vary: BTreeMap<String, Vec<String>>,
    /// Combinations that make no sense.
    pub skip: Vec<Condition>,
    /// Tables that are scored in shards, in the place of recordings and models.
    pub tables: Option<TablesEntry>,
    /// How jobs are asked for.
    pub slurm: SlurmSpec,
}

impl SweepFile {
    /// The folder that paths of the file are relative to.
    pub fn folder(&self) -> &Path {
        folder_of(&self.path)
    }

    /// What is wrong with what stands below `key`, with its line.
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
