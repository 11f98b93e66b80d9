//! Facts of a sensor that metrics need, apart from its samples.

use taceva_dataset::{Dataset, FramesInfo, Known, SensorFile};
use taceva_metrics::SensorFacts;

use crate::error::EvaluateError;

/// Sensor facts of `file`. Missing facts are read from the header of `dataset`.
///
/// # Errors
/// [`EvaluateError::Request`] if the header has a footprint with impossible lengths.
pub(crate) fn of_dataset(
    dataset: &Dataset,
    file: Option<&SensorFile>,
) -> Result<SensorFacts, EvaluateError> {
    let header = dataset.header();
    let footprint = header
        .footprint
        .as_ref()
        .map(|footprint| footprint.to_core());
    let footprint = footprint.transpose().map_err(EvaluateError::Request)?;
    let opaque = match header.sensor.opaque {
        Known::Is(opaque) => Some(opaque),
        Known::Unknown => None,
    };
    let camera = header.frames.as_ref().map(FramesInfo::of_camera);
    let stated = SensorFacts::default()
        .with_footprint(footprint)
        .with_opaque(opaque)
        .with_frame_size(camera.map(|camera| [camera.width, camera.height]));
    Ok(match file {
        Some(file) => of_file(file, stated),
        None => stated,
    })
}

/// Facts of `file`. Missing facts come from `otherwise`.
pub(crate) fn of_file(file: &SensorFile, otherwise: SensorFacts) -> SensorFacts {
    let reference_scene = file.reference_scene.clone();
    SensorFacts::default()
        .with_footprint(file.footprint.or(otherwise.footprint))
        .with_opaque(file.opaque.or(otherwise.opaque))
        .with_reference_scene(reference_scene.unwrap_or(otherwise.reference_scene))
        .with_frame_size(file.frame_size.or(otherwise.frame_size))
}
