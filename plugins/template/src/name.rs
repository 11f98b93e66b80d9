//! Names of new plugins.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// Name of a project, of its crate and of its driver: a lower-case letter, then letters, digits and single `-`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(String);

/// Maximum length of a name, bytes. With the prefix `org.example.`, it is still a valid id.
const LENGTH_MAX: usize = 64;

/// Words reserved by the language, its libraries, or dependencies of a project.
const TAKEN: &str = "\
    abstract alloc as async await become box break const continue core crate do dyn \
    else enum extern false final fn for gen if impl in let loop macro \
    match mod move mut override priv pub ref return self static std struct super \
    taceva-abi taceva-core taceva-plugin test trait true try type typeof unsafe unsized use virtual where \
    while yield";

impl Name {
    /// Name as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Name of the crate in code and in its library file.
    pub fn as_crate(&self) -> String {
        self.0.replace('-', "_")
    }
}

impl FromStr for Name {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Name, NameError> {
        let refused = |problem| NameError {
            text: text.to_owned(),
            problem,
        };
        let is_word = |word: &str| {
            !word.is_empty()
                && word
                    .bytes()
                    .all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit())
        };
        let begins = text.starts_with(|first: char| first.is_ascii_lowercase());
        if !begins || text.len() > LENGTH_MAX || !text.split('-').all(is_word) {
            return Err(refused(
                "expected a lower-case letter, then letters, digits and single `-`, at most 64 bytes",
            ));
        }
        if TAKEN.split(' ').any(|taken| taken == text) {
            return Err(refused("expected a name that is not reserved"));
        }
        Ok(Name(text.to_owned()))
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Error for a text that is not a valid plugin name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{text:?} is not a valid name for a plugin, {problem}")]
pub struct NameError {
    text: String,
    problem: &'static str,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_one_for_a_folder_a_crate_and_a_driver_at_once() {
        for text in ["my-sensor", "digit", "a1", "a-1"] {
            assert_eq!(text.parse::<Name>().expect(text).as_str(), text);
        }
        let refused = [
            "",
            "-a",
            "a-",
            "a--b",
            "1a",
            "A",
            "a_b",
            "a b",
            "a/b",
            "..",
            "é",
            "move",
            "core",
            "taceva-core",
            "yield",
        ];
        for text in refused {
            assert!(text.parse::<Name>().is_err(), "{text}");
        }
        assert!("a".repeat(65).parse::<Name>().is_err());
        assert_eq!(
            "my-sensor".parse::<Name>().expect("good").as_crate(),
            "my_sensor"
        );
    }
}
