//! One evaluation of a sweep.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use taceva_core::Unit;
use taceva_evaluate::{EvaluateError, FitRequest};
use taceva_metrics::Better;
use taceva_models::{ModelSettings, Models};
use taceva_results::Score;
use taceva_tasks::TaskScore;

use crate::folder::SweepFolder;
use crate::key::TaskKey;

/// One evaluation of a sweep: a model with its settings, fitted and scored on one recording with one split and seed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Task {
    /// Key of the task's result.
    pub key: TaskKey,
    /// Name of the recording in the sweep file.
    pub dataset: String,
    /// Path of the recording.
    pub path: PathBuf,
    /// Digest of the whole recording, including its header, at the time of planning.
    pub digest: String,
    /// Task of the recording whose labels are predicted, such as `slip`; `None` for channels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub labels: Option<String>,
    /// Name of the model.
    pub model: String,
    /// All settings that the sweep file gives for this task.
    pub settings: BTreeMap<String, String>,
    /// Name of the split; `None` for the default of the recording.
    pub split: Option<String>,
    /// Seed of the split and of the random draws of the model.
    pub seed: u64,
    /// Build of the plugin that provides the model, at the time of planning; `None` for a built-in model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plugin: Option<String>,
}

/// Name of the setting that contains the shard of a task: `2/7`.
pub(crate) const SHARD: &str = "shard";

impl Task {
    /// Value of `name` in this task; `None` if the task has no such value. The name is a setting, or `dataset`, `task`, `model`, `split` or `seed`.
    pub fn word(&self, name: &str) -> Option<String> {
        match name {
            "dataset" => Some(self.dataset.clone()),
            "task" => self.labels.clone(),
            "model" => Some(self.model.clone()),
            "split" => self.split.clone(),
            "seed" => Some(self.seed.to_string()),
            _ => self.settings.get(name).cloned(),
        }
    }

    /// Model with its settings, without recording, split and seed, such as `ridge size=32x32`.
    pub fn configuration(&self) -> String {
        let settings = self.settings.iter();
        let settings = settings.map(|(key, value)| format!(" {key}={value}"));
        format!("{}{}", self.model, settings.collect::<String>())
    }

    /// Direction in which `score` improves.
    pub(crate) fn better(&self, score: &Score) -> Better {
        let unit = (score.unit != Unit::One).then(|| score.unit.symbol());
        match &self.labels {
            Some(_) => TaskScore::direction(&score.metric, unit),
            None => score.better(),
        }
    }

    /// Model with its settings, and the task whose labels it predicts: `lda size=32x32, task slip`.
    pub(crate) fn title(&self) -> String {
        match &self.labels {
            Some(labels) => format!("{}, task {labels}", self.configuration()),
            None => self.configuration(),
        }
    }

    /// Split as text. Without a split: `by clusters` if the task predicts labels, else `as recorded`.
    pub(crate) fn division(&self) -> &str {
        match (&self.split, &self.labels) {
            (Some(split), _) => split,
            (None, Some(_)) => "by clusters",
            (None, None) => "as recorded",
        }
    }

    /// Replaces the path of the recording in `reason` by the recording's name, and makes other paths relative to the sweep folder. The text is then the same on
    /// every machine.
    pub(crate) fn without_folders(&self, reason: &str, folder: &SweepFolder) -> String {
        let mut reason = reason.to_owned();
        let own = folder.path();
        let absolute = std::path::absolute(own).unwrap_or_else(|_| own.to_owned());
        for (path, name) in [
            (self.path.as_path(), self.dataset.as_str()),
            (absolute.as_path(), "."),
        ] {
            let path = path.to_string_lossy();
            if path.len() > 1 {
                reason = reason.replace(&*path, name);
            }
        }
        reason
    }

    /// True if the task needs a device other than the processor.
    pub fn asks_for_device(&self) -> bool {
        let device = self.settings.get("device");
        device.is_some_and(|device| device != "cpu")
    }

    /// Request that fits the model.
    ///
    /// # Errors
    /// [`EvaluateError`] for an unknown model or setting.
    pub(crate) fn request(&self, models: &Models) -> Result<FitRequest, EvaluateError> {
        const SEED: &str = "seed";
        let model = models.find(&self.model)?;
        let settings = self.settings.iter();
        let settings = settings.map(|(key, value)| format!("{key}={value}"));
        // A model without random draws has no such setting.
        let draws = model.setting_keys().contains(&SEED) && !self.settings.contains_key(SEED);
        let seed = draws.then(|| format!("{SEED}={}", self.seed));
        let words: Vec<String> = settings.chain(seed).collect();
        Ok(FitRequest {
            model,
            settings: ModelSettings::parse(words.iter().map(String::as_str))?,
            channels: Vec::new(),
            split: self.split.clone(),
            seed: self.seed,
        })
    }
}
