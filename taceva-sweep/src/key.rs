//! The name of a task's result: the digest of everything that decides it.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};
use taceva_dataset::Digest;

/// Counted on when the result of the same parts becomes another one within a version of this program.
const VERSION: &str = "1";
/// Hexadecimal digits of a key, 128 bits.
const DIGITS: usize = 32;

/// The name of a task's result.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct TaskKey(String);

/// What decides the result of a task.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeyParts<'a> {
    pub(crate) dataset: Digest,
    pub(crate) model: &'a str,
    pub(crate) settings: &'a BTreeMap<String, String>,
    pub(crate) split: Option<&'a str>,
    pub(crate) seed: u64,
    pub(crate) metrics: &'a [String],
    /// The digest of the file that says what is known of the sensor.
    pub(crate) sensor: Option<Digest>,
}

impl TaskKey {
    pub(crate) fn of(parts: KeyParts<'_>) -> TaskKey {
        let mut bytes = Vec::new();
        // Each part with its length, so that no two sequences of parts run together.
        let mut part = |text: &str| {
            bytes.extend((text.len() as u64).to_le_bytes());
            bytes.extend(text.as_bytes());
        };
        for text in ["taceva-sweep", VERSION, env!("CARGO_PKG_VERSION")] {
            part(text);
        }
        part(&parts.dataset.to_string());
        part(parts.model);
        part(&parts.settings.len().to_string());
        for (key, value) in parts.settings {
            part(key);
            part(value);
        }
        part(parts.split.unwrap_or_default());
        part(&parts.seed.to_string());
        part(&parts.metrics.join(","));
        part(
            &parts
                .sensor
                .map_or_else(String::new, |digest| digest.to_string()),
        );
        let digest = Digest::of(&bytes);
        let digits = digest.as_bytes().iter().map(|byte| format!("{byte:02x}"));
        TaskKey(digits.collect::<String>()[..DIGITS].to_owned())
    }

    /// Its digits.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether `text` has the form of a key, so that it may name a file.
    pub(crate) fn is_one(text: &str) -> bool {
        let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
        text.len() == DIGITS && text.bytes().all(is_digit)
    }
}

impl fmt::Display for TaskKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_a_task_is_part_of_its_key_and_none_runs_into_another() {
        let of = |model: &str,
                  settings: &[(&str, &str)],
                  split: Option<&str>,
                  seed: u64,
                  metrics: &str| {
            let settings = settings.iter();
            let settings = settings.map(|(key, value)| ((*key).to_owned(), (*value).to_owned()));
            TaskKey::of(KeyParts {
                dataset: Digest::of(b"data"),
                model,
                settings: &settings.collect(),
                split,
                seed,
                metrics: &[metrics.to_owned()],
                sensor: None,
            })
        };
        let keys = [
            of("ridge", &[], None, 1, "all"),
            of("ridge", &[], None, 2, "all"),
            of("ridge", &[("size", "32x32")], None, 1, "all"),
            of("ridge", &[("siz", "e32x32")], None, 1, "all"),
            of("ridge", &[], Some("by-point"), 1, "all"),
            of("pls", &[], None, 1, "all"),
            of("ridge", &[], None, 1, "accuracy"),
        ];
        for (at, key) in keys.iter().enumerate() {
            assert!(TaskKey::is_one(key.as_str()), "{key}");
            assert!(keys[..at].iter().all(|other| other != key), "{key}");
        }
        assert_eq!(of("ridge", &[], None, 1, "all"), keys[0]);
        assert!(!TaskKey::is_one("../../etc/passwd"));
    }
}
