//! Size of the frames in a recording: full, or reduced as the scene requires.

use taceva_core::Sample;
use taceva_models::{FeatureError, FrameReduction};

use super::OpenRig;
use crate::error::AcquireError;
use crate::scene::PlannedStudy;

/// Reduction of the frames of `open` before they are recorded; `None` to record full frames.
///
/// # Errors
/// [`AcquireError::Request`] if the open camera has smaller frames than the scene requires.
pub(super) fn reduction(
    study: &PlannedStudy,
    open: &OpenRig,
) -> Result<Option<FrameReduction>, AcquireError> {
    let (Some(kept), Some(sensor)) = (study.plan.kept_frames, &open.sensor) else {
        return Ok(None);
    };
    let reduction = FrameReduction::new(sensor.frame_info(), [kept.width, kept.height]);
    let reduction = reduction.map_err(|error| {
        let name = &study.plan.name;
        AcquireError::Request(format!(
            "study `{name}`: `frames` of [recording] is `{kept}`: {error}"
        ))
    })?;
    Ok(Some(reduction))
}

/// Reduces the frames of `samples`. The stored brightness is the brightness of the full frames.
///
/// # Errors
/// [`FeatureError::Kind`] for a frame whose size or format differs from the statement of the camera.
pub(super) fn reduced(
    samples: &[Sample],
    reduction: &FrameReduction,
) -> Result<Vec<Sample>, FeatureError> {
    let one = |sample: &Sample| {
        let mut kept = sample.clone();
        if let Some(frame) = kept.frame.take() {
            kept.intensity = kept.intensity.or_else(|| Some(frame.mean_luma()));
            kept.frame = Some(reduction.reduce(&frame)?);
        }
        Ok(kept)
    };
    samples.iter().map(one).collect()
}
