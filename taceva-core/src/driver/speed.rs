//! Speed of a robot.

use std::fmt;

/// Speed of the tip of the indenter along its path: above 0 and finite.
///
/// # Units
/// mm/s.
///
/// ```
/// use taceva_core::Speed;
/// assert_eq!(Speed::try_new(2.5)?.to_string(), "2.5 mm/s");
/// # Ok::<(), taceva_core::SpeedError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Speed(f64);

impl Speed {
    /// A speed of `mm_per_s`.
    ///
    /// # Errors
    /// [`SpeedError`] for 0, a negative number, NaN or infinity.
    pub fn try_new(mm_per_s: f64) -> Result<Speed, SpeedError> {
        if mm_per_s > 0.0 && mm_per_s.is_finite() {
            Ok(Speed(mm_per_s))
        } else {
            Err(SpeedError { mm_per_s })
        }
    }

    /// Speed in mm/s.
    pub const fn mm_per_s(self) -> f64 {
        self.0
    }
}

impl fmt::Display for Speed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mm/s", self.0)
    }
}

/// Error for a number that is not a valid speed.
///
/// ```
/// use taceva_core::Speed;
/// let error = Speed::try_new(0.0).unwrap_err();
/// assert_eq!(error.to_string(), "a speed of 0 mm/s, expected a number above 0");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedError {
    mm_per_s: f64,
}

impl fmt::Display for SpeedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a speed of {} mm/s, expected a number above 0",
            self.mm_per_s
        )
    }
}

impl std::error::Error for SpeedError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_speed_at_which_nothing_arrives_is_refused() {
        for number in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Speed::try_new(number).is_err(), "{number}");
        }
        assert_eq!(
            Speed::try_new(2.5).expect("positive").to_string(),
            "2.5 mm/s"
        );
    }
}
