//! Options of the command line that replace values of a scene.

use std::path::PathBuf;

use taceva_models::ModelSettings;
use taceva_protocol::{ModelSpec, Setting};

use crate::error::AcquireError;

/// Values that replace the seed, the rig file, or the model settings of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// Seed of all random draws of the scene; `None` keeps the seed of the scene.
    pub seed: Option<u64>,
    /// Rig file whose devices replace the devices of every study that makes presses, if any. A relative path refers to the working directory.
    pub rig: Option<PathBuf>,
    /// Model of every study, if any. It replaces the scene's model and that model's settings, and keeps its folds or split.
    pub model: Option<String>,
    /// Settings of the model, as `key=value`. Other settings of the scene are kept.
    pub set: Vec<String>,
    /// Seeds of repeated fits of the models. Presses, split and scored samples do not change.
    pub seeds: Vec<u64>,
}

impl Overrides {
    /// Replaces the model of `study`, or some of its settings.
    pub(super) fn exchange_model(
        &self,
        study: &str,
        model: &mut Option<ModelSpec>,
    ) -> Result<(), AcquireError> {
        if let Some(name) = &self.model {
            // Folds and splits divide the points, whatever the model.
            let ModelSpec { folds, split, .. } = model.take().unwrap_or_default();
            *model = Some(ModelSpec {
                name: Some(Setting::default_of(name.clone())),
                folds,
                split,
                ..ModelSpec::default()
            });
        }
        if self.set.is_empty() && self.seeds.is_empty() {
            return Ok(());
        }
        let Some(model) = model.as_mut().filter(|model| model.name.is_some()) else {
            let needed = "settings and seeds need a model that is fitted: name one with --model";
            return Err(AcquireError::Request(format!("study `{study}`: {needed}")));
        };
        // Rejects invalid settings with the same messages as other commands.
        let set = ModelSettings::parse(self.set.iter().map(String::as_str))?;
        for word in set.words() {
            if let Some((key, value)) = word.split_once('=') {
                let value = toml::Value::String(value.to_owned());
                model.set.insert(key.to_owned(), value);
            }
        }
        Ok(())
    }
}
