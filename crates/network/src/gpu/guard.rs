//! Catches panics of burn and the libraries below it, which report a failed device in no other way.

use taceva_core::contained;

use crate::error::NetworkError;

/// What `work` gives, or why the device could not do it.
pub(crate) fn guard<T>(
    gpu: &str,
    work: impl FnOnce() -> Result<T, NetworkError>,
) -> Result<T, NetworkError> {
    // What was half done is of no use: an engine whose step failed makes no other.
    contained(work).unwrap_or_else(|problem| {
        Err(NetworkError::Device {
            device: gpu.to_owned(),
            problem,
        })
    })
}
