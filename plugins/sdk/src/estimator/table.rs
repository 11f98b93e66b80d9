//! Functions with which the host calls estimators and fitted models.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;
use std::sync::Arc;

use taceva_abi::{
    Args as AbiArgs, Error, EstimatorFactory as Table, Progress as Report,
    Regressor as AbiRegressor, RegressorCalls, Status, TakeText, TrainingSet as AbiSet,
};
use taceva_core::{
    Channels, ErrorKind, FeatureShape, Features, SavedRegressor, Targets, TrainingSet,
};

use super::progress::ReportedProgress;
use super::{EstimatorFactory, FitRequest, model_bytes};
use crate::driver_lists::loaded;
use crate::failure::Failure;
use crate::guard::guard;
use crate::handles;
use crate::table::estimator_table;
use crate::{factory, memory};

/// Table of functions of a plugin with `estimators` estimators.
pub(crate) fn table(estimators: u32) -> Table {
    #[expect(clippy::cast_possible_truncation, reason = "thirty-two bytes")]
    let size = size_of::<Table>() as u32;
    Table {
        size,
        estimators,
        describe: Some(describe),
        fit: Some(fit),
        load: Some(load),
    }
}

static CALLS: RegressorCalls = RegressorCalls {
    #[expect(clippy::cast_possible_truncation, reason = "thirty-two bytes")]
    size: size_of::<RegressorCalls>() as u32,
    reserved: 0,
    close: Some(close),
    predict: Some(predict),
    save: Some(save),
};

type Kept = Box<dyn SavedRegressor>;

fn estimator(number: u32) -> Result<&'static dyn EstimatorFactory, Failure> {
    let estimators = &loaded()?.estimators;
    let found = usize::try_from(number)
        .ok()
        .and_then(|number| estimators.get(number));
    let found = found.ok_or_else(|| {
        let count = estimators.len();
        Failure::argument(format!(
            "no estimator has the number {number}, expected less than {count}"
        ))
    })?;
    Ok(&**found)
}

