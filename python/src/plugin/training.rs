//! Progress and cancellation of a fit in Python.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

use pyo3::prelude::*;
use taceva_core::{ErrorKind, ModelError, Progress};

use super::waiting::Interrupted;

/// Interval at which a fit checks for cancellation.
const ASKED_EVERY: Duration = Duration::from_millis(20);

/// Stack size of the thread in bytes, as in C programs. For linear systems, numpy needs more than the 2 MiB of Rust.
const STACK: usize = 8 << 20;

/// Progress event of a fit: a stage begins, advances by steps, or ends.
enum Event {
    Begins(String, Option<u64>),
    Advances(u64),
    Ends,
}

/// Progress and cancellation of a fit, for Python.
#[pyclass(module = "taceva._taceva", frozen)]
pub(crate) struct Training {
    to: std::sync::Mutex<Sender<Event>>,
    is_cancelled: Arc<AtomicBool>,
}

impl Training {
    fn send(&self, event: Event) -> PyResult<()> {
        let to = self
            .to
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        // The receiver is gone if the fit was abandoned.
        let _ = to.send(event);
        drop(to);
        match self.is_cancelled() {
            true => Err(Interrupted::new_err("the fit was cancelled")),
            false => Ok(()),
        }
    }
}

#[pymethods]
impl Training {
    /// Begins a stage of `steps` steps, or of unknown length.
    #[pyo3(signature = (stage, steps = None))]
    fn begin(&self, stage: String, steps: Option<u64>) -> PyResult<()> {
        self.send(Event::Begins(stage, steps))
    }

    /// Counts `steps` finished steps; raises `Interrupted` if the fit was cancelled.
    #[pyo3(signature = (steps = 1))]
    fn advance(&self, steps: u64) -> PyResult<()> {
        self.send(Event::Advances(steps))
    }

    /// Ends the stage.
    fn end(&self) -> PyResult<()> {
        self.send(Event::Ends)
    }

    /// True if the fit was cancelled.
    fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Acquire)
    }
}

/// Runs `fit` on its own thread. This thread forwards its events to `progress`, which no other thread may call.
pub(super) fn watched<T: Send>(
    progress: &dyn Progress,
    fit: impl FnOnce(Training) -> T + Send,
) -> Result<T, ModelError> {
    let (to, events) = channel();
    let is_cancelled = Arc::new(AtomicBool::new(false));
    let training = Training {
        to: std::sync::Mutex::new(to),
        is_cancelled: Arc::clone(&is_cancelled),
    };
    std::thread::scope(|scope| {
        let (done, is_done) = channel::<()>();
        let fitting = std::thread::Builder::new().stack_size(STACK);
        let fitting = fitting.spawn_scoped(scope, move || {
            // Dropped at the end, also after a panic.
            let _done = done;
            fit(training)
        });
        let fitting =
            fitting.map_err(|error| ModelError::new(ErrorKind::Internal, error.to_string()))?;
        pass_on(&events, &is_done, progress, &is_cancelled);
        let fitted = fitting.join();
        fitted.map_err(|_| ModelError::new(ErrorKind::Panicked, "its thread panicked"))
    })
}

fn pass_on(
    events: &Receiver<Event>,
    is_done: &Receiver<()>,
    progress: &dyn Progress,
    is_cancelled: &AtomicBool,
) {
    loop {
        if progress.is_cancelled() {
            is_cancelled.store(true, Ordering::Release);
        }
        match events.recv_timeout(ASKED_EVERY) {
            Ok(Event::Begins(stage, steps)) => progress.begin(&stage, steps),
            Ok(Event::Advances(steps)) => progress.advance(steps),
            Ok(Event::Ends) => progress.end(),
            Err(RecvTimeoutError::Disconnected) => return,
            // Python may still hold the object, but the fit has ended.
            Err(RecvTimeoutError::Timeout) => {
                if is_done.try_recv() == Err(std::sync::mpsc::TryRecvError::Disconnected) {
                    return;
                }
            }
        }
    }
}
