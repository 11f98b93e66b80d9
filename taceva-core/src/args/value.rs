//! The value of an argument.

use std::fmt;

/// A value that was checked against its declaration.
///
/// ```
/// use taceva_core::ArgValue;
/// assert_eq!(ArgValue::Whole(3).as_number(), Some(3.0));
/// assert_eq!(ArgValue::Text("left".to_owned()).as_text(), Some("left"));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ArgValue {
    /// A text, a path or a choice.
    Text(String),
    /// A whole number.
    Whole(i64),
    /// A finite number, in the unit it was declared with.
    Number(f64),
    /// On or off.
    Flag(bool),
}

impl ArgValue {
    /// The text, if it is one.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            ArgValue::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The number, if it is one, whole or not.
    pub fn as_number(&self) -> Option<f64> {
        match self {
            ArgValue::Whole(value) => Some(*value as f64),
            ArgValue::Number(value) => Some(*value),
            _ => None,
        }
    }
}

impl fmt::Display for ArgValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ArgValue::Text(text) => f.write_str(text),
            ArgValue::Whole(value) => write!(f, "{value}"),
            ArgValue::Number(value) => write!(f, "{value}"),
            ArgValue::Flag(value) => write!(f, "{value}"),
        }
    }
}
