//! What the value of an argument is, and whether it must be given.

use super::value::ArgValue;

/// What the value of an argument is.
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
    /// A file or a folder.
    Path,
    /// A whole number.
    Whole {
        /// The least that is accepted.
        least: i64,
        /// The greatest that is accepted.
        most: i64,
    },
    /// A finite number.
    Number {
        /// The least that is accepted; −∞ for any.
        least: f64,
        /// The greatest that is accepted; ∞ for any.
        most: f64,
    },
    /// One of some words.
    Choice {
        /// The words.
        of: Vec<String>,
    },
    /// `true` or `false`.
    Flag,
}

/// Whether an argument must be given. It gets no further variant: it must be given, or something or nothing stands in its place.
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
    /// It must.
    Required,
    /// It need not, and then the driver knows that it was not.
    Optional,
    /// It need not, and then it has this value.
    Default(ArgValue),
}
