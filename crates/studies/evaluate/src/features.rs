//! Features of the frames or signals of a dataset. Each worker stores one decoded frame at a time; only the features are kept.

mod model_input;
mod table;
mod windows;

use std::num::NonZeroUsize;

use taceva_core::{ErrorKind, FeatureShape, Features, Input, InputInfo};
use taceva_dataset::{Dataset, DatasetError, Pass};
use taceva_models::{Extractor, FeatureSpec};

use crate::cache::{Cache, ONE_MAX};
use crate::error::EvaluateError;
use crate::recordings;
use crate::work::Work;

pub(crate) use model_input::{Sight, kinds, recorded_frames};
pub use table::{FeatureTable, feature_table};
pub(crate) use windows::{extract_as, rows_read};

/// Extractor for `spec` on the frames or signals of `dataset`.
pub fn extractor(dataset: &Dataset, spec: FeatureSpec) -> Result<Extractor, EvaluateError> {
    let sight = Sight::of(dataset, &spec)?;
    let sight = sight.map_err(|absent| {
        EvaluateError::Request(format!("the model needs {absent}, which the dataset lacks"))
    })?;
    Ok(Extractor::new(spec, sight.info(), sight.reference())?)
}

/// Features of `rows`, in this order, from the cache or computed now. `extractor` returns the extractor for one recording. Each recording needs its own
/// extractor, because its contact-free reference differs.
///
/// Returns `[rows, height, width, depth]`. Memory contains the features and a few frames for each worker. For joined recordings, it also contains the features
/// of the longest run of rows of one recording.
pub fn extract(
    dataset: &Dataset,
    extractor: impl Fn(&Dataset) -> Result<Extractor, EvaluateError>,
    rows: &[usize],
    work: Work<'_>,
) -> Result<Features, EvaluateError> {
    let mut runs = recordings::runs(dataset, rows);
    if runs.len() < 2 {
        let (recording, rows) = runs.pop().unwrap_or((dataset, Vec::new()));
        return of_recording(recording, &extractor(recording)?, &rows, work);
    }
    let mut shape = None;
    let mut values = Vec::new();
    for (recording, own) in runs {
        let part = of_recording(recording, &extractor(recording)?, &own, work)?;
        if shape.replace(part.shape()).is_none() {
            values.reserve_exact(rows.len() * part.shape().len());
        }
        values.extend_from_slice(part.values());
    }
    let shape = shape.expect("at least two runs");
    Ok(Features::new(shape, values)?)
}

/// The features of `rows` of one recording.
fn of_recording(
    recording: &Dataset,
    extractor: &Extractor,
    rows: &[usize],
    work: Work<'_>,
) -> Result<Features, EvaluateError> {
    let make = || make(recording, extractor, rows, work);
    match work.cache {
        Some(cache) if cache.is_of_many() => of_whole(recording, extractor, rows, cache, work),
        Some(cache) => cache.features(recording, extractor, rows, make),
        None => make(),
    }
}

/// Features of `rows`, selected from the features of the whole recording, which other tasks also need. Computes only `rows` if the features of the whole
/// recording cannot be stored, or if a frame outside `rows` cannot be read.
fn of_whole(
    recording: &Dataset,
    extractor: &Extractor,
    rows: &[usize],
    cache: &Cache,
    work: Work<'_>,
) -> Result<Features, EvaluateError> {
    let table = recording.table();
    let all: Vec<usize> = match (cache.rows(), extractor.input()) {
        (Some(rows), _) => rows.to_vec(),
        (None, InputInfo::Signals(_)) => recording.all_rows(),
        _ => (0..table.rows())
            .filter(|row| table.frames()[*row].is_some())
            .collect(),
    };
    let positions = rows.iter().map(|row| all.binary_search(row).ok());
    let positions: Option<Vec<usize>> = positions.collect();
    let own = || {
        cache.features(recording, extractor, rows, || {
            make(recording, extractor, rows, work)
        })
    };
    let bytes = all.len() as u64 * extractor.shape().len() as u64 * 4;
    let is_kept = bytes <= ONE_MAX || cache.is_in_memory();
    let Some(positions) = positions.filter(|_| is_kept) else {
        return own();
    };
    let whole = cache.whole_features(recording, extractor, &all, || {
        make(recording, extractor, &all, work)
    });
    match whole {
        Ok(whole) => Ok(whole.select(&positions)),
        Err(error) if error.kind() == ErrorKind::Interrupted => Err(error),
        Err(_) => own(),
    }
}

fn make(
    dataset: &Dataset,
    extractor: &Extractor,
    rows: &[usize],
    work: Work<'_>,
) -> Result<Features, EvaluateError> {
    let shape = extractor.shape();
    let mut values = Vec::with_capacity(rows.len() * shape.len());
    let of = |input: Input<'_>| {
        let mut sample = vec![0.0; shape.len()];
        extractor.extract(input, &mut sample).map(|()| sample)
    };
    let pass = Pass::new(rows, work.jobs, work.progress);
    match extractor.input() {
        InputInfo::Signals(_) => {
            // One thread, because several would share one file.
            let pass = Pass::new(rows, NonZeroUsize::MIN, work.progress);
            let read = |row| {
                let signals = dataset.signals(row)?;
                let signals = signals.ok_or_else(|| {
                    DatasetError::request(dataset.path(), format!("row {row} has no signals"))
                })?;
                Ok(of((&signals).into()))
            };
            dataset.map_rows(pass, "read signals", read, |row, sample| {
                let sample = sample.map_err(|source| DatasetError::Sink {
                    row,
                    source: source.into(),
                });
                values.extend(sample?);
                Ok(())
            })?;
        }
        _ => dataset.map_frames(
            pass,
            |_, frame| of((&frame).into()),
            |_, sample| {
                values.extend(sample?);
                Ok(())
            },
        )?,
    }
    Ok(Features::new(shape, values)?)
}

/// Features that are all zero, for models that use no features. Reads no frame.
pub fn blank(shape: FeatureShape, rows: usize) -> Result<Features, EvaluateError> {
    Ok(Features::new(shape, vec![0.0; rows * shape.len()])?)
}
