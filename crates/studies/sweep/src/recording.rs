//! Identity of a recording.

use std::path::Path;

use taceva_dataset::{Dataset, Digest};

use crate::error::SweepError;

/// Opens the recording at `path` and returns the digest of its whole content. `view` selects the pictures if samples have several.
///
/// The digest covers samples, frames, signals and every byte of the header: the sensor, its serial number, its footprint, and the source of the
/// samples.
///
/// # Errors
/// [`SweepError`] if the recording cannot be opened, or does not have this view.
pub(crate) fn opened(path: &Path, view: Option<&str>) -> Result<(Dataset, Digest), SweepError> {
    let whole = Dataset::open(path)?;
    let dataset = match view {
        Some(view) => whole.seen(view)?,
        None => whole,
    };
    let header = path.join("dataset.toml");
    let header = std::fs::read(&header).map_err(SweepError::io("read", &header))?;
    let parts = [
        dataset.digest().to_string(),
        Digest::of(&header).to_string(),
    ];
    Ok((dataset, Digest::of(parts.concat().as_bytes())))
}
