//! Errors in arguments of a driver.

use crate::printable::shown;
use std::fmt;

/// Error for an argument that the driver rejects. Its fields contain the user's text unescaped.
///
/// ```
/// use taceva_core::{ArgError, ArgSpec, Args};
/// let specs = [ArgSpec::whole("seed", 0, 99)];
/// let error = Args::parse(&specs, "seed=100").unwrap_err();
/// assert!(matches!(&error, ArgError::Value { key, .. } if key == "seed"));
/// assert_eq!(error.to_string(), "`seed`: `100`, expected a whole number from 0 to 99");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ArgError {
    /// A part of the argument text, between two semicolons, has no `=`.
    Syntax {
        /// Text between the semicolons.
        text: String,
    },
    /// A key that the driver does not declare.
    Unknown {
        /// Undeclared key.
        key: String,
        /// Most similar declared key; `None` if no key is similar.
        nearest: Option<String>,
        /// Every declared key.
        known: Vec<String>,
    },
    /// A key that is given more than once.
    Twice {
        /// Repeated key.
        key: String,
    },
    /// A required key that is not given.
    Missing {
        /// Missing key.
        key: String,
        /// Accepted values, in words.
        expected: String,
        /// Help text of the argument.
        help: String,
    },
    /// A value of the wrong type or outside the accepted range.
    Value {
        /// Key of the argument.
        key: String,
        /// Rejected value.
        value: String,
        /// Accepted values, in words.
        expected: String,
        /// Most similar accepted word; `None` if no word is similar, or the argument has no list of words.
        nearest: Option<String>,
    },
}

impl fmt::Display for ArgError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ArgError::Syntax { text } => {
                write!(f, "`{}`: expected `key=value`", shown(text))
            }
            ArgError::Unknown {
                key,
                nearest,
                known,
            } => {
                write!(f, "`{}`: unknown argument, ", shown(key))?;
                match nearest {
                    Some(nearest) => write!(f, "did you mean `{nearest}`?"),
                    None if known.is_empty() => f.write_str("the driver takes no arguments"),
                    None => write!(f, "expected one of `{}`", known.join("`, `")),
                }
            }
            ArgError::Twice { key } => write!(f, "`{}`: given twice", shown(key)),
            ArgError::Missing {
                key,
                expected,
                help,
            } => write!(f, "`{key}`: missing, expected {expected}: {help}"),
            ArgError::Value {
                key,
                value,
                expected,
                nearest,
            } => {
                write!(f, "`{key}`: `{}`, ", shown(value))?;
                match nearest {
                    Some(nearest) => write!(f, "did you mean `{nearest}`?"),
                    None => write!(f, "expected {expected}"),
                }
            }
        }
    }
}

impl std::error::Error for ArgError {}
