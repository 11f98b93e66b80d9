//! Deadlines as remaining time, because this crate reads no clock.

use std::fmt;
use std::time::Duration;

/// Time left for a call to a device.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::Deadline;
/// let whole = Deadline::after(Duration::from_millis(100));
/// let rest = whole.less(Duration::from_millis(30));
/// assert_eq!(rest.remaining(), Duration::from_millis(70));
/// assert!(rest.less(Duration::from_secs(1)).has_passed());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Deadline {
    remaining: Duration,
}

impl Deadline {
    /// A deadline that has passed: the device returns at once, with a result or with a timeout.
    pub const PASSED: Deadline = Deadline::after(Duration::ZERO);

    /// A deadline with the time `remaining` left.
    pub const fn after(remaining: Duration) -> Deadline {
        Deadline { remaining }
    }

    /// The time that is left.
    pub const fn remaining(self) -> Duration {
        self.remaining
    }

    /// True if no time is left.
    pub const fn has_passed(self) -> bool {
        self.remaining.is_zero()
    }

    /// The same deadline with its remaining time reduced by `spent`, to at least 0.
    #[must_use]
    pub const fn less(self, spent: Duration) -> Deadline {
        Deadline::after(self.remaining.saturating_sub(spent))
    }
}

impl fmt::Display for Deadline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.remaining)
    }
}
