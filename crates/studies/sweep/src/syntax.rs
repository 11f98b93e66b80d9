//! Deserialised sweep file, key by key.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;

use crate::slurm_spec::SlurmSpec;

/// Deserialised sweep file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenSweep {
    pub(crate) sweep_version: u32,
    #[serde(default)]
    pub(crate) name: String,
    #[serde(default)]
    pub(crate) datasets: Words,
    #[serde(default)]
    pub(crate) view: Option<String>,
    #[serde(default)]
    pub(crate) scenes: Words,
    #[serde(default)]
    pub(crate) task: Words,
    #[serde(default)]
    pub(crate) models: Vec<toml::Value>,
    #[serde(default)]
    pub(crate) seeds: Option<toml::Value>,
    #[serde(default)]
    pub(crate) splits: Vec<String>,
    #[serde(default)]
    pub(crate) metrics: Vec<String>,
    #[serde(default)]
    pub(crate) sensor: Option<PathBuf>,
    #[serde(default)]
    pub(crate) limits: Option<PathBuf>,
    #[serde(default)]
    pub(crate) vary: BTreeMap<String, Vec<toml::Value>>,
    #[serde(default)]
    pub(crate) skip: WrittenSkip,
    #[serde(default)]
    pub(crate) score: Option<WrittenScore>,
    #[serde(default)]
    pub(crate) slurm: Option<SlurmSpec>,
}

/// One word or a list of words.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Words {
    One(String),
    Several(Vec<String>),
}

impl Default for Words {
    fn default() -> Words {
        Words::Several(Vec::new())
    }
}

impl Words {
    /// True if there are no words.
    pub(crate) fn is_empty(&self) -> bool {
        matches!(self, Words::Several(words) if words.is_empty())
    }

    pub(crate) fn list(self) -> Vec<String> {
        match self {
            Words::One(word) => vec![word],
            Words::Several(words) => words,
        }
    }

    pub(crate) fn as_slice(&self) -> &[String] {
        match self {
            Words::One(word) => std::slice::from_ref(word),
            Words::Several(words) => words,
        }
    }
}

/// Tables that are scored in shards.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenScore {
    pub(crate) truth: PathBuf,
    pub(crate) pred: PathBuf,
    pub(crate) shards: u32,
    #[serde(default)]
    pub(crate) units: BTreeMap<String, String>,
    #[serde(default)]
    pub(crate) allow_invalid: bool,
    #[serde(default)]
    pub(crate) task: Words,
    #[serde(default)]
    pub(crate) cluster: Option<String>,
    #[serde(default)]
    pub(crate) threshold: BTreeMap<String, toml::Value>,
    #[serde(default)]
    pub(crate) debounce: BTreeMap<String, toml::Value>,
}

/// Combinations to skip.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenSkip {
    #[serde(default)]
    pub(crate) r#where: Words,
}
