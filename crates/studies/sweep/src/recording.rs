//! What tells one recording from another.

use std::path::Path;

use taceva_dataset::{Dataset, Digest};

use crate::error::SweepError;

/// The recording at `path`, and the digest of all that it says: samples, frames and signals, and every byte of its header, which names the sensor,
/// its serial number, its footprint and whether anything was measured.
///
/// # Errors
/// [`SweepError`] if it cannot be opened.
pub(crate) fn opened(path: &Path) -> Result<(Dataset, Digest), SweepError> {
    let dataset = Dataset::open(path)?;
    let header = path.join("dataset.toml");
    let header = std::fs::read(&header).map_err(SweepError::io("read", &header))?;
    let parts = [
        dataset.digest().to_string(),
        Digest::of(&header).to_string(),
    ];
    Ok((dataset, Digest::of(parts.concat().as_bytes())))
}
