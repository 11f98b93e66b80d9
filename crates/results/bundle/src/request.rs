//! Request of a bundle.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use crate::author::Author;
use crate::organization::Organization;
use crate::redaction::Redaction;

/// Inputs and settings for making a bundle.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BundleRequest {
    /// Folder of a run, or the JSON of `run`, `evaluate`, `score` or `merge`.
    pub result: PathBuf,
    /// Day on which the bundle is made, such as `2026-11-28`.
    pub created: String,
    /// Name of the bundle for readers; `None` to use the sensors of the results.
    pub name: Option<String>,
    /// Authors; empty for a draft.
    pub authors: Vec<Author>,
    /// Organization of the authors, which publishes the bundle; `None` if not given.
    pub organization: Option<Organization>,
    /// SPDX identifier of the licence; `None` for a draft.
    pub licence: Option<String>,
    /// States of the results, for results of one study.
    pub states: Vec<PathBuf>,
    /// Scored tables of truth and predictions, for results of one study; `None` without tables.
    pub tables: Option<ScoredTables>,
    /// Recordings whose headers are added, with their pictures if `adds_frames` is true. Not needed for a run.
    pub datasets: Vec<PathBuf>,
    /// Text files that are added under their names: `scene.toml`, `rig.toml`, `map.toml`, `limits.toml`, `tasks.toml`.
    pub texts: Vec<PathBuf>,
    /// Model files of the results.
    pub models: Vec<PathBuf>,
    /// True if model files are added; model files of a run come from its folder. Otherwise the bundle states only their digests.
    pub adds_models: bool,
    /// True if the pictures behind predictions are added, with the labels of their recordings. Otherwise the bundle states only the digests of the
    /// recordings.
    pub adds_frames: bool,
    /// True if tables are left out, and only their digests are stated.
    pub withholds_predictions: bool,
    /// Kinds of words that are redacted in texts.
    pub redactions: Vec<Redaction>,
    /// Number of threads.
    pub jobs: NonZeroUsize,
}

/// Scored tables of truth and predictions.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ScoredTables {
    /// Path of the table of truth.
    pub truth: PathBuf,
    /// Path of the table of predictions.
    pub prediction: PathBuf,
    /// Name of the key column that the caller chose; `None` to find the column by its name.
    pub key: Option<String>,
}

impl ScoredTables {
    /// Pairs the rows of two tables by the column `key`; `None` finds the column by its name.
    pub fn new(truth: &Path, prediction: &Path, key: Option<&str>) -> ScoredTables {
        ScoredTables {
            truth: truth.to_owned(),
            prediction: prediction.to_owned(),
            key: key.map(str::to_owned),
        }
    }
}

impl BundleRequest {
    /// Request for a draft bundle of the results at `result`, made on the day `created`, on one thread.
    pub fn new(result: &Path, created: &str) -> BundleRequest {
        BundleRequest {
            result: result.to_owned(),
            created: created.to_owned(),
            name: None,
            authors: Vec::new(),
            organization: None,
            licence: None,
            states: Vec::new(),
            tables: None,
            datasets: Vec::new(),
            texts: Vec::new(),
            models: Vec::new(),
            adds_models: false,
            adds_frames: false,
            withholds_predictions: false,
            redactions: Vec::new(),
            jobs: NonZeroUsize::MIN,
        }
    }
}
