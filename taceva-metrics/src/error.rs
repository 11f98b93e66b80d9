//! Errors of evaluations.

use std::error::Error;
use std::fmt;

use taceva_core::shown;

/// Error of an evaluation: columns, batches, states or settings that do not match.
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
        /// Number of rows of the estimate.
        estimate: usize,
        /// Number of rows of the reference.
        reference: usize,
    },
    /// Columns of different lengths in one batch.
    Rows {
        /// Column with a deviating length: a channel, or the contact points.
        what: String,
        /// Number of rows of the first channel.
        expected: usize,
        /// Number of rows of the column.
        found: usize,
    },
    /// A matrix whose number of columns differs from the number of channels.
    Columns {
        /// Name of the matrix: truth or prediction.
        what: &'static str,
        /// Number of channels.
        expected: usize,
        /// Number of columns found.
        found: usize,
    },
    /// A missing value in a column that needs a value in every row.
    Absent {
        /// Index of the row, from 0.
        row: usize,
    },
    /// A batch or a state whose channels differ from the evaluated channels.
    Channels {
        /// Evaluated channels, with their units.
        expected: String,
        /// Channels of the batch or state.
        found: String,
    },
    /// A state with a schema that the plan does not use.
    Schema {
        /// Accepted schemas.
        expected: String,
        /// Schema of the state.
        found: String,
    },
    /// A state computed with another value of a parameter.
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Value in the evaluator.
        expected: String,
        /// Value in the state.
        found: String,
    },
    /// A setting outside its allowed range.
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Accepted values, in words.
        expected: String,
        /// Value found.
        found: String,
    },
    /// A state that does not match its schema.
    Malformed {
        /// Schema of the state.
        schema: &'static str,
        /// Description of the mismatch.
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
