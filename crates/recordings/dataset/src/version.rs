//! Versions of the dataset format, and their compatibility.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// Version of the dataset format, written `major.minor`.
///
/// A minor version only adds content and never changes a meaning. All minor versions of a known major version can be read; newer major versions
/// cannot. Formats 1.1 to 1.10 were written before release 0.2.0 and are not supported.
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
    /// Number incremented when a meaning changes.
    pub major: u32,
    /// Number incremented when something is added.
    pub minor: u32,
}

impl Version {
    /// Format version of a dataset without tasks.
    pub const CURRENT: Version = Version { major: 1, minor: 0 };

    /// Format version of a dataset with tasks. A reader of [`CURRENT`](Version::CURRENT) reads everything except the tasks.
    pub const WITH_TASKS: Version = Version {
        major: 1,
        minor: 11,
    };

    /// Last minor version before release 0.2.0, which restarted at 1.0.
    const LAST_BEFORE_RELEASE: u32 = 10;

    /// True if this crate can read datasets of this version.
    pub fn is_readable(self) -> bool {
        self.major == Version::CURRENT.major && !self.is_earlier()
    }

    /// True if this version precedes release 0.2.0.
    pub fn is_earlier(self) -> bool {
        self.major == 1 && (1..=Version::LAST_BEFORE_RELEASE).contains(&self.minor)
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
    fn a_later_minor_is_readable_and_an_earlier_format_and_another_major_are_not() {
        let readable = |text: &str| text.parse::<Version>().map(Version::is_readable);
        assert_eq!(readable("1.0"), Ok(true));
        assert_eq!(readable("1.11"), Ok(true));
        for refused in ["1.1", "1.10", "2.0", "0.9"] {
            assert_eq!(readable(refused), Ok(false), "{refused}");
        }
        assert!(readable("1").is_err() && readable("one.two").is_err());
    }
}
