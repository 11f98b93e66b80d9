//! What a score can be: a number, or a reason why there is none.

use std::fmt;

use taceva_core::Unit;

/// A finished value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value {
    /// One finite number.
    Scalar(f64),
    /// The samples determine no value.
    Undefined(UndefinedReason),
    /// The question does not arise for this channel or sensor.
    NotApplicable(InapplicableReason),
}

impl Value {
    /// The number, if there is one.
    pub fn scalar(&self) -> Option<f64> {
        match self {
            Value::Scalar(value) => Some(*value),
            _ => None,
        }
    }
}

impl From<Result<f64, UndefinedReason>> for Value {
    fn from(result: Result<f64, UndefinedReason>) -> Value {
        match result {
            Ok(value) => Value::Scalar(value),
            Err(reason) => Value::Undefined(reason),
        }
    }
}

/// Why samples determine no value, or no interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum UndefinedReason {
    /// There is no sample.
    Empty,
    /// There are fewer samples than the formula needs.
    TooFew {
        /// What it needs.
        least: u64,
    },
    /// All truths are equal, so that there is no spread to explain.
    ConstantTruth {
        /// Whether every prediction equals it too.
        perfect: bool,
    },
    /// No truth is as large as the gate.
    BelowGate,
    /// The value is beyond the range of a binary64.
    Overflow,
    /// Too few contact locations for an interval.
    TooFewClusters {
        /// How many there are.
        have: usize,
    },
    /// Too few bootstrap replicates that have a value: fewer than 39, or than 95 % of those drawn.
    TooFewReplicates {
        /// How many have one.
        defined: usize,
        /// How many there are.
        drawn: usize,
    },
    /// Some sample names no contact location, so that nobody knows which belong together.
    NoClusters,
}

impl fmt::Display for UndefinedReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            UndefinedReason::Empty => f.write_str("empty"),
            UndefinedReason::TooFew { least } => write!(f, "fewer than {least} samples"),
            UndefinedReason::ConstantTruth { .. } => f.write_str("constant truth"),
            UndefinedReason::BelowGate => f.write_str("no truth reaches the gate"),
            UndefinedReason::Overflow => f.write_str("beyond the range of binary64"),
            UndefinedReason::TooFewClusters { have } => {
                let least = crate::stats::jackknife::LEAST_CLUSTERS;
                write!(f, "{have} clusters, {least} are needed")
            }
            UndefinedReason::TooFewReplicates { defined, drawn } => {
                let least = crate::stats::LEAST_REPLICATES;
                write!(
                    f,
                    "{defined} of {drawn} replicates have a value, 95 % and at least {least} are needed"
                )
            }
            UndefinedReason::NoClusters => f.write_str("samples without point_id"),
        }
    }
}

/// Why a question does not arise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum InapplicableReason {
    /// Nobody has said from which magnitude on values of this unit count as contact.
    NoGate(Unit),
}

impl fmt::Display for InapplicableReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InapplicableReason::NoGate(unit) => write!(f, "no gate is defined for {unit}"),
        }
    }
}
