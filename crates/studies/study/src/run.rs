//! Runs a whole scene: acquires, fits, predicts and scores every study.

mod folder;
mod layout;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use taceva_acquire::{AcquireError, PlannedScene, PlannedStudy, Workshop};
use taceva_dataset::Dataset;
use taceva_evaluate::{Cache, CachedStage, Key, StudyCache, Work};
use taceva_models::Models;
use taceva_protocol::{Cancel, StopCause};

use crate::error::StudyError;
use crate::finished::FinishedStudy;
use crate::models::check_models;
use crate::stage::{RunContext, assess};
pub use folder::{Existing, RunFolder};

/// Resources of a run: devices, models, cache and threads.
#[derive(Clone, Copy)]
pub struct RunSetup<'a> {
    /// Devices of the run, with operator, progress display and viewer.
    pub workshop: Workshop<'a>,
    /// Models that the program knows.
    pub models: &'a Models,
    /// Cache of the results of finished stages; `None` runs every stage.
    pub cache: Option<&'a Cache>,
    /// Number of worker threads.
    pub jobs: NonZeroUsize,
}

/// Records and evaluates the studies of `scene` in `folder`, several at the same time, and returns the finished studies in order.
///
/// Reports do not depend on `jobs`, on interruptions of the run, or on the content of a cache.
///
/// # Errors
/// [`AcquireError::Open`] and [`AcquireError::Acquisition`] if a device failed or the run was cancelled: the same call resumes it.
/// [`AcquireError::Scene`] for an unknown model; others as [`evaluate`](taceva_evaluate::evaluate).
pub fn run_scene(
    scene: &PlannedScene,
    folder: &RunFolder,
    setup: RunSetup<'_>,
) -> Result<Vec<FinishedStudy>, StudyError> {
    check_models(scene, setup.models)?;
    let datasets = acquire_scene(scene, folder, setup)?;
    let work = Work {
        jobs: setup.jobs,
        progress: setup.workshop.progress,
        // Also caches small features, so that other model settings need no decoding.
        cache: setup.cache,
    };
    let studies = scene.studies.iter().zip(datasets);
    let assessed = studies.enumerate().map(|(number, (study, dataset))| {
        let model = folder.model(number, &study.plan.name);
        let keeps_models = scene.scene.report.keeps_models();
        let context = RunContext {
            work,
            cache: setup.cache_of(study, number),
            models: setup.models,
            checkpoint: &folder.checkpoint(number, &study.plan.name),
            states: &folder.states(number, &study.plan.name),
            model: keeps_models.then_some(model.as_path()),
        };
        assess(scene, study, dataset, context)
    });
    assessed.collect()
}

/// Returns the recordings of all studies of `scene` in `folder`, in order. Each recording is found, resumed or acquired, as by [`run_scene`]. Each
/// worker takes the next free study. Real devices exist only once, so their studies run in turn.
///
/// # Errors
/// [`AcquireError::Open`] and [`AcquireError::Acquisition`] as [`run_scene`]; [`AcquireError::Request`] for a scene that needs an operator if there
/// is none; [`AcquireError::Dataset`] if the recording cannot be written.
pub fn acquire_scene(
    scene: &PlannedScene,
    folder: &RunFolder,
    setup: RunSetup<'_>,
) -> Result<Vec<Dataset>, StudyError> {
    let workshop = setup.workshop;
    if workshop.operator.is_none() {
        scene.check_unattended(workshop.drivers)?;
    }
    let studies = &scene.studies;
    let presses: usize = studies.iter().map(|study| study.plan.presses.len()).sum();
    workshop.progress.begin("press", Some(presses as u64));
    let cancel = Cancel::new();
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<Option<Result<Dataset, StudyError>>>> =
        Mutex::new(studies.iter().map(|_| None).collect());
    let mut all = studies.iter();
    let workers = match all.any(|study| study.is_real(workshop.drivers)) {
        true => 1,
        false => setup.jobs.get().min(studies.len()),
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(study) = studies.get(number) else {
                        return;
                    };
                    let dataset = obtain(study, number, folder, setup, &cancel);
                    if dataset.is_err() {
                        // The other studies stop at their next motion, so that a failure is reported at once.
                        cancel.cancel();
                    }
                    done.lock().unwrap_or_else(PoisonError::into_inner)[number] = Some(dataset);
                }
            });
        }
    });
    workshop.progress.end();
    let done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    let done: Vec<Result<Dataset, StudyError>> = done.into_iter().flatten().collect();
    let (datasets, mut errors): (Vec<_>, Vec<_>) = done.into_iter().partition(Result::is_ok);
    // The study that failed sorts before the cancelled studies.
    errors.sort_by_key(|result| matches!(result, Err(error) if is_cancelled(error)));
    errors.into_iter().chain(datasets).collect()
}

/// Recording of one study, from the cache if it is there, otherwise acquired now.
fn obtain(
    study: &PlannedStudy,
    number: usize,
    folder: &RunFolder,
    setup: RunSetup<'_>,
    cancel: &Cancel,
) -> Result<Dataset, StudyError> {
    let workshop = setup.workshop;
    let path = folder.recording(number, &study.plan.name);
    let press = || Ok(study.acquire(&path, workshop, cancel)?);
    let key = setup.cache.and_then(|cache| {
        let parts = study.content_key(workshop.drivers)?;
        let key = Key::of(CachedStage::Acquire).part("models", cache.models());
        let key = parts
            .iter()
            .fold(key, |key, (name, part)| key.part(name, part));
        Some(key.finish())
    });
    // A study on a real rig has no key, because it cannot be repeated.
    let Some(key) = key else {
        return press();
    };
    let cache = setup.cache_of(study, number);
    let (dataset, is_found) = cache.recording(&key, &path, press)?;
    if is_found {
        let presses = study.plan.presses.len();
        workshop.progress.advance(presses as u64);
    }
    Ok(dataset)
}

impl<'a> RunSetup<'a> {
    /// Cache for study `number`, counted from 0.
    fn cache_of(self, study: &'a PlannedStudy, number: usize) -> StudyCache<'a> {
        StudyCache {
            cache: self.cache,
            number,
            study: &study.plan.name,
        }
    }
}

fn is_cancelled(error: &StudyError) -> bool {
    matches!(error, StudyError::Acquire(AcquireError::Acquisition { source, .. }) if matches!(source.cause, StopCause::Cancelled))
}
