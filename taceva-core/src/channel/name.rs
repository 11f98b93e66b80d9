//! Names of channels, stored inline so that a channel is `Copy`.

use std::fmt;

/// Longest name of a channel, in bytes.
pub(super) const NAME_MAX: usize = 32;

/// A name of ASCII letters, digits and `_`, at most [`NAME_MAX`] bytes.
///
/// Bytes after the name are 0, so equal names are equal in all bytes.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct ChannelName([u8; NAME_MAX]);

impl ChannelName {
    /// The name `text`. The caller must check length and characters.
    pub(super) const fn new(text: &str) -> ChannelName {
        let text = text.as_bytes();
        let mut name = [0; NAME_MAX];
        let mut at = 0;
        while at < text.len() {
            name[at] = text[at];
            at += 1;
        }
        ChannelName(name)
    }

    /// The name as text.
    pub(super) fn as_str(&self) -> &str {
        let end = self.0.iter().position(|byte| *byte == 0);
        let name = &self.0[..end.unwrap_or(NAME_MAX)];
        std::str::from_utf8(name).unwrap_or_default()
    }
}

impl fmt::Debug for ChannelName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.as_str(), f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_kept_to_its_longest_length() {
        let longest = "x".repeat(NAME_MAX);
        for name in ["F", "Fz", "shear_x", &longest] {
            assert_eq!(ChannelName::new(name).as_str(), name);
        }
        assert_eq!(format!("{:?}", ChannelName::new("Fz")), "\"Fz\"");
        assert_ne!(ChannelName::new("Fz"), ChannelName::new("F"));
    }
}
