//! A whole scene, end to end: acquire every study, then fit, predict and score it.

mod folder;
mod layout;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use taceva_dataset::Dataset;
use taceva_protocol::{Cancel, StopCause};

use crate::acquire::{Workshop, acquire, key};
use crate::cache::StudyCache;
use crate::error::StudyError;
use crate::report::EvaluationReport;
use crate::scene::{PlannedScene, PlannedStudy, StudySource};
use crate::stage::{RunContext, assess};
use crate::work::Work;
pub use folder::{Existing, RunFolder};
pub(crate) use layout::{PLANS, RECORDINGS};

/// The reports of the studies of `scene`, in order; what is acquired is recorded in `folder`, several studies at a time.
///
/// Reports do not depend on `jobs`, nor on how often the run was interrupted and gone on with, nor on what was found in a cache.
///
/// # Errors
/// [`StudyError::Open`] and [`StudyError::Acquisition`] if a device failed or somebody wished to stop: the same call with the same folder
/// goes on. [`StudyError::Scene`] for a model that this program does not have; others as [`evaluate`](crate::evaluate).
pub fn run_scene(
    scene: &PlannedScene,
    folder: &RunFolder,
    workshop: Workshop<'_>,
    jobs: NonZeroUsize,
) -> Result<Vec<EvaluationReport>, StudyError> {
    scene.check_models(workshop.models)?;
    let datasets = acquire_scene(scene, folder, workshop, jobs)?;
    let work = Work {
        jobs,
        progress: workshop.progress,
        // Beside models and predictions, so that another setting of the model decodes no frame again.
        cache: workshop.cache,
    };
    let studies = scene.studies.iter().zip(&datasets);
    let assessed = studies.enumerate().map(|(number, (study, dataset))| {
        let context = RunContext {
            work,
            cache: workshop.cache_of(study, number),
            models: workshop.models,
            checkpoint: &folder.checkpoint(number, &study.plan.name),
        };
        assess(scene, study, dataset, context)
    });
    assessed.collect()
}

/// The recordings of all studies of `scene` in `folder`, in order: acquired, gone on with or found there, as [`run_scene`] does before it fits and
/// scores anything. Each worker takes the next study that nobody has taken; devices that are not simulated are there once, so that studies
/// take turns on them.
///
/// # Errors
/// [`StudyError::Open`] and [`StudyError::Acquisition`] as [`run_scene`]; [`StudyError::Request`] for a scene that needs hands where nobody can
/// be asked; [`StudyError::Dataset`] if it cannot be recorded.
pub fn acquire_scene(
    scene: &PlannedScene,
    folder: &RunFolder,
    workshop: Workshop<'_>,
    jobs: NonZeroUsize,
) -> Result<Vec<Dataset>, StudyError> {
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
    let is_real = |study: &PlannedStudy| match &study.source {
        StudySource::Rig(rig) => !rig.is_only_simulated(workshop.drivers),
        StudySource::Recording(_) => false,
    };
    let workers = match studies.iter().any(is_real) {
        true => 1,
        false => jobs.get().min(studies.len()),
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(study) = studies.get(number) else {
                        return;
                    };
                    let dataset = obtain(study, number, folder, (workshop, &cancel));
                    if dataset.is_err() {
                        // The others stop at their next motion: nobody waits hours to read of a failure.
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
    // Studies that were cancelled come after the one that failed.
    errors.sort_by_key(|result| matches!(result, Err(error) if is_cancelled(error)));
    errors.into_iter().chain(datasets).collect()
}

/// The recording of one study: pressed now, or there already.
fn obtain(
    study: &PlannedStudy,
    number: usize,
    folder: &RunFolder,
    (workshop, cancel): (Workshop<'_>, &Cancel),
) -> Result<Dataset, StudyError> {
    match &study.source {
        StudySource::Rig(rig) => {
            let path = folder.recording(number, &study.plan.name);
            let press = || acquire(study, rig, &path, (workshop, cancel));
            // A real rig is never replayed, and has no key.
            let key = workshop
                .cache
                .and_then(|cache| key(study, rig, (workshop.drivers, cache)));
            let Some(key) = key else {
                return press();
            };
            let cache = workshop.cache_of(study, number);
            let (dataset, is_found) = cache.recording(&key, &path, press)?;
            if is_found {
                let presses = study.plan.presses.len();
                workshop.progress.advance(presses as u64);
            }
            Ok(dataset)
        }
        StudySource::Recording(path) => Ok(Dataset::open(path)?),
    }
}

impl<'a> Workshop<'a> {
    /// The cache as study `number`, counted from 0, uses it.
    fn cache_of(self, study: &'a PlannedStudy, number: usize) -> StudyCache<'a> {
        StudyCache {
            cache: self.cache,
            number,
            study: &study.plan.name,
        }
    }
}

fn is_cancelled(error: &StudyError) -> bool {
    matches!(error, StudyError::Acquisition { source, .. } if matches!(source.cause, StopCause::Cancelled))
}
