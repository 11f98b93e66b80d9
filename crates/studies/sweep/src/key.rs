//! Key of a task's result: the digest of all inputs of the task.

mod shard;

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};
use taceva_dataset::Digest;

pub(crate) use shard::{LabelShardParts, ShardParts};

/// Version of the key. It must be incremented if the same inputs give another result within one version of this program.
const VERSION: &str = "2";
/// Number of hexadecimal digits of a key, which encode 128 bits.
const DIGITS: usize = 32;

/// Key of the result of a task.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct TaskKey(String);

/// Inputs that determine the result of a task.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeyParts<'a> {
    pub(crate) dataset: Digest,
    pub(crate) model: &'a str,
    pub(crate) settings: &'a BTreeMap<String, String>,
    pub(crate) split: Option<&'a str>,
    pub(crate) seed: u64,
    pub(crate) metrics: &'a [String],
    /// Digest of the file of sensor facts, if any.
    pub(crate) sensor: Option<Digest>,
    /// Build of the plugin that provides the model; `None` for a built-in model.
    pub(crate) plugin: Option<&'a str>,
    /// Task whose labels are predicted; `None` for channels.
    pub(crate) labels: Option<&'a str>,
}

/// Parts of a key, each preceded by its length, so that different parts give different bytes.
struct KeyBytes(Vec<u8>);

impl KeyBytes {
    fn new(what: &str) -> KeyBytes {
        let mut bytes = KeyBytes(Vec::new());
        for text in [what, VERSION, env!("CARGO_PKG_VERSION")] {
            bytes.part(text);
        }
        bytes
    }

    fn part(&mut self, text: &str) {
        self.0.extend((text.len() as u64).to_le_bytes());
        self.0.extend(text.as_bytes());
    }

    fn finish(self) -> TaskKey {
        let digest = Digest::of(&self.0);
        let digits = digest.as_bytes().iter().map(|byte| format!("{byte:02x}"));
        TaskKey(digits.collect::<String>()[..DIGITS].to_owned())
    }
}

impl TaskKey {
    pub(crate) fn of(parts: KeyParts<'_>) -> TaskKey {
        let mut bytes = KeyBytes::new("taceva-sweep");
        bytes.part(&parts.dataset.to_string());
        bytes.part(parts.model);
        bytes.part(&parts.settings.len().to_string());
        for (key, value) in parts.settings {
            bytes.part(key);
            bytes.part(value);
        }
        bytes.part(parts.split.unwrap_or_default());
        bytes.part(&parts.seed.to_string());
        bytes.part(&parts.metrics.join(","));
        bytes.part(&text_of(parts.sensor));
        bytes.part(parts.plugin.unwrap_or_default());
        if let Some(labels) = parts.labels {
            bytes.part(labels);
        }
        bytes.finish()
    }

    /// Hexadecimal digits of the key.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// True if `text` has the form of a key, and is therefore a safe file name.
    pub(crate) fn is_one(text: &str) -> bool {
        let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
        text.len() == DIGITS && text.bytes().all(is_digit)
    }
}

fn text_of(digest: Option<Digest>) -> String {
    digest.map_or_else(String::new, |digest| digest.to_string())
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
                  metrics: &str,
                  [plugin, labels]: [Option<&str>; 2]| {
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
                plugin,
                labels,
            })
        };
        let keys = [
            of("ridge", &[], None, 1, "all", [None; 2]),
            of("ridge", &[], None, 2, "all", [None; 2]),
            of("ridge", &[("size", "32x32")], None, 1, "all", [None; 2]),
            of("ridge", &[("siz", "e32x32")], None, 1, "all", [None; 2]),
            of("ridge", &[], Some("by-point"), 1, "all", [None; 2]),
            of("pls", &[], None, 1, "all", [None; 2]),
            of("ridge", &[], None, 1, "accuracy", [None; 2]),
            of("ridge", &[], None, 1, "all", [Some("sha256:1"), None]),
            of("ridge", &[], None, 1, "all", [Some("sha256:2"), None]),
            of("ridge", &[], None, 1, "all", [None, Some("slip")]),
            of("ridge", &[], None, 1, "all", [None, Some("grasp")]),
        ];
        for (at, key) in keys.iter().enumerate() {
            assert!(TaskKey::is_one(key.as_str()), "{key}");
            assert!(keys[..at].iter().all(|other| other != key), "{key}");
        }
        assert_eq!(of("ridge", &[], None, 1, "all", [None; 2]), keys[0]);
        assert!(!TaskKey::is_one("../../etc/passwd"));
    }
}
