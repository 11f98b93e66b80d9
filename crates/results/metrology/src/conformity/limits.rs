//! Limits of a tolerance or of acceptance.

use serde::{Deserialize, Serialize};

use super::ConformityError;
use super::error::check;

/// A lower limit, an upper limit, or both, in the unit of the measured quantity.
///
/// ```
/// use taceva_metrology::conformity::Limits;
/// let limits = Limits::between(-0.02, 0.02)?;
/// assert!(limits.contain(0.02) && !limits.contain(0.021));
/// # Ok::<(), taceva_metrology::conformity::ConformityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Ends")]
pub struct Limits {
    least: Option<f64>,
    most: Option<f64>,
}

/// Deserialized limits, not yet validated.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ends {
    least: Option<f64>,
    most: Option<f64>,
}

impl TryFrom<Ends> for Limits {
    type Error = ConformityError;
    fn try_from(ends: Ends) -> Result<Limits, ConformityError> {
        Limits::of(ends.least, ends.most)
    }
}

impl Limits {
    /// Values up to `most`.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a limit that is not finite.
    pub fn at_most(most: f64) -> Result<Limits, ConformityError> {
        Limits::of(None, Some(most))
    }

    /// Values from `least` on.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a limit that is not finite.
    pub fn at_least(least: f64) -> Result<Limits, ConformityError> {
        Limits::of(Some(least), None)
    }

    /// Values from `least` to `most`.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a limit that is not finite, [`ConformityError::Limits`] unless the lower limit is below the upper limit.
    pub fn between(least: f64, most: f64) -> Result<Limits, ConformityError> {
        Limits::of(Some(least), Some(most))
    }

    /// Values from `least` to `most`. `None` leaves a side unbounded.
    ///
    /// # Errors
    /// [`ConformityError::Number`] for a limit that is not finite, [`ConformityError::Limits`] unless the lower limit is below the upper limit.
    pub fn of(least: Option<f64>, most: Option<f64>) -> Result<Limits, ConformityError> {
        for end in [least, most].into_iter().flatten() {
            check("the limit", end, end.is_finite(), "a finite number")?;
        }
        match (least, most) {
            (Some(least), Some(most)) if least >= most => {
                Err(ConformityError::Limits { least, most })
            }
            _ => Ok(Limits { least, most }),
        }
    }

    /// Lower limit; `None` if unbounded.
    #[must_use]
    pub fn least(&self) -> Option<f64> {
        self.least
    }

    /// Upper limit; `None` if unbounded.
    #[must_use]
    pub fn most(&self) -> Option<f64> {
        self.most
    }

    /// True for a value within the limits, limits included.
    #[must_use]
    pub fn contain(&self, value: f64) -> bool {
        self.least.is_none_or(|least| value >= least) && self.most.is_none_or(|most| value <= most)
    }

    /// Limits after `change_least` and `change_most`; `None` for an empty range.
    pub(super) fn map(
        &self,
        change_least: impl Fn(f64) -> f64,
        change_most: impl Fn(f64) -> f64,
    ) -> Option<Limits> {
        Limits::of(self.least.map(change_least), self.most.map(change_most)).ok()
    }
}
