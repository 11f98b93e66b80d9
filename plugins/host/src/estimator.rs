//! Estimators of a library that runs in this process.

#![expect(
    unsafe_code,
    reason = "models are fitted and asked through the plugin's functions"
)]

use std::ffi::c_void;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use taceva_abi as abi;
use taceva_core::{
    Channels, DriverKey, ErrorKind, FeatureShape, Features, ModelError, Progress, Regressor,
    TrainingSet,
};

use crate::call::{ArgList, Failure, call, table};
use crate::library::{Entry, Library};
use crate::session::{FitRequest, Saved, SavedRegressor};

/// A kept model has at most this many bytes.
const MODEL_MAX: u64 = 1 << 30;

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
    request.progress.begin(&format!("fit {key}"), Some(STEPS));
    let training_set = training.set();
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
    let model = Model::new(library, (key, regressor), (channels, shape)).map_err(failed)?;
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
    call(|error| {
        let (bytes, length) = (saved.bytes.as_ptr(), saved.bytes.len() as u64);
        // SAFETY: [any], with bytes, a place for the model and an error that outlive the call.
        unsafe { load(entry.number, bytes, length, &raw mut regressor, error) }
    })
    .map_err(failed)?;
    let (channels, shape) = (saved.channels.clone(), saved.shape);
    let model = Model::new(library, (key, regressor), (channels, shape)).map_err(failed)?;
    Ok(Box::new(model))
}

/// The failure of an estimator that `library` does not have.
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

/// A set in the interface's form, with the texts it points to.
struct Lent<'a> {
    set: &'a TrainingSet<'a>,
    names: Vec<abi::Text>,
    sides: [u32; 3],
    channels: u32,
}

impl<'a> Lent<'a> {
    fn new(set: &'a TrainingSet<'a>) -> Result<Lent<'a>, Failure> {
        let refused = |why: String| Failure::new(ErrorKind::InvalidArgument, why);
        let shape = set.features.shape();
        let samples = set.features.samples();
        let channels = set.targets.channels.len();
        let fits = set.targets.values.len() == samples * channels
            && set.groups.is_none_or(|groups| groups.len() == samples);
        if !fits {
            let why = format!(
                "{samples} samples of {channels} channels, with {} targets",
                set.targets.values.len()
            );
            return Err(refused(why));
        }
        let is_finite = set.features.values().iter().all(|value| value.is_finite())
            && set.targets.values.iter().all(|value| value.is_finite());
        if !is_finite {
            return Err(refused("a feature or a target is not finite".to_owned()));
        }
        let narrow = |side: usize| {
            u32::try_from(side).map_err(|_| refused(format!("a side of {side} features")))
        };
        Ok(Lent {
            set,
            names: (set.targets.channels.iter())
                .map(|channel| abi::Text::from(channel.name()))
                .collect(),
            sides: [
                narrow(shape.height)?,
                narrow(shape.width)?,
                narrow(shape.depth)?,
            ],
            channels: narrow(channels)?,
        })
    }

    fn set(&self) -> abi::TrainingSet {
        let [height, width, depth] = self.sides;
        abi::TrainingSet {
            size: u32::try_from(size_of::<abi::TrainingSet>()).expect("a small struct"),
            channels: self.channels,
            samples: self.set.features.samples() as u64,
            height,
            width,
            depth,
            reserved: 0,
            features: self.set.features.values().as_ptr(),
            targets: self.set.targets.values.as_ptr(),
            groups: self.set.groups.map_or(std::ptr::null(), <[u32]>::as_ptr),
            channel_names: self.names.as_ptr(),
        }
    }
}

/// Steps of a fit, as whoever listens counts them.
const STEPS: u64 = 1_000;

struct Listener<'a> {
    progress: &'a dyn Progress,
    reported: u64,
}

unsafe extern "C" fn progress(context: *mut c_void, done: f64) -> i32 {
    // SAFETY: `context` is the listener that `fit` handed over for the call that is under way.
    let listener = unsafe { &mut *context.cast::<Listener<'_>>() };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "clamped to the number of steps; NaN becomes 0"
    )]
    let reached = (done.clamp(0.0, 1.0) * STEPS as f64) as u64;
    let reported = listener.reported;
    listener.reported = reported.max(reached);
    let progress = listener.progress;
    // A panic of whoever listens must not cross the line: it ends the fit.
    let cancelled = catch_unwind(AssertUnwindSafe(|| {
        if reached > reported {
            progress.advance(reached - reported);
        }
        progress.is_cancelled()
    }));
    i32::from(cancelled.unwrap_or(true))
}

/// A fitted model of a plugin.
struct Model {
    handle: *mut c_void,
    calls: abi::RegressorCalls,
    key: DriverKey,
    channels: Channels,
    shape: FeatureShape,
    /// After the handle: its functions live there.
    _library: Arc<Library>,
}

