//! Values that stand in the place of those that a scene writes, so that it need not be edited.

use std::path::PathBuf;

use taceva_models::ModelSettings;
use taceva_protocol::{ModelSpec, Setting};

use crate::error::AcquireError;

/// What stands in the place of what a scene says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// The seed of every draw of the scene.
    pub seed: Option<u64>,
    /// The rig file whose devices every study presses with, in the place of those that the scene names; relative to the working folder.
    pub rig: Option<PathBuf>,
    /// The model of every study, without the settings that the scene has for another.
    pub model: Option<String>,
    /// Settings of the model, as `key=value`; those of the scene that are not named stay.
    pub set: Vec<String>,
    /// The seeds that models are fitted with: presses, division and what is scored stay as they are.
    pub seeds: Vec<u64>,
}

impl Overrides {
    /// Replaces the model of `study`, or its settings.
    pub(super) fn exchange_model(
        &self,
        study: &str,
        model: &mut Option<ModelSpec>,
    ) -> Result<(), AcquireError> {
        if let Some(name) = &self.model {
            *model = Some(ModelSpec {
                name: Some(Setting::default_of(name.clone())),
                ..ModelSpec::default()
            });
        }
        if self.set.is_empty() && self.seeds.is_empty() {
            return Ok(());
        }
        let Some(model) = model.as_mut().filter(|model| model.name.is_some()) else {
            let needed =
                "no model is fitted that could have settings or seeds; name one with --model";
            return Err(AcquireError::Request(format!("study `{study}`: {needed}")));
        };
        // Refused as they are in every other command.
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
