//! Fitted model of a library in this process.

#![expect(
    unsafe_code,
    reason = "models are called through the plugin's functions"
)]

use std::ffi::c_void;
use std::sync::Arc;

use taceva_abi as abi;
use taceva_core::{
    Channels, DriverKey, ErrorKind, FeatureShape, Features, ModelError, Regressor, not_finite,
};

use super::{lacks, model_error};
use crate::call::{Failure, call, pending_call, table};
use crate::library::Library;
use crate::session::SavedRegressor;

/// Maximum size of a saved model, bytes.
const MODEL_MAX: u64 = 1 << 30;

/// Fitted model of a plugin.
pub(super) struct Model {
    handle: *mut c_void,
    calls: abi::RegressorCalls,
    key: DriverKey,
    channels: Channels,
    shape: FeatureShape,
    /// Dropped after the handle, because the library contains its functions.
    _library: Arc<Library>,
}

// SAFETY: the interface allows `predict` and `save` from any thread ([any & open]), and the owner calls `close` once.
unsafe impl Send for Model {}
// SAFETY: as above.
unsafe impl Sync for Model {}

impl Model {
    pub(super) fn new(
        library: &Arc<Library>,
        key: &DriverKey,
        regressor: abi::Regressor,
        channels: Channels,
        shape: FeatureShape,
    ) -> Result<Model, Failure> {
        // SAFETY: after a success, the interface specifies this table.
        let calls = unsafe { table::<abi::RegressorCalls>(regressor.calls.cast()) }?;
        if regressor.handle.is_null() {
            let why = "the fit succeeded, but its handle is NULL";
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
                "{samples} samples of {} and a buffer of {} numbers, expected samples of {} and {} numbers for each",
                features.shape(),
                into.len(),
                self.shape,
                self.channels.len()
            );
            return Err(refused(ErrorKind::InvalidArgument, why));
        }
        let predict = self.calls.predict;
        let predict = predict.ok_or_else(|| self.failed(DOING, lacks("predict")))?;
        // Entries that the plugin does not write stay NaN.
        into.fill(f64::NAN);
        let _under_way = pending_call::begin(DOING);
        call(|error| {
            let values = features.values();
            // SAFETY: [any & open], with features and a buffer of the stated lengths, and an error that outlive the call.
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
        let fault = not_finite(&self.channels, into);
        fault.map_or(Ok(()), |why| Err(refused(ErrorKind::DeviceFault, why)))
    }
}

impl SavedRegressor for Model {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        const DOING: &str = "save";
        let refused = |kind, why: String| self.failed(DOING, Failure::new(kind, why));
        let save = self.calls.save;
        let save = save.ok_or_else(|| self.failed(DOING, lacks("save")))?;
        let mut length = 0_u64;
        let _under_way = pending_call::begin(DOING);
        // SAFETY: [any & open]; without a buffer, only the length is written.
        let asked = call(|error| unsafe {
            save(self.handle, std::ptr::null_mut(), &raw mut length, error)
        });
        match asked {
            Ok(()) if length == 0 => return Ok(Vec::new()),
            Err(failure) if failure.kind() == ErrorKind::OutOfRange => {}
            Ok(()) => {
                let why = format!("it reports {length} bytes written without a buffer");
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
            // SAFETY: [any & open], with a buffer of `length` bytes and an error that outlive the call.
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
                let why = format!("it reports {length} bytes written into a buffer of {room}");
                Err(refused(ErrorKind::Abi, why))
            }
        }
    }
}
