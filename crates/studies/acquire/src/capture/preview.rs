//! Looking at a sensor without recording anything.

use taceva_core::Progress;

use super::LiveDevices;
use crate::error::AcquireError;
use crate::viewer::Viewer;

/// Shows `viewer` what `live` sees until somebody cancels.
///
/// # Errors
/// [`AcquireError::Device`] if a device failed.
pub fn preview(
    live: &mut LiveDevices,
    viewer: &dyn Viewer,
    progress: &dyn Progress,
) -> Result<(), AcquireError> {
    let failed = AcquireError::Device;
    live.begin().map_err(failed)?;
    let ((), device) = live.stream(|streams| {
        let mut is_over = false;
        while !is_over {
            if progress.is_cancelled() {
                streams.end();
            }
            match streams.next() {
                Ok(Some(taken)) => viewer.frame(&taken.frame),
                Ok(None) => {}
                Err(_) => is_over = true,
            }
            if let Some(wrench) = streams.track.and_then(|track| track.newest()) {
                viewer.force(&wrench);
            }
            viewer.lost(streams.facts());
        }
    });
    match device {
        Some(error) if error.kind() != taceva_core::ErrorKind::EndOfStream => Err(failed(error)),
        _ => Ok(()),
    }
}
