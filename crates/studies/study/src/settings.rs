//! Settings of models as a scene writes them.

use std::collections::BTreeMap;

use taceva_models::{ModelSettings, SettingError};

/// Settings as a scene writes them, by name.
///
/// # Errors
/// [`SettingError`] for a name that is none.
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
