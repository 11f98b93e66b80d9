//! Frames of a dataset, turned into features: one decoded frame a worker, only the features stay.

use taceva_core::{FeatureShape, Features};
use taceva_dataset::{Dataset, Pass};
use taceva_models::{Extractor, FeatureSpec};

use crate::error::StudyError;
use crate::work::Work;

/// The extractor that `spec` asks for on the frames of `dataset`.
pub(crate) fn extractor(dataset: &Dataset, spec: FeatureSpec) -> Result<Extractor, StudyError> {
    let frames = dataset.header().frames.as_ref();
    let info = frames
        .ok_or_else(|| {
            StudyError::Request("the dataset has no frames, the model needs them".to_owned())
        })?
        .info;
    let reference = if spec.asks_for_reference().is_some() {
        dataset.reference()?
    } else {
        None
    };
    Ok(Extractor::new(spec, info, reference.as_ref())?)
}

/// The features of `rows`, in that order: those that were kept of them, or made now.
///
/// # Shapes
/// `[rows, height, width, depth]`; memory is that of the features and a few frames a worker.
pub(crate) fn extract(
    dataset: &Dataset,
    extractor: &Extractor,
    rows: &[usize],
    work: Work<'_>,
) -> Result<Features, StudyError> {
    let make = || make(dataset, extractor, rows, work);
    match work.cache {
        Some(cache) => cache.features((dataset, extractor, rows), make),
        None => make(),
    }
}

fn make(
    dataset: &Dataset,
    extractor: &Extractor,
    rows: &[usize],
    work: Work<'_>,
) -> Result<Features, StudyError> {
    let shape = extractor.shape();
    let mut values = Vec::with_capacity(rows.len() * shape.len());
    let pass = Pass::new(rows, work.jobs, work.progress);
    dataset.map_frames(
        pass,
        |_, frame| {
            let mut sample = vec![0.0; shape.len()];
            extractor.extract(&frame, &mut sample).map(|()| sample)
        },
        |_, sample| {
            values.extend(sample?);
            Ok(())
        },
    )?;
    Ok(Features::new(shape, values)?)
}

/// Features of no information, for models that look at none: no frame is decoded for them.
pub(crate) fn blank(shape: FeatureShape, rows: usize) -> Result<Features, StudyError> {
    Ok(Features::new(shape, vec![0.0; rows * shape.len()])?)
}
