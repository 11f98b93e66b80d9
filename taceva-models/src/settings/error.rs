//! Errors of settings.

use taceva_core::ArgError;
use taceva_network::{GpuError, GpuKind};

use super::Suggestion;

/// Error of settings.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// A setting has no `=`.
    #[error("`{word}`: expected key=value", word = taceva_core::shown(word))]
    Form {
        /// Word as typed.
        word: String,
    },
    /// A key is repeated.
    #[error("`{key}`: given twice", key = taceva_core::shown(key))]
    Twice {
        /// Repeated key.
        key: String,
    },
    /// A key is unknown.
    #[error("`{key}`: unknown key, {suggestion}", key = taceva_core::shown(key))]
    Unknown {
        /// Key as typed.
        key: String,
        /// Suggested keys.
        suggestion: Suggestion,
    },
    /// The value of a key is not accepted.
    #[error("`{key}={found}`: expected {accepts}", found = taceva_core::shown(found))]
    Value {
        /// The key.
        key: &'static str,
        /// Value as typed.
        found: String,
        /// Accepted values.
        accepts: &'static str,
    },
    /// The device is not available in this program.
    #[error("`device={kind}`: {source}")]
    Device {
        /// Requested programming interface.
        kind: GpuKind,
        /// Reason why the device is not available.
        source: GpuError,
    },
    /// A plugin estimator rejects a setting.
    #[error(transparent)]
    Argument(#[from] ArgError),
}
