//! Reasons for a missing decision.

use taceva_core::{shown, suggestion};
use thiserror::Error;

/// Names of all rules.
const RULES: [&str; 4] = ["simple", "guarded", "probability", "shared"];

/// Reason why no decision is possible.
///
/// ```
/// use taceva_metrology::conformity::{ConformityError, Limits};
/// let refused = Limits::between(0.5, 0.2);
/// assert!(matches!(refused, Err(ConformityError::Limits { .. })));
/// ```
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ConformityError {
    /// A number outside its allowed range.
    #[error("{name} is {value}, expected {expected}")]
    Number {
        /// Name of the number.
        name: &'static str,
        /// Value found.
        value: f64,
        /// Accepted values.
        expected: &'static str,
    },
    /// Limits that exclude every value.
    #[error("the limits are {least} and {most}, expected a lower limit below an upper limit")]
    Limits {
        /// Lower limit.
        least: f64,
        /// Upper limit.
        most: f64,
    },
    /// A setting that belongs to another rule.
    #[error(
        "`{setting}` belongs to rule = \"{expected}\", but the rule is \"{}\": remove the setting, or change the rule",
        shown(.rule)
    )]
    BothRules {
        /// Name of the misplaced setting.
        setting: &'static str,
        /// Rule found.
        rule: String,
        /// Rule that has this setting.
        expected: &'static str,
    },
    /// A rule without its required setting.
    #[error("rule = \"{rule}\" needs `{setting}`")]
    MissingSetting {
        /// Rule found.
        rule: &'static str,
        /// Name of the setting.
        setting: &'static str,
    },
    /// An unknown rule.
    #[error("rule = \"{}\": {}", shown(.rule), suggestion(.rule, &RULES))]
    UnknownRule {
        /// Name found.
        rule: String,
    },
}

/// Rejects `value` unless `is_right` is true.
pub(super) fn check(
    name: &'static str,
    value: f64,
    is_right: bool,
    expected: &'static str,
) -> Result<(), ConformityError> {
    match is_right {
        true => Ok(()),
        false => Err(ConformityError::Number {
            name,
            value,
            expected,
        }),
    }
}
