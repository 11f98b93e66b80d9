//! Deadlines of calls for Python, with interruptible waits.

use std::sync::Arc;
use std::time::{Duration, Instant};

use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyTimeoutError};
use pyo3::prelude::*;
use taceva_plugin::{HaltLatch, Interruption};

use crate::errors::value_error;

create_exception!(taceva, Interrupted, PyException, "The call was cancelled.");

/// Time longer than any call, s.
const LONG_S: f64 = 1e9;

/// Signal that ends a wait early.
pub(super) enum Ends {
    /// An interrupt of the call that waits.
    Interrupt(Arc<Interruption>),
    /// A halt of the robot, before or during the call.
    Halt(Arc<HaltLatch>),
}

impl Ends {
    fn rest(&self, time: Duration) -> Result<(), &'static str> {
        match self {
            Ends::Interrupt(interruption) => interruption
                .call()
                .rest(time)
                .map_err(|_| "it was interrupted"),
            Ends::Halt(latch) => latch.rest(time).map_err(|_| "it was halted"),
        }
    }
}

/// Deadline of a call.
#[pyclass(module = "taceva._taceva", frozen)]
pub(crate) struct Deadline {
    end: Instant,
    ends: Ends,
}

impl Deadline {
    pub(super) fn new(deadline: taceva_core::Deadline, ends: Ends) -> Deadline {
        let longest = Duration::from_secs_f64(LONG_S);
        Deadline {
            end: Instant::now() + deadline.remaining().min(longest),
            ends,
        }
    }

    fn left(&self) -> Duration {
        self.end.saturating_duration_since(Instant::now())
    }
}

#[pymethods]
impl Deadline {
    /// Remaining time in s; 0 after the deadline.
    fn remaining(&self) -> f64 {
        self.left().as_secs_f64()
    }

    /// Waits for `seconds`. Raises `Interrupted` once the call is interrupted, and `TimeoutError` at the deadline.
    fn rest(&self, py: Python<'_>, seconds: f64) -> PyResult<()> {
        if seconds.is_nan() || seconds < 0.0 {
            return Err(value_error(format_args!(
                "rest: {seconds} seconds, expected 0 or more"
            )));
        }
        let asked = Duration::from_secs_f64(seconds.min(LONG_S));
        let left = self.left();
        let rested = py.detach(|| self.ends.rest(asked.min(left)));
        rested.map_err(Interrupted::new_err)?;
        if asked > left {
            return Err(PyTimeoutError::new_err("the deadline has passed"));
        }
        Ok(())
    }

    fn __repr__(&self) -> String {
        format!("<Deadline in {:.3} s>", self.remaining())
    }
}
