//! One evaluation of a sweep.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use taceva_evaluate::{EvaluateError, FitRequest};
use taceva_models::{ModelSettings, Models};

use crate::folder::SweepFolder;
use crate::key::TaskKey;

/// One evaluation of a sweep: a model with its settings, fitted on and scored on one recording, divided by one split and seed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Task {
    /// The name of its result.
    pub key: TaskKey,
    /// The recording as the file of the sweep names it.
    pub dataset: String,
    /// Where the recording is.
    pub path: PathBuf,
    /// The digest of all that the recording said when the sweep was planned, its header included.
    pub digest: String,
    /// The model.
    pub model: String,
    /// Every setting that the file of the sweep gives it.
    pub settings: BTreeMap<String, String>,
    /// The split; that of the recording if it is absent.
    pub split: Option<String>,
    /// The seed of the division and of whatever the model draws.
    pub seed: u64,
    /// The build of the plugin that offers the model, when the sweep was planned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plugin: Option<String>,
}

/// The word that says which shard of its tables a task is: `2/7`.
pub(crate) const SHARD: &str = "shard";

impl Task {
    /// What `name` is of this task: a setting, or `dataset`, `model`, `split`, `seed`.
    pub fn word(&self, name: &str) -> Option<String> {
        match name {
            "dataset" => Some(self.dataset.clone()),
            "model" => Some(self.model.clone()),
            "split" => self.split.clone(),
            "seed" => Some(self.seed.to_string()),
            _ => self.settings.get(name).cloned(),
        }
    }

    /// The model with its settings, without the recording, the split and the seed: `ridge size=32x32`.
    pub fn configuration(&self) -> String {
        let settings = self.settings.iter();
        let settings = settings.map(|(key, value)| format!(" {key}={value}"));
        format!("{}{}", self.model, settings.collect::<String>())
    }

    /// `reason` without the folders in which it came to be: with the name that the file gives the recording, and relative to the folder of the
    /// sweep. So it is the same wherever the task runs.
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

    /// Whether it asks for a device other than the processor.
    pub fn asks_for_device(&self) -> bool {
        let device = self.settings.get("device");
        device.is_some_and(|device| device != "cpu")
    }

    /// What is to be fitted.
    ///
    /// # Errors
    /// [`EvaluateError`] for a model that does not exist or a setting that it does not have.
    pub(crate) fn request(&self, models: &Models) -> Result<FitRequest, EvaluateError> {
        const SEED: &str = "seed";
        let model = models.find(&self.model)?;
        let settings = self.settings.iter();
        let settings = settings.map(|(key, value)| format!("{key}={value}"));
        // A model that draws nothing has no such setting.
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
