//! Runs long work on its own thread, while the calling thread handles Ctrl-C and updates the progress bar.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use taceva_core::Progress;

use crate::errors::value_error;

/// Interval of signal checks and bar updates; Ctrl-C takes at most twice as long.
const PERIOD: Duration = Duration::from_millis(50);

/// Progress event of a stage: it begins, advances by steps, or ends.
enum Event {
    Begun(String, Option<u64>),
    Advanced(u64),
    Ended,
}

/// Progress of the work, written by its thread: records events, and checks for cancellation.
struct Noted<'a> {
    events: Mutex<Vec<Event>>,
    is_stopped: &'a AtomicBool,
}

impl Noted<'_> {
    fn note(&self, event: Event) {
        let mut events = self.events.lock().unwrap_or_else(PoisonError::into_inner);
        match (&event, events.last_mut()) {
            (Event::Advanced(more), Some(Event::Advanced(steps))) => *steps += more,
            _ => events.push(event),
        }
    }

    fn take(&self) -> Vec<Event> {
        std::mem::take(&mut *self.events.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Progress for Noted<'_> {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        self.note(Event::Begun(stage.to_owned(), steps));
    }

    fn advance(&self, steps: u64) {
        self.note(Event::Advanced(steps));
    }

    fn end(&self) {
        self.note(Event::Ended);
    }

    fn is_cancelled(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

/// Result of `work`, run without the interpreter lock. `bar` has `begin(stage, steps or None)`, `advance(steps)` and `end()`.
///
/// # Errors
/// Exceptions of a signal handler or the bar, such as `KeyboardInterrupt` at Ctrl-C. The work has been cancelled and has ended then.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    bar: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Progress) -> T + Send,
) -> PyResult<T> {
    let is_stopped = AtomicBool::new(false);
    let noted = Noted {
        events: Mutex::default(),
        is_stopped: &is_stopped,
    };
    thread::scope(|scope| {
        let (done, is_done) = channel();
        // Used by one thread at a time: this one, without the interpreter lock.
        let is_done = Mutex::new(is_done);
        let worker = {
            let noted = &noted;
            scope.spawn(move || {
                // Dropped even if the work panics.
                let _done: Sender<()> = done;
                work(noted)
            })
        };
        let mut raised = None;
        loop {
            let waited = py.detach(|| {
                let is_done = is_done.lock().unwrap_or_else(PoisonError::into_inner);
                is_done.recv_timeout(PERIOD)
            });
            let heard = py.check_signals().and_then(|()| show(bar, noted.take()));
            if let Err(error) = heard {
                is_stopped.store(true, Ordering::Relaxed);
                raised.get_or_insert(error);
            }
            if waited == Err(RecvTimeoutError::Disconnected) {
                break;
            }
        }
        let ended = py.detach(|| worker.join());
        match (raised, ended) {
            (Some(error), _) => Err(error),
            (None, Ok(result)) => Ok(result),
            (None, Err(_)) => Err(value_error("the work panicked: a bug of taceva")),
        }
    })
}

fn show(bar: Option<&Bound<'_, PyAny>>, events: Vec<Event>) -> PyResult<()> {
    let Some(bar) = bar else { return Ok(()) };
    for event in events {
        match event {
            Event::Begun(stage, steps) => bar.call_method1("begin", (stage, steps))?,
            Event::Advanced(steps) => bar.call_method1("advance", (steps,))?,
            Event::Ended => bar.call_method0("end")?,
        };
    }
    Ok(())
}