unsafe extern "C" fn describe(
    number: u32,
    take: TakeText,
    context: *mut c_void,
    error: *mut Error,
) -> Status {
    let work = || {
        let estimator = estimator(number)?;
        let table = estimator_table(estimator);
        // SAFETY: the host passes its own function and context.
        unsafe { memory::hand(take, context, &table) }
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

unsafe extern "C" fn fit(
    number: u32,
    settings: *const AbiArgs,
    training: *const AbiSet,
    validation: *const AbiSet,
    report: Report,
    context: *mut c_void,
    regressor: *mut AbiRegressor,
    error: *mut Error,
) -> Status {
    let work = || {
        // SAFETY: the host provides memory for the model.
        let place = unsafe { memory::place("regressor", regressor) }?;
        let estimator = estimator(number)?;
        // SAFETY: the host lends settings and both sets for the call.
        let (settings, training) = unsafe {
            (
                factory::args(settings, estimator.settings())?,
                Set::read(training)?,
            )
        };
        let validation = match validation.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { Set::read(validation) }?),
        };
        let fitted = estimator.fit(
            &FitRequest::new(
                &settings,
                &training.borrowed(),
                &ReportedProgress::new(report, context),
            )
            .with_validation(validation.as_ref().map(Set::borrowed).as_ref()),
        )?;
        *place = opened(fitted);
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

unsafe extern "C" fn load(
    number: u32,
    bytes: *const u8,
    length: u64,
    regressor: *mut AbiRegressor,
    error: *mut Error,
) -> Status {
    let work = || {
        // SAFETY: the host provides memory for the model, and lends its bytes for the call.
        let (place, bytes) = unsafe {
            let place = memory::place("regressor", regressor)?;
            (place, memory::list("bytes", bytes, whole(length)?)?)
        };
        let estimator = estimator(number)?;
        *place = opened(model_bytes::read(
            bytes,
            |saved| Ok(estimator.load(saved)?),
        )?);
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

fn opened(regressor: Kept) -> AbiRegressor {
    AbiRegressor {
        handle: handles::keep(regressor),
        calls: &raw const CALLS,
    }
}

unsafe extern "C" fn close(handle: *mut c_void) {
    handles::close(handle);
}

unsafe extern "C" fn predict(
    handle: *const c_void,
    features: *const f32,
    features_length: u64,
    samples: u64,
    into: *mut f64,
    into_length: u64,
    error: *mut Error,
) -> Status {
    let work = || {
        let regressor: Arc<Kept> = handles::find(handle)?;
        let (samples, shape) = (whole(samples)?, regressor.shape());
        let channels = regressor.channels().len();
        // The model's shape may come from an untrusted file, but the host knows the lengths.
        let taken = times(samples, shape.len())?;
        let given = times(samples, channels)?;
        if whole(features_length)? != taken || whole(into_length)? != given {
            return Err(Failure::argument(format!(
                "{features_length} features and a buffer of {into_length} numbers, expected {taken} and {given}"
            )));
        }
        // SAFETY: the host lends features and memory of the stated lengths.
        let (features, into) = unsafe {
            let features = memory::list("features", features, taken)?;
            (features, memory::list_place("into", into, given)?)
        };
        let features = Features::new(shape, features.to_vec())?;
        regressor.predict(&features, into)?;
        match into.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(Failure::device(format!("a prediction of {value}"))),
            None => Ok(()),
        }
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

unsafe extern "C" fn save(
    handle: *const c_void,
    into: *mut u8,
    length: *mut u64,
    error: *mut Error,
) -> Status {
    let work = || {
        let regressor: Arc<Kept> = handles::find(handle)?;
        // SAFETY: the host provides memory for the length.
        let length = unsafe { memory::place("length", length) }?;
        let room = if into.is_null() { 0 } else { whole(*length)? };
        let bytes = model_bytes::write(&**regressor)?;
        *length = bytes.len() as u64;
        if room < bytes.len() {
            let message = format!("a buffer of {room} bytes, expected {}", bytes.len());
            return Err(Failure::new(ErrorKind::OutOfRange, message));
        }
        // SAFETY: the host states that `into` has this length.
        unsafe { memory::list_place("into", into, bytes.len()) }?.copy_from_slice(&bytes);
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

/// Training samples from the host, checked and copied.
struct Set {
    features: Features,
    channels: Channels,
    targets: Vec<f64>,
    groups: Option<Vec<u32>>,
}

impl Set {
    /// # Safety
    /// `set` is NULL or points to a training set. Its arrays have the stated lengths. All stay unchanged during the call.
    unsafe fn read(set: *const AbiSet) -> Result<Set, Failure> {
        // SAFETY: guaranteed by the caller.
        let set = unsafe { memory::sized("training set", set) }?;
        let [height, width, depth, columns] =
            [set.height, set.width, set.depth, set.channels].map(|count| whole(count.into()));
        let (height, width, depth) = (height?, width?, depth?);
        let (samples, columns) = (whole(set.samples)?, columns?);
        let numbers = times(times(samples, height)?, times(width, depth)?)?;
        // SAFETY: guaranteed by the caller, for all four.
        let (features, targets, names) = unsafe {
            (
                memory::list("features", set.features, numbers)?,
                memory::list("targets", set.targets, times(samples, columns)?)?,
                memory::list("channel_names", set.channel_names, columns)?,
            )
        };
        let groups = match set.groups.is_null() {
            true => None,
            // SAFETY: as above.
            false => Some(unsafe { memory::list("groups", set.groups, samples) }?.to_vec()),
        };
        if features.iter().any(|number| !number.is_finite())
            || targets.iter().any(|number| !number.is_finite())
        {
            return Err(Failure::argument(
                "a number of the training set is not finite",
            ));
        }
        let mut list = Vec::with_capacity(columns);
        for name in names {
            // SAFETY: as above.
            list.push(model_bytes::channel(unsafe {
                memory::text("channel_names", *name)
            }?)?);
        }
        let channels =
            Channels::new(list.clone()).map_err(|error| Failure::argument(error.to_string()))?;
        if channels.as_slice() != list {
            let message = "the channels are in the wrong order, expected `Px Py Pz Fx Fy Fz`, then others by name";
            return Err(Failure::argument(message));
        }
        let shape = FeatureShape {
            height,
            width,
            depth,
        };
        Ok(Set {
            features: Features::new(shape, features.to_vec())?,
            channels,
            targets: targets.to_vec(),
            groups,
        })
    }

    fn borrowed(&self) -> TrainingSet<'_> {
        TrainingSet::new(&self.features, Targets::new(&self.channels, &self.targets))
            .with_groups(self.groups.as_deref())
    }
}

fn whole(count: u64) -> Result<usize, Failure> {
    usize::try_from(count).map_err(|_| too_many(count))
}

fn times(count: usize, each: usize) -> Result<usize, Failure> {
    count.checked_mul(each).ok_or_else(|| too_many(count))
}

fn too_many(count: impl std::fmt::Display) -> Failure {
    Failure::argument(format!("{count} numbers exceed the address space"))
}
