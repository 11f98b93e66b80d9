//! Which controller it is: its answer to the question for its version.

use thiserror::Error;

use crate::text::shown;

/// The version of a controller's firmware, which decides how motions are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Firmware {
    major: u32,
    minor: u32,
    revision: u32,
}

impl Firmware {
    pub(super) const fn new(major: u32, minor: u32, revision: u32) -> Firmware {
        Firmware {
            major,
            minor,
            revision,
        }
    }

    /// The version in an answer such as `6,12,XF1300000001,AC1300000002,v2.7.0`.
    ///
    /// # Errors
    /// [`UnknownVersion`] for a text without `v` and three numbers.
    pub(super) fn parse(text: &str) -> Result<Firmware, UnknownVersion> {
        let found = text.rmatch_indices('v').find_map(|(at, _)| {
            let mut numbers = text[at + 1..].split('.').map(leading_number);
            let mut next = || numbers.next().flatten();
            Some(Firmware::new(next()?, next()?, next()?))
        });
        found.ok_or_else(|| UnknownVersion {
            text: text.to_owned(),
        })
    }

    /// Whether a straight motion has a radius and three switches behind its nine numbers.
    pub(super) fn takes_long_lines(self) -> bool {
        self >= Firmware::new(1, 11, 100)
    }

    /// Whether a velocity expires: older controllers go on with it until they are given another. (Later than the vendor's client asks for, which
    /// knows the duration since 1.8.0: this is the oldest whose frames were recorded.)
    pub(super) fn takes_expiring_velocities(self) -> bool {
        self >= Firmware::new(1, 10, 0)
    }

    /// Whether a mode has a switch behind it.
    pub(super) fn takes_collision_detection(self) -> bool {
        self >= Firmware::new(1, 10, 0)
    }
}

/// The number that `text` begins with.
fn leading_number(text: &str) -> Option<u32> {
    let end = text.find(|digit: char| !digit.is_ascii_digit());
    text[..end.unwrap_or(text.len())].parse().ok()
}

/// An answer that names no version.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("it calls itself `{}`, expected a version such as `v2.7.0` in it", shown(.text))]
pub(super) struct UnknownVersion {
    text: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_version_is_read_from_what_controllers_say() {
        let parse = |text| Firmware::parse(text);
        assert_eq!(
            parse("6,12,XF1300000001,AC1300000002,v2.7.0"),
            Ok(Firmware::new(2, 7, 0))
        );
        assert_eq!(parse("v1.11.100-beta\0"), Ok(Firmware::new(1, 11, 100)));
        assert_eq!(parse("vulcan,v1.6.9"), Ok(Firmware::new(1, 6, 9)));
        for text in ["", "v", "v1.2", "2.7.0", "v-1.2.3", "v99999999999.0.0"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn lines_are_long_since_1_11_100() {
        assert!(!Firmware::new(1, 11, 99).takes_long_lines());
        assert!(Firmware::new(1, 11, 100).takes_long_lines());
        assert!(Firmware::new(2, 0, 0).takes_long_lines());
    }
}
