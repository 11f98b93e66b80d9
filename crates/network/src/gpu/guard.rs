//! Catches panics of burn and its libraries, which are their only report of a failed device.

use taceva_core::contained;

use crate::error::NetworkError;

/// Runs `work` and turns a panic into [`NetworkError::Device`].
pub(crate) fn guard<T>(
    gpu: &str,
    work: impl FnOnce() -> Result<T, NetworkError>,
) -> Result<T, NetworkError> {
    // Unwind safety: an engine whose step failed makes no further step.
    contained(work).unwrap_or_else(|problem| {
        Err(NetworkError::Device {
            device: gpu.to_owned(),
            problem,
        })
    })
}
