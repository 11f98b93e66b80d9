//! Errors for invalid signals of a taxel sensor.

use std::fmt;

use super::SignalInfo;

/// Error for numbers that cannot be signals of a taxel sensor.
///
/// ```
/// use taceva_core::{SignalError, SignalInfo, Unit};
/// assert!(matches!(SignalInfo::new(0, 4, 1, Unit::Count), Err(SignalError::Grid { .. })));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SignalError {
    /// The grid has no numbers, or more than [`LEN_MAX`](SignalInfo::LEN_MAX) numbers.
    Grid {
        /// The rejected grid.
        info: SignalInfo,
    },
    /// The count of numbers differs from the count that the grid requires.
    Count {
        /// Grid of the signals.
        info: SignalInfo,
        /// Count of numbers found.
        found: usize,
    },
    /// A number is infinite or NaN.
    NotFinite {
        /// Index of this number among all numbers, from 0.
        position: usize,
        /// The number as text.
        found: String,
    },
}

impl fmt::Display for SignalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SignalError::Grid { info } => write!(
                f,
                "{info}: a sample has at least one number and at most {}",
                SignalInfo::LEN_MAX
            ),
            SignalError::Count { info, found } => {
                write!(f, "{found} signals for {info}, expected {}", info.len())
            }
            SignalError::NotFinite { position, found } => {
                write!(f, "signal {position} is {found}, expected a finite number")
            }
        }
    }
}

impl std::error::Error for SignalError {}
