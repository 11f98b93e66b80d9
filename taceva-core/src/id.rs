//! Keys of drivers. Command line, scenes and registry use the same keys.

use std::borrow::{Borrow, Cow};
use std::fmt;
use std::str::FromStr;

/// Name of a driver: words joined by `/`, such as `sim/gelsight` or `org.example.digit/digit`.
///
/// A word contains lower-case letters, digits, `-`, `_` and `.`, and begins with a letter or a digit.
///
/// ```
/// use taceva_core::DriverKey;
/// const REPLAY: DriverKey = DriverKey::fixed("sensor/replay");
/// assert_eq!("sensor/replay".parse(), Ok(REPLAY));
/// assert!("Sensor Replay".parse::<DriverKey>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DriverKey(Cow<'static, str>);

impl DriverKey {
    /// Greatest length of a key, in bytes.
    pub const LENGTH_MAX: usize = 128;

    /// Key from the text `key`, for constants.
    ///
    /// # Panics
    /// If `key` is not a valid key. In a constant, the compiler reports this as an error.
    pub const fn fixed(key: &'static str) -> DriverKey {
        assert!(
            is_key(key.as_bytes()),
            "a driver key is made of lower-case words joined by `/`"
        );
        DriverKey(Cow::Borrowed(key))
    }

    /// The key as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

const fn is_key(key: &[u8]) -> bool {
    if key.len() > DriverKey::LENGTH_MAX {
        return false;
    }
    let mut word_begins = true;
    let mut at = 0;
    while at < key.len() {
        word_begins = match key[at] {
            b'a'..=b'z' | b'0'..=b'9' => false,
            b'-' | b'_' | b'.' if !word_begins => false,
            b'/' if !word_begins => true,
            _ => return false,
        };
        at += 1;
    }
    !word_begins
}

// Keys compare and hash as their text does, so maps can be queried by text.
impl Borrow<str> for DriverKey {
    fn borrow(&self) -> &str {
        &self.0
    }
}

impl FromStr for DriverKey {
    type Err = DriverKeyError;

    fn from_str(text: &str) -> Result<DriverKey, DriverKeyError> {
        if is_key(text.as_bytes()) {
            Ok(DriverKey(Cow::Owned(text.to_owned())))
        } else {
            Err(DriverKeyError {
                text: text.to_owned(),
            })
        }
    }
}

impl fmt::Display for DriverKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Error for text that is not a driver key.
///
/// ```
/// use taceva_core::DriverKey;
/// let error = "Sim/GelSight".parse::<DriverKey>().unwrap_err();
/// assert!(error.to_string().starts_with("\"Sim/GelSight\" is not a driver key"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DriverKeyError {
    text: String,
}

impl fmt::Display for DriverKeyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:?} is not a driver key, expected lower-case words joined by `/` such as `sim/gelsight`, at most {} bytes",
            self.text,
            DriverKey::LENGTH_MAX
        )
    }
}

impl std::error::Error for DriverKeyError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_could_be_mistaken_for_arguments_is_no_key() {
        for text in [
            "", "/", "a/", "/a", "a//b", "A", "a b", "a:b", "a;b", "a=b", ".a", "-", "é",
        ] {
            assert!(text.parse::<DriverKey>().is_err(), "{text}");
        }
        for text in ["sim/gelsight-wm", "org.example.digit/digit", "0", "a_b"] {
            assert_eq!(text.parse::<DriverKey>().expect(text).as_str(), text);
        }
        assert!("a".repeat(129).parse::<DriverKey>().is_err());
    }

    #[test]
    fn a_refused_key_shows_no_control_character() {
        let error = "a\u{1b}[31m".parse::<DriverKey>().expect_err("escape");
        assert!(error.to_string().starts_with("\"a\\u{1b}[31m\" is no"));
    }
}
