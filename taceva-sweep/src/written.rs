//! The file of a sweep as it is written, key by key.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;

use crate::limits::MOST_TASKS;
use crate::slurm_spec::SlurmSpec;

/// The file of a sweep as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenSweep {
    pub(crate) sweep_version: u32,
    #[serde(default)]
    pub(crate) name: String,
    #[serde(default)]
    pub(crate) datasets: Words,
    #[serde(default)]
    pub(crate) models: Vec<toml::Value>,
    #[serde(default)]
    pub(crate) seeds: Option<WrittenSeeds>,
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
    pub(crate) slurm: Option<SlurmSpec>,
}

/// One word, or a list of them.
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
    pub(crate) fn list(self) -> Vec<String> {
        match self {
            Words::One(word) => vec![word],
            Words::Several(words) => words,
        }
    }
}

/// Seeds: a list of numbers, or `"1-5"`.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum WrittenSeeds {
    List(Vec<u64>),
    Range(String),
}

impl WrittenSeeds {
    /// The seeds, or what is wrong with the words.
    pub(crate) fn list(self) -> Result<Vec<u64>, String> {
        let text = match self {
            WrittenSeeds::List(list) => return Ok(list),
            WrittenSeeds::Range(text) => text,
        };
        let ends = text.split_once('-');
        let ends = ends.and_then(|(first, last)| {
            let (first, last): (u64, u64) = (first.trim().parse().ok()?, last.trim().parse().ok()?);
            (first <= last).then_some((first, last))
        });
        let (first, last) = ends.ok_or(
            "`seeds`: expected a list such as [1, 2, 3], or the first and the last as in \"1-5\"",
        )?;
        // Counted before they are made: too many are refused, not allocated.
        match last - first {
            span if span < MOST_TASKS => Ok((first..=last).collect()),
            span => Err(format!(
                "a grid of {} tasks for each model by its seeds alone, {MOST_TASKS} are the most",
                u128::from(span) + 1
            )),
        }
    }
}

/// What makes no sense.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenSkip {
    #[serde(default)]
    pub(crate) r#where: Words,
}
