//! Models of a sweep with their own settings.

use std::collections::BTreeMap;

use taceva_models::{Preset, Suggestion};

use super::place::FilePlace;
use crate::error::SweepError;

/// A model with its own settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelEntry {
    /// Name of the model.
    pub name: String,
    /// Settings of the model, by key.
    pub set: BTreeMap<String, String>,
}

impl ModelEntry {
    /// Parses an entry: a name, or `{ name = …, set = { … } }`.
    pub(super) fn of(value: &toml::Value, place: FilePlace<'_>) -> Result<ModelEntry, SweepError> {
        const KEYS: [&str; 2] = ["name", "set"];
        let table = match value {
            toml::Value::String(name) => return Ok(ModelEntry::asked(name, BTreeMap::new())),
            toml::Value::Table(table) => table,
            _ => {
                let problem = "`models`: expected names, or { name = \"…\", set = { … } }";
                return Err(place.wrong("models", problem.to_owned()));
            }
        };
        if let Some(key) = table.keys().find(|key| !KEYS.contains(&key.as_str())) {
            let suggestion = Suggestion::of(key, KEYS);
            return Err(place.wrong(
                key,
                format!("`{key}`: unknown key of a model, {suggestion}"),
            ));
        }
        let name = table.get("name").and_then(toml::Value::as_str);
        let name = name.ok_or_else(|| {
            place.wrong(
                "models",
                "`models`: the key `name` of a model is missing".to_owned(),
            )
        })?;
        let set = settings(name, table.get("set"), place)?;
        Ok(ModelEntry::asked(name, set))
    }

    /// Entry for the model or preset `name`. A preset is replaced by its model and settings, so that keys and tables name the fitted model.
    fn asked(name: &str, mut set: BTreeMap<String, String>) -> ModelEntry {
        let Some(preset) = Preset::named(name) else {
            return ModelEntry {
                name: name.to_owned(),
                set,
            };
        };
        for (key, value) in preset.settings {
            let entry = set.entry((*key).to_owned());
            entry.or_insert_with(|| (*value).to_owned());
        }
        ModelEntry {
            name: preset.model.to_owned(),
            set,
        }
    }
}

/// Parses the model-specific settings of an entry.
fn settings(
    name: &str,
    written: Option<&toml::Value>,
    place: FilePlace<'_>,
) -> Result<BTreeMap<String, String>, SweepError> {
    let own = match written {
        None => None,
        Some(toml::Value::Table(own)) => Some(own),
        Some(_) => {
            let problem = format!("`set` of the model {name}: expected {{ KEY = VALUE, … }}");
            return Err(place.wrong("set", problem));
        }
    };
    let mut set = BTreeMap::new();
    for (key, value) in own.into_iter().flatten() {
        let text = word(value).ok_or_else(|| {
            place.wrong(
                key,
                format!("`{key}` of the model {name}: expected a string, a number, true or false"),
            )
        })?;
        set.insert(key.clone(), text);
    }
    Ok(set)
}

/// Text of a setting as users type it; `None` if the value has no such text.
pub(super) fn word(value: &toml::Value) -> Option<String> {
    match value {
        toml::Value::String(text) => Some(text.clone()),
        toml::Value::Integer(number) => Some(number.to_string()),
        toml::Value::Float(number) => Some(number.to_string()),
        toml::Value::Boolean(value) => Some(value.to_string()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_preset_is_its_model_with_its_settings_but_for_those_of_the_file() {
        let own = BTreeMap::from([("jitter".to_owned(), "0".to_owned())]);
        let entry = ModelEntry::asked("fast", own);
        assert_eq!(entry.name, "cnn");
        let words: Vec<String> = entry
            .set
            .iter()
            .map(|(key, value)| format!("{key}={value}"))
            .collect();
        assert_eq!(
            words,
            [
                "appearance=auto",
                "color=auto",
                "difference=in-color",
                "epochs=170",
                "jitter=0",
                "size=up-to-80x60"
            ]
        );
        // A name that is not a preset stays, and is rejected later.
        assert_eq!(ModelEntry::asked("fats", BTreeMap::new()).name, "fats");
    }
}
