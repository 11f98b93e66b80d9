//! Names of plugins and of their drivers.

use std::borrow::Borrow;
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use taceva_core::{DriverKey, DriverKeyError};

/// Name of a plugin in reverse DNS, such as `org.example.digit`: at least two words joined by `.`. A word has lower-case letters, digits and `-`, and
/// begins with a letter.
///
/// ```
/// use taceva_host::PluginId;
/// let id: PluginId = "org.example.digit".parse()?;
/// assert_eq!(id.driver("digit-360")?.as_str(), "org.example.digit/digit-360");
/// assert!("digit".parse::<PluginId>().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct PluginId(String);

/// Maximum length of an id, bytes.
const LENGTH_MAX: usize = 96;

impl PluginId {
    /// Text of the id.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Key of the plugin's driver `key`, as users write it.
    ///
    /// # Errors
    /// [`DriverKeyError`] if `key` is not a valid word of a driver key.
    pub fn driver(&self, key: &str) -> Result<DriverKey, DriverKeyError> {
        format!("{self}/{key}").parse()
    }

    /// Key of the plugin as a whole, for errors without a particular driver.
    pub fn as_driver(&self) -> DriverKey {
        let key = self.0.parse();
        key.expect("every id is a word of a driver key")
    }
}

fn is_id(text: &str) -> bool {
    let is_word = |word: &str| {
        word.starts_with(|first: char| first.is_ascii_lowercase())
            && word
                .bytes()
                .all(|byte| matches!(byte, b'a'..=b'z' | b'0'..=b'9' | b'-'))
    };
    text.len() <= LENGTH_MAX && text.contains('.') && text.split('.').all(is_word)
}

impl FromStr for PluginId {
    type Err = PluginIdError;

    fn from_str(text: &str) -> Result<PluginId, PluginIdError> {
        if is_id(text) {
            Ok(PluginId(text.to_owned()))
        } else {
            Err(PluginIdError {
                text: text.to_owned(),
            })
        }
    }
}

impl TryFrom<String> for PluginId {
    type Error = PluginIdError;

    fn try_from(text: String) -> Result<PluginId, PluginIdError> {
        text.parse()
    }
}

impl From<PluginId> for String {
    fn from(id: PluginId) -> String {
        id.0
    }
}

impl Borrow<str> for PluginId {
    fn borrow(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for PluginId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Invalid plugin id.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} is not a plugin id, expected lower-case words joined by `.` such as `org.example.digit`, at most {LENGTH_MAX} bytes"
)]
pub struct PluginIdError {
    text: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_lower_case_words_joined_by_dots() {
        for good in ["org.example", "org.example.digit-360", "a.b.c2"] {
            assert!(good.parse::<PluginId>().is_ok(), "{good}");
        }
        let long = format!("org.{}", "a".repeat(LENGTH_MAX));
        let bad = [
            "", "digit", "org.", ".org", "Org.x", "org.2x", "org/x", "org.x y", "o.\u{e9}", &long,
        ];
        for bad in bad {
            assert!(bad.parse::<PluginId>().is_err(), "{bad}");
        }
    }
}
