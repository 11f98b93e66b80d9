//! Time stamps of an observation: time of measurement and time of receipt.

use std::fmt;
use std::time::Duration;

use crate::precision::whole_count;

/// Clock of the time stamps in a recording.
///
/// ```
/// use taceva_core::Clock;
/// assert_eq!((Clock::default(), Clock::Unix.to_string()), (Clock::Unknown, "unix".to_owned()));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Clock {
    /// Seconds since the start of 1970, UTC. This clock may jump.
    Unix,
    /// Seconds since an arbitrary start. The clock never jumps.
    Monotonic,
    /// The recording does not name its clock.
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

/// Time of a sample, in seconds of the recording's [`Clock`]. A plain value, which gets no further fields.
///
/// ```
/// use taceva_core::Stamp;
/// let stamp = Stamp { valid_s: 1.5, received_s: Some(1.53) };
/// assert_eq!(stamp.valid().as_millis(), 1500);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stamp {
    /// Time of the measurement, s; for a picture the middle of the exposure, if known.
    pub valid_s: f64,
    /// Time of receipt, s; `None` if unknown. The difference from `valid_s` is the latency.
    pub received_s: Option<f64>,
}

/// Nanoseconds per second.
const NANOSECONDS: f64 = 1e9;

impl Stamp {
    /// Stamp from the time of measurement and the time of receipt, to the nanosecond. Both times count from the start of the clock.
    ///
    /// ```
    /// use std::time::Duration;
    /// use taceva_core::Stamp;
    /// let stamp = Stamp::new(Duration::from_millis(1_500), None);
    /// assert_eq!(stamp.valid_s, 1.5);
    /// assert_eq!(stamp.valid(), Duration::from_millis(1_500));
    /// ```
    pub fn new(valid: Duration, received: Option<Duration>) -> Stamp {
        Stamp {
            valid_s: seconds(valid),
            received_s: received.map(seconds),
        }
    }

    /// Stamp of an observation that is measured and received at the time `now`.
    pub fn at(now: Duration) -> Stamp {
        Stamp::new(now, Some(now))
    }

    /// Time of the measurement, to the nanosecond. Times before the clock's start become zero.
    pub fn valid(&self) -> Duration {
        nanoseconds(self.valid_s)
    }

    /// Time of receipt, to the nanosecond; `None` if unknown.
    pub fn received(&self) -> Option<Duration> {
        self.received_s.map(nanoseconds)
    }
}

fn seconds(time: Duration) -> f64 {
    let count = time.as_nanos() as f64;
    count / NANOSECONDS
}

fn nanoseconds(time_s: f64) -> Duration {
    let count = whole_count((time_s * NANOSECONDS).round());
    Duration::from_nanos(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_nanoseconds_survive_the_way_through_seconds() {
        for count in [
            0,
            1,
            999_999_999,
            123_456_789_012_345,
            8_000_000_000_000_001,
        ] {
            let time = Duration::from_nanos(count);
            assert_eq!(Stamp::at(time).valid(), time);
            assert_eq!(Stamp::at(time).received(), Some(time));
        }
    }

    #[test]
    fn a_time_that_is_no_time_is_the_start_of_the_clock() {
        for valid_s in [-1.0, f64::NAN] {
            let stamp = Stamp {
                valid_s,
                received_s: None,
            };
            assert_eq!(stamp.valid(), Duration::ZERO);
        }
    }
}
