//! Preview of a sensor without recording.

use taceva_core::Progress;

use super::LiveDevices;
use super::predictor::LivePredictor;
use crate::error::AcquireError;
use crate::viewer::Viewer;

/// Shows the frames and forces of `live` in `viewer` until the preview is cancelled. If there is a predictor, its callback shows the frames instead
/// of the viewer.
///
/// # Errors
/// [`AcquireError::Device`] if a device fails. [`AcquireError::Model`] if the model cannot read the frames, or fails.
pub fn preview(
    live: &mut LiveDevices,
    viewer: &dyn Viewer,
    predictor: Option<&LivePredictor<'_>>,
    progress: &dyn Progress,
) -> Result<(), AcquireError> {
    let failed = AcquireError::Device;
    live.begin().map_err(failed)?;
    if let Some(predictor) = predictor {
        let is_asked = predictor.model().asks_for_reference();
        let untouched = is_asked.then(|| live.untouched()).transpose();
        predictor.begin(live.frame_info(), untouched.map_err(failed)?.as_ref())?;
    }
    let ((), device) = live.stream(predictor, |streams| {
        let mut is_over = false;
        while !is_over {
            let has_failed = predictor.is_some_and(|predictor| predictor.failure().is_some());
            if progress.is_cancelled() || has_failed {
                streams.end();
            }
            match streams.next() {
                Ok(Some(taken)) if predictor.is_none() => viewer.frame(&taken.frame),
                Ok(_) => {}
                Err(_) => is_over = true,
            }
            if let Some(wrench) = streams.track.and_then(|track| track.newest()) {
                viewer.force(&wrench);
            }
            viewer.lost(streams.facts());
        }
    });
    if let Some(predictor) = predictor
        && let Some(problem) = predictor.failure()
    {
        return Err(predictor.model().refused(problem.to_owned()));
    }
    match device {
        Some(error) if error.kind() != taceva_core::ErrorKind::EndOfStream => Err(failed(error)),
        _ => Ok(()),
    }
}
