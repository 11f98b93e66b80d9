//! Errors of signals.

use std::fmt;

use super::SignalInfo;

/// Rejection of numbers as signals of a taxel sensor.
///
/// ```
/// use taceva_core::{SignalError, SignalInfo, Unit};
/// assert!(matches!(SignalInfo::new(0, 4, 1, Unit::Count), Err(SignalError::Grid { .. })));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SignalError {
    /// A grid without numbers, or with more than [`LEN_MAX`](SignalInfo::LEN_MAX) numbers.
    Grid {
        /// The grid.
        info: SignalInfo,
    },
    /// More or fewer numbers than the grid has.
    Count {
        /// The grid.
        info: SignalInfo,
        /// Count of numbers found.
        found: usize,
    },
    /// A number that is not finite.
    NotFinite {
        /// Index of the number, from 0, taxel by taxel.
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
