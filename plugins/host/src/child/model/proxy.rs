//! Host-side proxy of a model in a child.

use std::os::fd::{AsFd, BorrowedFd};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use taceva_core::{
    Channels, DriverKey, ErrorKind, FeatureShape, Features, ModelError, Progress, Regressor,
    not_finite,
};

use crate::child::array::{get, memory, put};
use crate::child::memory::SharedMemory;
use crate::child::plain::plain;
use crate::child::socket::{Caller, LinkError, Socket, send_now};
use crate::child::start::Child;
use crate::child::wire::{Failure, ModelAnswer, ModelCall, ModelEvent, ModelWord};
use crate::library::Level;
use crate::session::SavedRegressor;

/// Interval at which a fit is checked for cancellation.
const ASKED_EVERY: Timespec = Timespec {
    tv_sec: 0,
    tv_nsec: 50_000_000,
};

/// Time in which a fit must end after it was cancelled.
const ENDS_WITHIN: Duration = Duration::from_secs(5);

/// Time without progress after which a fit is reported as silent.
const SILENCE: Duration = Duration::from_secs(10);

/// Time since the last progress of a fit. A long pause is reported once.
struct Silence {
    since: Instant,
    is_reported: bool,
}

impl Silence {
    /// True at the first call after [`SILENCE`] without progress.
    fn is_new(&mut self, now: Instant) -> bool {
        let is_long = now.duration_since(self.since) >= SILENCE;
        is_long && !std::mem::replace(&mut self.is_reported, is_long)
    }
}

/// Maximum size of a saved model, bytes.
const SAVED_MAX: u64 = 1 << 30;

/// Fitted model in a child.
pub(crate) struct ModelProxy {
    child: Arc<Child>,
    estimator: DriverKey,
    calls: Mutex<Caller>,
    channels: Channels,
    shape: FeatureShape,
}

impl ModelProxy {
    /// Waits until the child has made the model. `talk` is the socket to the thread of the model in the child.
    pub(crate) fn when_made(
        child: Arc<Child>,
        estimator: DriverKey,
        talk: Socket,
        channels: Channels,
        shape: FeatureShape,
        progress: &dyn Progress,
    ) -> Result<ModelProxy, ModelError> {
        let mut talk = talk;
        let mut is_cancelled = None;
        let mut silence = Silence {
            since: Instant::now(),
            is_reported: false,
        };
        let failed = |failure: Failure| of_failure(&estimator, &failure);
        loop {
            if is_cancelled.is_none() && progress.is_cancelled() {
                // If the send fails, the child is gone or will time out.
                let _ = send_now(talk.as_fd(), &ModelWord::Cancel {});
                let life = child.life();
                let after = life.patience.open.min(ENDS_WITHIN);
                is_cancelled = Some(life.watch.begin("end a fit", after));
                let line = format!(
                    "stopping the fit of {estimator}; its process is killed if it takes longer than {after:?}"
                );
                child.tell(Level::Warn, &line);
            }
            if is_cancelled.is_none() && silence.is_new(Instant::now()) {
                let line = format!(
                    "the fit of {estimator} has reported no progress for {SILENCE:?}; Ctrl-C stops it"
                );
                child.tell(Level::Warn, &line);
            }
            let mut polled = [PollFd::new(&talk, PollFlags::IN)];
            // An interrupted poll is ignored.
            if !matches!(poll(&mut polled, Some(&ASKED_EVERY)), Ok(1..)) {
                continue;
            }
            let event = talk.receive::<ModelEvent>();
            let ended = match event {
                Ok(ModelEvent::Begins { stage, steps }) => {
                    progress.begin(&plain(&stage), steps);
                    continue;
                }
                Ok(ModelEvent::Advances { steps }) => {
                    silence.since = Instant::now();
                    progress.advance(steps);
                    continue;
                }
                Ok(ModelEvent::Ends {}) => {
                    progress.end();
                    continue;
                }
                Ok(ModelEvent::Made {}) => Ok(()),
                Ok(ModelEvent::Failed { failure }) => Err(failed(failure)),
                Err(error) => Err(of_link(&child, &estimator, error)),
            };
            if let Some(call) = is_cancelled {
                child.life().watch.end(call);
            }
            ended?;
            return Ok(ModelProxy {
                child,
                estimator,
                calls: Mutex::new(Caller::from(talk)),
                channels,
                shape,
            });
        }
    }

