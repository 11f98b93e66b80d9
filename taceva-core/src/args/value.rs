//! Values of arguments.

use std::fmt;

/// Value of an argument, checked against its declaration.
///
/// ```
/// use taceva_core::ArgValue;
/// assert_eq!(ArgValue::Whole(3).as_number(), Some(3.0));
/// assert_eq!(ArgValue::Text("left".to_owned()).as_text(), Some("left"));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ArgValue {
    /// A text, a path, or one word of a list.
    Text(String),
    /// A whole number.
    Whole(i64),
    /// A finite number, in the declared unit.
    Number(f64),
    /// `true` or `false`.
    Flag(bool),
}

impl ArgValue {
    /// The text; `None` for a number or a flag.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            ArgValue::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The number, whole or not; `None` for a text or a flag.
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
