//! A Python device object. One thread at a time calls it, and dropping closes it.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use taceva_core::{ArgKind, ArgSpec, ArgValue, Args, DriverError, DriverKey, Interrupt};
use taceva_plugin::{HaltLatch, Interruption};

use super::failure::{Doing, device_error, short_words, words};
use super::waiting::{Deadline, Ends};

/// A Python device.
pub(super) struct Object {
    key: DriverKey,
    object: Py<PyAny>,
    interruption: Arc<Interruption>,
}

impl Object {
    pub(super) fn new(key: DriverKey, object: Py<PyAny>) -> Object {
        Object {
            key,
            object,
            interruption: Arc::default(),
        }
    }

    pub(super) fn key(&self) -> &DriverKey {
        &self.key
    }

    /// Calls `work` with the object and `deadline`. A Python exception becomes a device error for the operation `doing`.
    pub(super) fn call<T>(
        &self,
        doing: &'static str,
        deadline: taceva_core::Deadline,
        work: impl FnOnce(&Bound<'_, PyAny>, Bound<'_, Deadline>) -> PyResult<T>,
    ) -> Result<T, DriverError> {
        // Held until Python has returned, so that an interrupt affects only this call.
        let _call = self.interruption.call();
        let ends = Ends::Interrupt(Arc::clone(&self.interruption));
        self.called(doing, Deadline::new(deadline, ends), work)
    }

    /// Calls `work` like [`call`](Object::call), for a motion: a halt ends its wait in `rest` of the deadline.
    pub(super) fn call_until_halted<T>(
        &self,
        doing: &'static str,
        deadline: taceva_core::Deadline,
        latch: &Arc<HaltLatch>,
        work: impl FnOnce(&Bound<'_, PyAny>, Bound<'_, Deadline>) -> PyResult<T>,
    ) -> Result<T, DriverError> {
        let ends = Ends::Halt(Arc::clone(latch));
        self.called(doing, Deadline::new(deadline, ends), work)
    }

    fn called<T>(
        &self,
        doing: &'static str,
        deadline: Deadline,
        work: impl FnOnce(&Bound<'_, PyAny>, Bound<'_, Deadline>) -> PyResult<T>,
    ) -> Result<T, DriverError> {
        Python::attach(|py| {
            let done =
                Bound::new(py, deadline).and_then(|deadline| work(self.object.bind(py), deadline));
            done.map_err(|error| device_error(py, &error, &self.key, Doing::Working(doing)))
        })
    }

    /// Calls a method with a deadline.
    pub(super) fn method(
        &self,
        name: &str,
        doing: &'static str,
        deadline: taceva_core::Deadline,
    ) -> Result<(), DriverError> {
        self.call(doing, deadline, |object, deadline| {
            object.call_method1(name, (deadline,)).map(drop)
        })
    }

    /// Calls a method without arguments.
    pub(super) fn plain_method(&self, name: &str, doing: &'static str) -> Result<(), DriverError> {
        Python::attach(|py| {
            let called = self.object.call_method0(py, name).map(drop);
            called.map_err(|error| device_error(py, &error, &self.key, Doing::Working(doing)))
        })
    }

    /// Handle that interrupts a call while it waits in `rest` of its deadline.
    pub(super) fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interruption.handle()
    }

    /// Handle that calls `halt` of the object from any thread.
    pub(super) fn stopper(&self) -> Stopper {
        Stopper {
            key: self.key.clone(),
            object: Python::attach(|py| self.object.clone_ref(py)),
        }
    }

    /// True if the object has a method called `name`.
    pub(super) fn has(&self, name: &str) -> bool {
        Python::attach(|py| self.object.bind(py).hasattr(name).unwrap_or(false))
    }
}

/// Stops the motion of an object while another thread may be calling it.
pub(super) struct Stopper {
    key: DriverKey,
    object: Py<PyAny>,
}

impl Stopper {
    pub(super) fn key(&self) -> &DriverKey {
        &self.key
    }

    /// Calls `halt`; the error is the text of the exception.
    pub(super) fn stop(&self) -> Result<(), String> {
        Python::attach(|py| {
            let halted = self.object.call_method0(py, "halt").map(drop);
            halted.map_err(|error| short_words(py, &error))
        })
    }
}

impl Drop for Object {
    fn drop(&mut self) {
        Python::attach(|py| {
            if let Err(error) = self.object.call_method0(py, "close") {
                let words = words(py, &error);
                let line = format!("{}: cannot close: {words}", self.key);
                taceva_plugin::log(taceva_plugin::Level::Warn, &line);
            }
        });
    }
}

/// Arguments of a device as keyword arguments for Python.
pub(super) fn keywords<'py>(
    py: Python<'py>,
    specs: &[ArgSpec],
    args: &Args,
) -> PyResult<Bound<'py, PyDict>> {
    let given = PyDict::new(py);
    for spec in specs {
        match args.get(&spec.key) {
            Some(ArgValue::Whole(value)) => given.set_item(&spec.key, *value)?,
            Some(ArgValue::Number(value)) => given.set_item(&spec.key, *value)?,
            Some(ArgValue::Flag(value)) => given.set_item(&spec.key, *value)?,
            Some(ArgValue::Text(text)) if spec.kind == ArgKind::Path => {
                let path = py.import("pathlib")?.getattr("Path")?.call1((text,))?;
                given.set_item(&spec.key, path)?;
            }
            Some(value) => given.set_item(&spec.key, value.to_string())?,
            // The default value of Python applies.
            None => {}
        }
    }
    Ok(given)
}
