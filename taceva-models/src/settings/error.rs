//! Why settings cannot be used.

use taceva_core::ArgError;
use taceva_network::{GpuError, GpuKind};

use super::Suggestion;

/// Why settings cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// A word without `=`.
    #[error("`{word}`: expected key=value", word = taceva_core::shown(word))]
    Form {
        /// The word as typed.
        word: String,
    },
    /// A key given twice.
    #[error("`{key}`: given twice", key = taceva_core::shown(key))]
    Twice {
        /// The key.
        key: String,
    },
    /// A key that nobody reads.
    #[error("`{key}`: unknown key, {suggestion}", key = taceva_core::shown(key))]
    Unknown {
        /// The key as typed.
        key: String,
        /// What it may have been meant to be.
        suggestion: Suggestion,
    },
    /// A value outside what its key accepts.
    #[error("`{key}={found}`: expected {accepts}", found = taceva_core::shown(found))]
    Value {
        /// The key.
        key: &'static str,
        /// The value as typed.
        found: String,
        /// What would be accepted.
        accepts: &'static str,
    },
    /// A device that this program cannot reach.
    #[error("`device={kind}`: {source}")]
    Device {
        /// How it would be reached.
        kind: GpuKind,
        /// Why it cannot be.
        source: GpuError,
    },
    /// A setting that the estimator of a plugin does not take.
    #[error(transparent)]
    Argument(#[from] ArgError),
}
