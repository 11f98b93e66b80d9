//! Reasons for the failure of a gauge study.

use thiserror::Error;

/// Reason for the failure of a gauge study.
///
/// ```
/// use taceva_metrology::gauge::{GaugeError, GaugeSettings, GaugeStudy};
/// let mut study = GaugeStudy::default();
/// let refused = study.add("p1", "A", "1", f64::NAN);
/// assert!(matches!(refused, Err(GaugeError::NotFinite { .. })));
/// ```
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum GaugeError {
    /// A setting outside its range.
    #[error("{name} is {value}, expected {expected}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Value found.
        value: f64,
        /// Accepted values.
        expected: &'static str,
    },
    /// A reading that is NaN or infinite.
    #[error(
        "part {part}, operator {operator}, trial {trial}: the reading is {value}, expected a finite number"
    )]
    NotFinite {
        /// Label of the part.
        part: String,
        /// Label of the operator.
        operator: String,
        /// Label of the trial.
        trial: String,
        /// Value found.
        value: f64,
    },
    /// Two readings with the same part, operator and trial.
    #[error(
        "part {part}, operator {operator}, trial {trial}: two readings, expected one; give each repeat its own trial"
    )]
    RepeatedTrial {
        /// Label of the part.
        part: String,
        /// Label of the operator.
        operator: String,
        /// Label of the trial.
        trial: String,
    },
    /// A cell whose number of readings differs from the number in most cells.
    #[error(
        "part {part}, operator {operator}: {have} readings, expected {expected} as in most cells; `--drop-incomplete` leaves such parts out"
    )]
    Incomplete {
        /// Label of the part.
        part: String,
        /// Label of the operator.
        operator: String,
        /// Number of readings.
        have: usize,
        /// Number of readings in most cells.
        expected: usize,
    },
    /// A nested study in which operators have different numbers of parts.
    #[error(
        "operator {operator}: {have} parts, expected {expected} as for most operators; leave out parts until every operator has the same number of parts"
    )]
    UnequalParts {
        /// Label of the operator.
        operator: String,
        /// Number of parts.
        have: usize,
        /// Number of parts of most operators.
        expected: usize,
    },
    /// Fewer than two operators.
    #[error(
        "{}, expected at least 2: reproducibility is a difference between operators",
        taceva_core::counted(*have, "operator")
    )]
    TooFewOperators {
        /// Number of operators.
        have: usize,
    },
    /// Fewer than two parts.
    #[error(
        "{}, expected at least 2: parts span the range of the study",
        taceva_core::counted(*have, "complete part")
    )]
    TooFewParts {
        /// Number of parts.
        have: usize,
    },
    /// Fewer than two trials.
    #[error(
        "{have} readings of each part by each operator, expected at least 2: repeatability is a difference between repeats"
    )]
    TooFewTrials {
        /// Number of trials.
        have: usize,
    },
    /// A nested study with the range method.
    #[error(
        "the range method needs parts that every operator measures; use `--method anova` for a nested study"
    )]
    RangeOfNested,
}