// SAFETY: the interface allows `predict` and `save` from any thread ([any & open]), and `close` is called once, by the owner.
unsafe impl Send for Model {}
// SAFETY: as above.
unsafe impl Sync for Model {}

impl Model {
    fn new(
        library: &Arc<Library>,
        (key, regressor): (&DriverKey, abi::Regressor),
        (channels, shape): (Channels, FeatureShape),
    ) -> Result<Model, Failure> {
        // SAFETY: after a success the interface promises this table.
        let calls = unsafe { table::<abi::RegressorCalls>(regressor.calls.cast()) }?;
        if regressor.handle.is_null() {
            let why = "it was fitted, yet its handle is NULL";
            return Err(Failure::new(ErrorKind::Abi, why));
        }
        let model = Model {
            handle: regressor.handle,
            calls,
            key: key.clone(),
            channels,
            shape,
            _library: Arc::clone(library),
        };
        match (calls.predict, calls.close) {
            (Some(_), Some(_)) => Ok(model),
            (None, _) => Err(lacks("predict")),
            (_, None) => Err(lacks("close")),
        }
    }

    fn failed(&self, doing: &'static str, failure: Failure) -> ModelError {
        model_error(&self.key, doing, failure)
    }
}

impl Drop for Model {
    fn drop(&mut self) {
        if let Some(close) = self.calls.close {
            // SAFETY: [owner & open], the last call.
            unsafe { close(self.handle) };
        }
    }
}

impl Regressor for Model {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        const DOING: &str = "predict";
        let refused = |kind, why: String| self.failed(DOING, Failure::new(kind, why));
        let samples = features.samples();
        if features.shape() != self.shape || into.len() != samples * self.channels.len() {
            let why = format!(
                "{samples} samples of {:?} into {} numbers, expected samples of {:?} and {} numbers each",
                features.shape(),
                into.len(),
                self.shape,
                self.channels.len()
            );
            return Err(refused(ErrorKind::InvalidArgument, why));
        }
        let predict = self.calls.predict;
        let predict = predict.ok_or_else(|| self.failed(DOING, lacks("predict")))?;
        // What a plugin leaves out is no prediction.
        into.fill(f64::NAN);
        call(|error| {
            let values = features.values();
            // SAFETY: [any & open], with features and a place of the lengths that are said, and an error that outlive the call.
            unsafe {
                predict(
                    self.handle,
                    values.as_ptr(),
                    values.len() as u64,
                    samples as u64,
                    into.as_mut_ptr(),
                    into.len() as u64,
                    error,
                )
            }
        })
        .map_err(|failure| self.failed(DOING, failure))?;
        match into.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(place) => {
                let sample = place / self.channels.len().max(1);
                let why = format!("sample {sample}: {}, expected a number", into[place]);
                Err(refused(ErrorKind::DeviceFault, why))
            }
        }
    }
}

impl SavedRegressor for Model {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        const DOING: &str = "save";
        let refused = |kind, why: String| self.failed(DOING, Failure::new(kind, why));
        let save = self.calls.save;
        let save = save.ok_or_else(|| self.failed(DOING, lacks("save")))?;
        let mut length = 0_u64;
        // SAFETY: [any & open]; without a place nothing is written but the length.
        let asked = call(|error| unsafe {
            save(self.handle, std::ptr::null_mut(), &raw mut length, error)
        });
        match asked {
            Ok(()) if length == 0 => return Ok(Vec::new()),
            Err(failure) if failure.kind() == ErrorKind::OutOfRange => {}
            Ok(()) => {
                let why = format!("it wrote {length} bytes nowhere");
                return Err(refused(ErrorKind::Abi, why));
            }
            Err(failure) => return Err(self.failed(DOING, failure)),
        }
        let room = usize::try_from(length)
            .ok()
            .filter(|_| length <= MODEL_MAX)
            .ok_or_else(|| {
                let why = format!("a model of {length} bytes, expected at most {MODEL_MAX}");
                refused(ErrorKind::OutOfRange, why)
            })?;
        let mut bytes = vec![0; room];
        call(|error| {
            // SAFETY: [any & open], with a place for `length` bytes and an error that outlive the call.
            unsafe { save(self.handle, bytes.as_mut_ptr(), &raw mut length, error) }
        })
        .map_err(|failure| self.failed(DOING, failure))?;
        match usize::try_from(length)
            .ok()
            .filter(|length| *length <= room)
        {
            Some(length) => {
                bytes.truncate(length);
                Ok(bytes)
            }
            None => {
                let why = format!("it says it wrote {length} bytes into {room}");
                Err(refused(ErrorKind::Abi, why))
            }
        }
    }
}
