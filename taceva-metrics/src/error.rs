//! Errors between metrics and their callers.

use std::error::Error;
use std::fmt;

use taceva_core::shown;

/// Mismatch of columns, batches, states or settings.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator, MetricError};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
/// let error = evaluator.update_pairs(Channel::FZ, &[0.25, 0.5], &[0.25]).unwrap_err();
/// assert_eq!(error, MetricError::Lengths { estimate: 1, reference: 2 });
/// # Ok::<(), taceva_metrics::ChannelError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MetricError {
    /// Two columns of different length.
    Lengths {
        /// Rows of the estimate.
        estimate: usize,
        /// Rows of the reference.
        reference: usize,
    },
    /// Columns of different length in one batch.
    Rows {
        /// Column of another length: a channel, or the contact points.
        what: String,
        /// Rows of the first channel.
        expected: usize,
        /// Rows that were found.
        found: usize,
    },
    /// A matrix whose number of columns is not the number of channels.
    Columns {
        /// Name of the matrix: truth or prediction.
        what: &'static str,
        /// Number of channels.
        expected: usize,
        /// Columns that were found.
        found: usize,
    },
    /// A missing value in a column that needs one in every row.
    Absent {
        /// The row, from 0.
        row: usize,
    },
    /// A batch or a state of other channels.
    Channels {
        /// Evaluated channels, with their units.
        expected: String,
        /// Channels of the batch or state.
        found: String,
    },
    /// A state of a schema that the plan does not read.
    Schema {
        /// The schemas that are read.
        expected: String,
        /// The schema of the state.
        found: String,
    },
    /// A state made with another parameter.
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Value of the evaluator.
        expected: String,
        /// Value of the state.
        found: String,
    },
    /// A setting outside the values that definitions allow.
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Accepted values, in words.
        expected: String,
        /// Value that was given.
        found: String,
    },
    /// A state that does not match its schema.
    Malformed {
        /// The schema.
        schema: &'static str,
        /// Fault of the state.
        what: String,
    },
}

impl fmt::Display for MetricError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MetricError::Lengths {
                estimate,
                reference,
            } => write!(
                f,
                "{estimate} estimates and {reference} references, expected equal numbers"
            ),
            MetricError::Rows {
                what,
                expected,
                found,
            } => write!(
                f,
                "{found} rows of {}, expected {expected} as in the first channel",
                shown(what)
            ),
            MetricError::Columns {
                what,
                expected,
                found,
            } => write!(
                f,
                "{found} columns of {what}, expected {expected}, one per channel"
            ),
            MetricError::Absent { row } => write!(f, "no value in row {row}, expected a number"),
            MetricError::Channels { expected, found } => {
                write!(f, "channels {}, expected {}", shown(found), shown(expected))
            }
            MetricError::Schema { expected, found } => {
                write!(f, "state of schema `{}`, expected {expected}", shown(found))
            }
            MetricError::Parameter {
                name,
                expected,
                found,
            } => write!(
                f,
                "state with {name} `{}`, expected `{expected}`",
                shown(found)
            ),
            MetricError::Setting {
                name,
                expected,
                found,
            } => write!(f, "setting `{name}` is {found}, expected {expected}"),
            MetricError::Malformed { schema, what } => {
                write!(
                    f,
                    "broken state of schema `{}`: {}",
                    shown(schema),
                    shown(what)
                )
            }
        }
    }
}

impl Error for MetricError {}
