//! Estimators of a library in this process.

#![expect(
    unsafe_code,
    reason = "models are fitted and called through the plugin's functions"
)]

mod listener;
mod model;
mod training_set;

use std::sync::Arc;

use taceva_abi as abi;
use taceva_core::{DriverKey, ErrorKind, ModelError};

use self::listener::{Listener, STEPS, progress};
use self::model::Model;
use self::training_set::Lent;
use crate::call::{ArgList, Failure, call, pending_call};
use crate::library::{Entry, Library};
use crate::session::{FitRequest, Saved, SavedRegressor};

/// Fits the estimator of `entry`.
pub(crate) fn fit(
    library: &Arc<Library>,
    entry: &Entry,
    request: &FitRequest<'_>,
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let key = entry.provided.key();
    let failed = |failure: Failure| model_error(key, "fit", failure);
    let fit = entry.estimators.and_then(|factory| factory.fit);
    let fit = fit.ok_or_else(|| failed(lacks("fit")))?;
    let list = ArgList::new(request.settings, entry.arguments());
    let args = list.args();
    let training = Lent::new(request.training).map_err(failed)?;
    let validation = request
        .validation
        .map(Lent::new)
        .transpose()
        .map_err(failed)?;
    let validation = validation.as_ref().map(|lent| lent.set());
    let validation = validation
        .as_ref()
        .map_or(std::ptr::null(), std::ptr::from_ref);
    let mut listener = Listener {
        progress: request.progress,
        reported: 0,
    };
    let mut regressor = EMPTY;
    let stage = format!("fit {key}, in thousandths");
    request.progress.begin(&stage, Some(STEPS));
    let training_set = training.set();
    let _under_way = pending_call::begin("fit");
    let done = call(|error| {
        let context = std::ptr::from_mut(&mut listener).cast();
        let training = &raw const training_set;
        let (args, into) = (&raw const args, &raw mut regressor);
        // SAFETY: [any], with settings, sets, a listener, a place for the model and an error that outlive the call.
        unsafe {
            fit(
                entry.number,
                args,
                training,
                validation,
                Some(progress),
                context,
                into,
                error,
            )
        }
    });
    request.progress.end();
    done.map_err(failed)?;
    let shape = request.training.features.shape();
    let channels = request.training.targets.channels.clone();
    let model = Model::new(library, key, regressor, channels, shape).map_err(failed)?;
    Ok(Box::new(model))
}

/// Loads a model that the estimator of `entry` saved.
pub(crate) fn load(
    library: &Arc<Library>,
    entry: &Entry,
    saved: &Saved<'_>,
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let key = entry.provided.key();
    let failed = |failure: Failure| model_error(key, "load", failure);
    let load = entry.estimators.and_then(|factory| factory.load);
    let load = load.ok_or_else(|| failed(lacks("load")))?;
    let mut regressor = EMPTY;
    let _under_way = pending_call::begin("load");
    call(|error| {
        let (bytes, length) = (saved.bytes.as_ptr(), saved.bytes.len() as u64);
        // SAFETY: [any], with bytes, a place for the model and an error that outlive the call.
        unsafe { load(entry.number, bytes, length, &raw mut regressor, error) }
    })
    .map_err(failed)?;
    let (channels, shape) = (saved.channels.clone(), saved.shape);
    let model = Model::new(library, key, regressor, channels, shape).map_err(failed)?;
    Ok(Box::new(model))
}

/// Error for an estimator that `library` lacks.
pub(crate) fn not_there(key: &DriverKey, library: &Library, doing: &'static str) -> ModelError {
    let why = format!(
        "the plugin `{}` has no estimator of that name",
        library.id()
    );
    model_error(key, doing, Failure::new(ErrorKind::NotFound, why))
}

fn model_error(key: &DriverKey, doing: &'static str, failure: Failure) -> ModelError {
    let kind = failure.kind();
    ModelError::new(kind, format!("{key}: cannot {doing}: {failure}"))
}

fn lacks(what: &str) -> Failure {
    Failure::new(ErrorKind::Unsupported, format!("its `{what}` is NULL"))
}

const EMPTY: abi::Regressor = abi::Regressor {
    handle: std::ptr::null_mut(),
    calls: std::ptr::null(),
};
