//! When something was true, and when we heard of it.

use std::fmt;

/// Which clock a time was read from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Clock {
    /// Seconds since 1970; may jump.
    Unix,
    /// Seconds since an arbitrary start; never jumps.
    Monotonic,
    /// Nobody wrote it down.
    #[default]
    Unknown,
}

impl fmt::Display for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Clock::Unix => "unix",
            Clock::Monotonic => "monotonic",
            Clock::Unknown => "unknown",
        })
    }
}

/// The time of a sample, in seconds of the recording's [`Clock`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stamp {
    /// When the observation was true: the middle of the exposure, where that is known.
    pub valid_s: f64,
    /// When it reached us; the difference is the latency.
    pub received_s: Option<f64>,
}