    fn ask(
        &self,
        call: &ModelCall,
        files: &[BorrowedFd<'_>],
        doing: &str,
        after: Duration,
    ) -> Result<ModelAnswer, ModelError> {
        let mut calls = self.calls.lock().unwrap_or_else(PoisonError::into_inner);
        let watch = &self.child.life().watch;
        let id = watch.begin(doing, after);
        let answer = calls.ask(call, files);
        watch.end(id);
        match answer {
            Ok(ModelAnswer::Failed { failure }) => Err(of_failure(&self.estimator, &failure)),
            Ok(answer) => Ok(answer),
            Err(error) => Err(of_link(&self.child, &self.estimator, error)),
        }
    }

    fn other_answer(&self) -> ModelError {
        let error = LinkError::Breach("an answer to another call".to_owned());
        of_link(&self.child, &self.estimator, error)
    }

    fn failed(&self, kind: ErrorKind, doing: &str, why: &str) -> ModelError {
        of_failure(&self.estimator, &Failure::new(kind, doing, why))
    }
}

impl Regressor for ModelProxy {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        const DOING: &str = "predict";
        let samples = features.samples();
        if features.shape() != self.shape || into.len() != samples * self.channels.len() {
            let why = format!(
                "{samples} samples of {} and a buffer of {} numbers, expected samples of {} and {} numbers for each",
                features.shape(),
                into.len(),
                self.shape,
                self.channels.len()
            );
            return Err(self.failed(ErrorKind::InvalidArgument, DOING, &why));
        }
        let bytes = (size_of_val(features.values())).max(size_of_val(into));
        let mut memory =
            memory(Some(bytes)).map_err(|failure| of_failure(&self.estimator, &failure))?;
        put(features.values(), memory.bytes_mut());
        let samples = samples as u64;
        // One millisecond per sample, added to the usual timeout of a call.
        let after = self.child.life().patience.open + Duration::from_millis(samples);
        let call = ModelCall::Predict { samples };
        match self.ask(&call, &[memory.file()], DOING, after)? {
            ModelAnswer::Done {} => {}
            _ => return Err(self.other_answer()),
        }
        // Copy before checking: the other process can still write there.
        let mut copy = vec![0; size_of_val(into)];
        memory.copy_to(&mut copy);
        let (predictions, _) = get::<f64>(into.len(), &copy).unwrap_or_default();
        into.copy_from_slice(&predictions);
        match not_finite(&self.channels, into) {
            None => Ok(()),
            Some(why) => Err(self.failed(ErrorKind::DeviceFault, DOING, &why)),
        }
    }
}

impl SavedRegressor for ModelProxy {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        const DOING: &str = "save";
        let patience = self.child.life().patience.open;
        let length = match self.ask(&ModelCall::Save {}, &[], DOING, patience)? {
            ModelAnswer::Saved { length } if length <= SAVED_MAX => length,
            ModelAnswer::Saved { length } => {
                let why = format!("{length} bytes, expected at most {SAVED_MAX}");
                return Err(self.failed(ErrorKind::OutOfRange, DOING, &why));
            }
            _ => return Err(self.other_answer()),
        };
        let mut bytes = vec![0; usize::try_from(length).unwrap_or(0)];
        let memory: SharedMemory =
            memory(Some(bytes.len())).map_err(|failure| of_failure(&self.estimator, &failure))?;
        match self.ask(&ModelCall::Fetch {}, &[memory.file()], DOING, patience)? {
            ModelAnswer::Done {} => memory.copy_to(&mut bytes),
            _ => return Err(self.other_answer()),
        }
        Ok(bytes)
    }
}

impl Drop for ModelProxy {
    fn drop(&mut self) {
        let calls = self.calls.get_mut().unwrap_or_else(PoisonError::into_inner);
        // The child sends no answer. It drops the model on this message, or when the socket closes.
        let _ = send_now(calls.as_fd(), &(0_u32, ModelCall::Close {}));
    }
}

/// Converts a failure into the error of the estimator, with the text that it would have without a child process.
pub(crate) fn of_failure(estimator: &DriverKey, failure: &Failure) -> ModelError {
    let why = match &failure.cause {
        // The message already names the estimator.
        Some(cause) if cause.starts_with(estimator.as_str()) => plain(cause),
        Some(cause) => format!(
            "{estimator}: cannot {}: {}",
            plain(&failure.doing),
            plain(cause)
        ),
        None => format!("{estimator}: cannot {}", plain(&failure.doing)),
    };
    ModelError::new(failure.kind, why)
}

/// Converts a link error of a child that did not answer.
pub(crate) fn of_link(child: &Child, estimator: &DriverKey, error: LinkError) -> ModelError {
    let error = child.life().lost(error);
    ModelError::new(error.kind(), format!("{estimator}: {error}")).because(error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_without_progress_is_reported_once() {
        let since = Instant::now();
        let mut silence = Silence {
            since,
            is_reported: false,
        };
        let after = [0, 9, 10, 11, 99].map(|s| silence.is_new(since + Duration::from_secs(s)));
        assert_eq!(after, [false, false, true, false, false]);
    }
}
