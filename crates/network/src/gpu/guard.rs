//! Catches panics of burn and its libraries, because they report a failed device only by a panic.

use taceva_core::contained;

use crate::error::NetworkError;

/// Runs `work`, and converts a panic to [`NetworkError::Device`].
pub(crate) fn guard<T>(
    gpu: &str,
    work: impl FnOnce() -> Result<T, NetworkError>,
) -> Result<T, NetworkError> {
    // Unwind safety: an engine never runs again after a failed step.
    contained(work).unwrap_or_else(|problem| {
        Err(NetworkError::Device {
            device: gpu.to_owned(),
            problem,
        })
    })
}
