//! Settings as `key=value` words, with checks against known keys.

mod error;
mod suggestion;

pub use error::SettingError;
pub use suggestion::Suggestion;

use std::collections::BTreeMap;
use std::str::FromStr;

/// Description of one setting, for help texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SettingInfo {
    /// Key of the setting: the word before `=`.
    pub key: &'static str,
    /// Accepted values.
    pub accepts: &'static str,
    /// Default value, as a user would type it.
    pub default: &'static str,
    /// Meaning of the setting.
    pub about: &'static str,
}

impl SettingInfo {
    /// Setting that refits on training and validation parts, for models that choose settings on the validation part.
    pub(crate) const REFIT: SettingInfo = SettingInfo {
        key: "refit",
        accepts: "true or false",
        default: "true",
        about: "whether the model is fitted on the validation part too, once the settings are chosen",
    };
}

/// Settings as the user typed them, with unique keys.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ModelSettings {
    values: BTreeMap<String, String>,
}

impl ModelSettings {
    /// Parses `key=value` words.
    ///
    /// ```
    /// use taceva_models::ModelSettings;
    /// let settings = ModelSettings::parse(["size=32", "color=gray"])?;
    /// assert_eq!(settings.get("size"), Some("32"));
    /// # Ok::<(), taceva_models::SettingError>(())
    /// ```
    ///
    /// # Errors
    /// [`SettingError::Form`] without `=`, [`SettingError::Twice`] for a repeated key.
    pub fn parse<'a>(
        words: impl IntoIterator<Item = &'a str>,
    ) -> Result<ModelSettings, SettingError> {
        let mut values = BTreeMap::new();
        for word in words {
            let (key, value) = word
                .split_once('=')
                .ok_or_else(|| SettingError::Form { word: word.into() })?;
            if values.insert(key.into(), value.into()).is_some() {
                return Err(SettingError::Twice { key: key.into() });
            }
        }
        Ok(ModelSettings { values })
    }

    /// Value of `key` as the user typed it; `None` if the key is not set.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.values.get(key).map(String::as_str)
    }

    /// Settings as `key=value` words, sorted by key.
    pub fn words(&self) -> impl Iterator<Item = String> + '_ {
        self.values
            .iter()
            .map(|(key, value)| format!("{key}={value}"))
    }

    /// Adds each setting of `others` whose key is not set.
    pub(crate) fn or(mut self, others: &[(&str, &str)]) -> ModelSettings {
        for (key, value) in others {
            let entry = self.values.entry((*key).to_owned());
            entry.or_insert_with(|| (*value).to_owned());
        }
        self
    }

    /// Keys and values, sorted by key.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&String, &String)> {
        self.values.iter()
    }

    /// Splits the settings into settings with a key of `known`, and the other settings.
    pub fn partition(self, known: &[SettingInfo]) -> (ModelSettings, ModelSettings) {
        let is_known = |key: &String| known.iter().any(|info| info.key == key);
        let (inside, outside) = self.values.into_iter().partition(|(key, _)| is_known(key));
        (
            ModelSettings { values: inside },
            ModelSettings { values: outside },
        )
    }

    /// Rejects keys outside `known`.
    ///
    /// # Errors
    /// [`SettingError::Unknown`] with the most similar known key.
    pub fn check_keys(&self, known: &[SettingInfo]) -> Result<(), SettingError> {
        let keys: Vec<&str> = known.iter().map(|info| info.key).collect();
        self.check_names(&keys)
    }

    /// Rejects keys outside `known`.
    ///
    /// # Errors
    /// Errors of [`check_keys`](ModelSettings::check_keys).
    pub fn check_names(&self, known: &[&str]) -> Result<(), SettingError> {
        match self.values.keys().find(|key| !known.contains(&&key[..])) {
            None => Ok(()),
            Some(key) => Err(SettingError::Unknown {
                key: key.clone(),
                suggestion: Suggestion::of(key, known.iter().copied()),
            }),
        }
    }

    /// Parses the value of `key` with `read`, or returns `default` if the key is not set.
    ///
    /// # Errors
    /// [`SettingError::Value`] with the accepted values if `read` returns `None`.
    pub fn value<T>(
        &self,
        info: &SettingInfo,
        default: T,
        read: impl FnOnce(&str) -> Option<T>,
    ) -> Result<T, SettingError> {
        let Some(text) = self.get(info.key) else {
            return Ok(default);
        };
        read(text).ok_or_else(|| SettingError::Value {
            key: info.key,
            found: text.into(),
            accepts: info.accepts,
        })
    }
}

impl ModelSettings {
    /// Reads the setting [`SettingInfo::REFIT`], by default true.
    pub(crate) fn refit(&self) -> Result<bool, SettingError> {
        self.value(&SettingInfo::REFIT, true, |text| text.parse().ok())
    }
}

/// Parses a number within `range`; `None` if `text` is no such number.
pub(crate) fn number<T: FromStr + PartialOrd>(
    text: &str,
    range: impl std::ops::RangeBounds<T>,
) -> Option<T> {
    text.parse().ok().filter(|value| range.contains(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: SettingInfo = SettingInfo {
        key: "size",
        accepts: "a number from 1 to 9",
        default: "3",
        about: "how large",
    };

    #[test]
    fn an_unknown_key_names_the_nearest_one() {
        let settings = ModelSettings::parse(["sise=3"]).expect("well formed");
        let error = settings.check_keys(&[SIZE]).expect_err("unknown");
        assert_eq!(
            error.to_string(),
            "`sise`: unknown key, did you mean `size`?"
        );
    }

    #[test]
    fn a_key_near_to_nothing_lists_what_is_known() {
        let settings = ModelSettings::parse(["qqq=3"]).expect("well formed");
        let error = settings.check_keys(&[SIZE]).expect_err("unknown");
        assert_eq!(
            error.to_string(),
            "`qqq`: unknown key, expected one of size"
        );
    }

    #[test]
    fn a_value_out_of_range_says_what_is_accepted() {
        let settings = ModelSettings::parse(["size=12"]).expect("well formed");
        let error = settings
            .value(&SIZE, 3, |text| number(text, 1..=9))
            .expect_err("too large");
        assert_eq!(
            error.to_string(),
            "`size=12`: expected a number from 1 to 9"
        );
    }

    #[test]
    fn a_word_without_a_value_and_a_key_given_twice_are_refused() {
        assert!(matches!(
            ModelSettings::parse(["size"]),
            Err(SettingError::Form { .. })
        ));
        assert!(matches!(
            ModelSettings::parse(["size=1", "size=2"]),
            Err(SettingError::Twice { .. })
        ));
    }
}
