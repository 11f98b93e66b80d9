//! The file of a sweep: what varies, and what stays.

mod model_entry;
mod place;
mod tables;
mod vary;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use taceva_dataset::{Digest, read_toml};
use taceva_models::SplitSpec;

use crate::condition::Condition;
use crate::error::SweepError;
use crate::seeds::seeds;
use crate::slurm_spec::SlurmSpec;
use crate::written::WrittenSweep;
use place::FilePlace;
use vary::vary;

pub use model_entry::ModelEntry;
pub use tables::TablesEntry;

/// The version of the form that this program reads.
const VERSION: u32 = 1;

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
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`SweepError`] with the line and the nearest key where one is unknown, and for what cannot be meant.
    pub fn read(path: &Path) -> Result<SweepFile, SweepError> {
        let written: WrittenSweep = read_toml(path)?;
        let text = fs::read_to_string(path).map_err(SweepError::io("read", path))?;
        let place = FilePlace { path, text: &text };
        if written.sweep_version != VERSION {
            return Err(place.wrong(
                "sweep_version",
                format!(
                    "version {} of the form; this program reads version {VERSION}",
                    written.sweep_version
                ),
            ));
        }
        if written.score.is_some() {
            tables::check_alone(&written, place)?;
        }
        let folder = folder_of(path);
        let tables = written.score.as_ref();
        let tables = tables.map(|score| tables::TablesEntry::of(score, folder, place));
        let models = written.models.iter();
        let models: Vec<ModelEntry> = models
            .map(|value| ModelEntry::of(value, place))
            .collect::<Result<_, _>>()?;
        let vary = vary(written.vary, &models, place)?;
        let seeds = match &written.seeds {
            None => vec![0],
            Some(written) => seeds(written).map_err(|problem| place.wrong("seeds", problem))?,
        };
        place.check_distinct("seeds", &seeds)?;
        place.check_distinct("splits", &written.splits)?;
        for split in &written.splits {
            let known = split.parse::<SplitSpec>();
            known.map_err(|error| place.wrong("splits", error.to_string()))?;
        }
        let datasets = written.datasets.list();
        place.check_distinct("datasets", &datasets)?;
        let splits = match written.splits.is_empty() {
            true => vec![None],
            false => written.splits.into_iter().map(Some).collect(),
        };
        let metrics = match written.metrics.is_empty() {
            true => vec!["all".to_owned()],
            false => written.metrics,
        };
        let skip = written.skip.r#where.list();
        let skip = skip.iter().map(|text| {
            Condition::parse(text).map_err(|error| place.wrong("where", error.to_string()))
        });
        let beside = |file: PathBuf| folder.join(file);
        Ok(SweepFile {
            path: path.to_owned(),
            digest: Digest::of(text.as_bytes()),
            name: written.name,
            datasets,
            models,
            seeds,
            splits,
            metrics,
            sensor: written.sensor.map(beside),
            limits: written.limits.map(beside),
            vary,
            skip: skip.collect::<Result<_, _>>()?,
            tables: tables.transpose()?,
            slurm: written.slurm.unwrap_or_default(),
        })
    }

    /// The folder that paths of the file are relative to.
    pub fn folder(&self) -> &Path {
        folder_of(&self.path)
    }

    /// What is wrong with what stands below `key`, with its line.
    pub(crate) fn wrong(&self, key: &str, problem: String) -> SweepError {
        let text = fs::read_to_string(&self.path).unwrap_or_default();
        FilePlace {
            path: &self.path,
            text: &text,
        }
        .wrong(key, problem)
    }
}

fn folder_of(path: &Path) -> &Path {
    taceva_durable::parent_of(path)
}
