//! The version of the format on disk, and who can read it.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// A version of the dataset format, written `major.minor`.
///
/// A minor adds and never changes a meaning, so any minor of a known major can be read; a newer major cannot.
///
/// ```
/// use taceva_dataset::Version;
///
/// let newer: Version = "1.11".parse()?;
/// assert!(newer > Version::CURRENT && newer.is_readable());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version {
    /// Raised when a meaning changes.
    pub major: u32,
    /// Raised when something is added.
    pub minor: u32,
}

impl Version {
    /// The newest that this crate writes.
    pub const CURRENT: Version = Version {
        major: 1,
        minor: 10,
    };

    /// The version of a header of frames that are as they came, so that it is what it was before 1.10.
    pub(crate) const WITHOUT_REDUCTION: Version = Version { major: 1, minor: 9 };

    /// The version of a header that does not say how a map read labels, joined tables, pictures and classes, so that it is what it was before 1.9.
    pub(crate) const WITHOUT_COLUMNS: Version = Version { major: 1, minor: 8 };

    /// The version of a header of a recording to which no rows were added and of which nothing was left out, so that it is what it was before 1.8.
    pub(crate) const NEVER_EXTENDED: Version = Version { major: 1, minor: 7 };

    /// The version of a header of a recording without signals, so that it is what it was before 1.7.
    pub(crate) const WITHOUT_SIGNALS: Version = Version { major: 1, minor: 6 };

    /// The version of a header of a recording whose rows do not say which row of a lab's table they were, so that it is what it was before 1.6.
    pub(crate) const WITHOUT_ORIGIN: Version = Version { major: 1, minor: 5 };

    /// The version of a header that says nothing of what was set of the camera or of a stream, so that it is what it was before 1.5.
    pub(crate) const WITHOUT_SETTINGS: Version = Version { major: 1, minor: 4 };

    /// The first version whose headers are sealed.
    pub const SEALED: Version = Version { major: 1, minor: 3 };

    /// Whether this crate can read it.
    pub fn is_readable(self) -> bool {
        self.major == Version::CURRENT.major
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.major, self.minor)
    }
}

impl FromStr for Version {
    type Err = String;

    fn from_str(text: &str) -> Result<Version, String> {
        let wrong = || "a format version is written as `major.minor`, such as `1.0`".to_owned();
        let (major, minor) = text.split_once('.').ok_or_else(wrong)?;
        Ok(Version {
            major: major.parse().map_err(|_| wrong())?,
            minor: minor.parse().map_err(|_| wrong())?,
        })
    }
}

impl Serialize for Version {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Version {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Version, D::Error> {
        String::deserialize(deserializer)?
            .parse()
            .map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_minor_is_readable_and_another_major_is_not() {
        let readable = |text: &str| text.parse::<Version>().map(Version::is_readable);
        assert_eq!(readable("1.0"), Ok(true));
        assert_eq!(readable("1.9"), Ok(true));
        assert_eq!(readable("2.0"), Ok(false));
        assert_eq!(readable("0.9"), Ok(false));
        assert!(readable("1").is_err() && readable("one.two").is_err());
    }
}
