//! Firmware version of the controller, from its version answer.

use thiserror::Error;

use crate::text::shown;

/// Firmware version of a controller, which determines the encoding of motions.
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

    /// Parses the version in an answer such as `6,12,XF1300000001,AC1300000002,v2.7.0`.
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

    /// True if a request for a straight motion has a blending radius and three bytes of switches after its nine numbers.
    pub(super) fn takes_long_lines(self) -> bool {
        self >= Firmware::new(1, 11, 100)
    }

    /// True if the controller stops when a velocity expires. Older controllers keep the last velocity. The vendor's client sends durations since
    /// firmware 1.8.0. This driver requires 1.10.0, because no frames of older firmware were recorded.
    pub(super) fn takes_expiring_velocities(self) -> bool {
        self >= Firmware::new(1, 10, 0)
    }

    /// True if a request to set the mode has a switch for collision detection.
    pub(super) fn takes_collision_detection(self) -> bool {
        self >= Firmware::new(1, 10, 0)
    }
}

/// Leading number of `text`; `None` if it does not begin with a number.
fn leading_number(text: &str) -> Option<u32> {
    let end = text.find(|digit: char| !digit.is_ascii_digit());
    text[..end.unwrap_or(text.len())].parse().ok()
}

/// Error for an answer that contains no firmware version.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("it reports the version `{}`, expected a version such as `v2.7.0`", shown(.text))]
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
