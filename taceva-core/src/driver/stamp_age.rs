//! Age of a reading on arrival, by its time stamp. This age reveals stamps of another clock than expected.

use std::fmt;

/// Greatest age of a reading on arrival, s, that a device and its link explain.
const AGE_MAX_S: f64 = 10.0;

/// Time from the stamp of a reading to its arrival on the clock of the host, in s; below 0 for stamps of a clock that is ahead.
///
/// ```
/// use taceva_core::StampAge;
///
/// assert!(StampAge::of(0.02).is_of_host_clock());
/// let ahead = StampAge::of(-3600.0);
/// assert!(!ahead.is_of_host_clock());
/// assert!(ahead.to_string().starts_with("stamps 3600 s ahead of the clock of this machine"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampAge(f64);

impl StampAge {
    /// Age of `age_s`, in s.
    pub fn of(age_s: f64) -> StampAge {
        StampAge(age_s)
    }

    /// True for an age of at most 10 s, in either direction. Devices and links delay readings by less.
    pub fn is_of_host_clock(self) -> bool {
        self.0.abs() <= AGE_MAX_S
    }
}

impl fmt::Display for StampAge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "stamps {:.0} s {} the clock of this machine (limit {AGE_MAX_S} s), so another clock made them: stamp readings on arrival (`now_ns` in C, `now` in Rust and Python), or let the driver add the smallest difference between arrival and stamp",
            self.0.abs(),
            if self.0 < 0.0 { "ahead of" } else { "behind" }
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_is_another_one_beyond_10_s_in_both_directions() {
        for (age_s, is_of_host, words) in [
            (0.0, true, "0 s behind"),
            (10.0, true, "10 s behind"),
            (-10.0, true, "10 s ahead of"),
            (10.6, false, "11 s behind"),
            (-10.6, false, "11 s ahead of"),
            (f64::NAN, false, "NaN s behind"),
        ] {
            let age = StampAge::of(age_s);
            assert_eq!(age.is_of_host_clock(), is_of_host, "{age}");
            assert!(age.to_string().contains(words), "{age}");
        }
    }
}
