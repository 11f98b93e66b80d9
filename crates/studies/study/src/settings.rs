//! Model settings of a scene.

use std::collections::BTreeMap;

use taceva_models::{ModelSettings, SettingError};

/// Model settings of a scene, from the table `set` of values by name.
///
/// # Errors
/// [`SettingError`] for an invalid name.
pub(crate) fn settings_of(
    set: &BTreeMap<String, toml::Value>,
) -> Result<ModelSettings, SettingError> {
    let words: Vec<String> = set
        .iter()
        .map(|(key, value)| match value {
            toml::Value::String(text) => format!("{key}={text}"),
            other => format!("{key}={other}"),
        })
        .collect();
    ModelSettings::parse(words.iter().map(String::as_str))
}
