//! Type of an argument's value, and the rule for an omitted argument.

use super::value::ArgValue;

/// Type of an argument's value, with its range.
///
/// ```
/// use taceva_core::{ArgKind, ArgSpec};
/// let spec = ArgSpec::new("seed", ArgKind::Whole { least: 0, most: 99 });
/// assert_eq!(spec, ArgSpec::whole("seed", 0, 99));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ArgKind {
    /// Any text that is not empty.
    Text,
    /// A path of a file or a folder.
    Path,
    /// A whole number.
    Whole {
        /// Least accepted value.
        least: i64,
        /// Greatest accepted value.
        most: i64,
    },
    /// A finite number.
    Number {
        /// Least accepted value; −∞ for no limit.
        least: f64,
        /// Greatest accepted value; ∞ for no limit.
        most: f64,
    },
    /// One word of a list.
    Choice {
        /// Accepted words.
        of: Vec<String>,
    },
    /// `true` or `false`.
    Flag,
}

/// Rule for an omitted argument. This enum gets no further variant: an omitted argument is an error, has no value or has a default.
///
/// ```
/// use taceva_core::{ArgSpec, Args, Presence};
/// let spec = ArgSpec::text("serial").optional();
/// assert_eq!(spec.presence, Presence::Optional);
/// assert_eq!(Args::parse(&[spec], "")?.get("serial"), None);
/// # Ok::<(), taceva_core::ArgError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Presence {
    /// The argument must be given.
    Required,
    /// The argument may be omitted, and then has no value.
    Optional,
    /// The argument may be omitted, and then has this value.
    Default(ArgValue),
}
