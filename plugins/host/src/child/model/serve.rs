//! Models in a child. A separate thread makes each model, then answers calls to it.

use std::os::fd::{AsFd, OwnedFd};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use taceva_core::{Args, ErrorKind, Features, ModelError, Progress};

use crate::child::arguments::arguments;
use crate::child::array::{OwnedSet, get, put};
use crate::child::memory::SharedMemory;
use crate::child::socket::{LinkError, Socket, send_now, try_receive};
use crate::child::thread::{guarded, start};
use crate::child::wire::{Failure, ModelAnswer, ModelCall, ModelEvent, ModelOrder, ModelWord};
use crate::session::{FitRequest, Saved, SavedRegressor, Session};

/// Makes a model and serves it on its own thread.
pub(in crate::child) fn serve(
    session: Arc<dyn Session>,
    order: ModelOrder,
    files: Vec<OwnedFd>,
) -> Result<(), Failure> {
    let mut files = files.into_iter();
    let talk = files.next().ok_or_else(|| broken("no socket was sent"))?;
    let memories = files
        .map(|file| SharedMemory::attach(file).map_err(|error| broken(&error.to_string())))
        .collect::<Result<Vec<_>, _>>()?;
    start("taceva-model", move || {
        let mut talk = Socket::from(talk);
        let listener = Listener::new(&talk);
        let made = guarded("fit", || make(&*session, order, memories, &listener));
        match made.and_then(|made| made) {
            Ok(model) if talk.send(&ModelEvent::Made {}, &[]).is_ok() => answer(talk, &*model),
            Ok(_) => {}
            Err(failure) => {
                // A send error means that the host is gone, and is ignored.
                let _ = talk.send(&ModelEvent::Failed { failure }, &[]);
            }
        }
    })
}

fn make(
    session: &dyn Session,
    order: ModelOrder,
    memories: Vec<SharedMemory>,
    progress: &dyn Progress,
) -> Result<Box<dyn SavedRegressor>, Failure> {
    let mut memories = memories.into_iter();
    let mut next = || memories.next().ok_or_else(|| broken("no memory was sent"));
    match order {
        ModelOrder::Fit {
            estimator,
            settings,
            training,
            validation,
        } => {
            let settings: Args = arguments(&settings)?;
            let training = OwnedSet::take(training, &mut next()?)?;
            let validation = match validation {
                Some(shape) => Some(OwnedSet::take(shape, &mut next()?)?),
                None => None,
            };
            let training = training.set();
            let validation = validation.as_ref().map(OwnedSet::set);
            let request = FitRequest::new(&settings, &training, progress)
                .with_validation(validation.as_ref());
            session
                .fit(&estimator, &request)
                .map_err(|error| failed("fit", &error))
        }
        ModelOrder::Load {
            estimator,
            channels,
            shape,
            length,
        } => {
            let mut memory = next()?;
            let length = usize::try_from(length)
                .map_err(|_| broken("the saved model exceeds the address space"))?;
            let bytes = memory.bytes_mut().get(..length);
            let saved = Saved::new(
                bytes.ok_or_else(|| broken("the saved model is shorter than its stated length"))?,
                &channels,
                shape,
            );
            session
                .load(&estimator, &saved)
                .map_err(|error| failed("load", &error))
        }
    }
}

/// Answers calls to a model until the host closes it or is gone.
fn answer(mut talk: Socket, model: &dyn SavedRegressor) {
    let mut saved = Vec::new();
    while let Ok(((sequence, call), files)) = talk.receive_with_files::<(u32, ModelCall)>() {
        if call == (ModelCall::Close {}) {
            return;
        }
        let answer = guarded("answer", || one_answer(model, call, files, &mut saved));
        let answer = answer.and_then(|answer| answer);
        let answer = answer.unwrap_or_else(|failure| ModelAnswer::Failed { failure });
        if talk.send(&(sequence, answer), &[]).is_err() {
            return;
        }
    }
}

fn one_answer(
    model: &dyn SavedRegressor,
    call: ModelCall,
    files: Vec<OwnedFd>,
    saved: &mut Vec<u8>,
) -> Result<ModelAnswer, Failure> {
    let memory = files.into_iter().next().map(SharedMemory::attach);
    let memory = || match memory {
        Some(Ok(memory)) => Ok(memory),
        Some(Err(error)) => Err(broken(&error.to_string())),
        None => Err(broken("no memory was sent")),
    };
    match call {
        ModelCall::Predict { samples } => {
            let mut memory = memory()?;
            predict(model, samples, &mut memory)?;
            Ok(ModelAnswer::Done {})
        }
        ModelCall::Save {} => {
            *saved = model.save().map_err(|error| failed("save", &error))?;
            let length = saved.len() as u64;
            Ok(ModelAnswer::Saved { length })
        }
        ModelCall::Fetch {} => {
            let mut memory = memory()?;
            let place = memory.bytes_mut().get_mut(..saved.len());
            place
                .ok_or_else(|| broken("the shared memory is too small"))?
                .copy_from_slice(saved);
            Ok(ModelAnswer::Done {})
        }
        ModelCall::Close {} => Err(broken("a close request that expects an answer")),
    }
}

/// Reads the features from the front of `memory` and overwrites them with the predictions.
fn predict(
    model: &dyn SavedRegressor,
    samples: u64,
    memory: &mut SharedMemory,
) -> Result<(), Failure> {
    let refused = || broken("the shared memory is smaller than its samples");
    let samples = usize::try_from(samples).map_err(|_| refused())?;
    let length = samples.checked_mul(model.shape().len());
    let (values, _) = length
        .and_then(|length| get::<f32>(length, memory.bytes_mut()))
        .ok_or_else(refused)?;
    let features = Features::new(model.shape(), values).map_err(|_| refused())?;
    let count = samples.checked_mul(model.channels().len());
    let fits = |count: &usize| {
        count
            .checked_mul(size_of::<f64>())
            .is_some_and(|bytes| bytes <= memory.length())
    };
    let mut predictions = vec![0.0; count.filter(fits).ok_or_else(refused)?];
    model
        .predict(&features, &mut predictions)
        .map_err(|error| failed("predict", &error))?;
    put(&predictions, memory.bytes_mut());
    Ok(())
}

/// Reports the progress of a fit to the host and receives its cancellation.
struct Listener {
    bell: Option<OwnedFd>,
    heard: Mutex<()>,
    is_cancelled: AtomicBool,
}

impl Listener {
    fn new(talk: &Socket) -> Listener {
        Listener {
            bell: talk.as_fd().try_clone_to_owned().ok(),
            heard: Mutex::new(()),
            is_cancelled: AtomicBool::new(false),
        }
    }

    fn tell(&self, event: &ModelEvent) {
        // Progress reports are dropped while the socket is full.
        if let Some(bell) = &self.bell {
            let _ = send_now(bell.as_fd(), event);
        }
    }
}

impl Progress for Listener {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        let stage = stage.to_owned();
        self.tell(&ModelEvent::Begins { stage, steps });
    }

    fn advance(&self, steps: u64) {
        self.tell(&ModelEvent::Advances { steps });
    }

    fn end(&self) {
        self.tell(&ModelEvent::Ends {});
    }

    fn is_cancelled(&self) -> bool {
        // Only one thread receives at a time, so this thread also records the cancellation.
        let _heard = self.heard.lock().unwrap_or_else(PoisonError::into_inner);
        if !self.is_cancelled.load(Ordering::Acquire)
            && let Some(bell) = &self.bell
        {
            let is_cancelled = match try_receive::<ModelWord>(bell.as_fd()) {
                Ok(None) => false,
                // The fit is cancelled if the host is gone.
                Ok(Some(ModelWord::Cancel {})) | Err(LinkError::Closed) => true,
                Err(_) => false,
            };
            self.is_cancelled.store(is_cancelled, Ordering::Release);
        }
        self.is_cancelled.load(Ordering::Acquire)
    }
}

fn failed(doing: &str, error: &ModelError) -> Failure {
    Failure::new(error.kind(), doing, &error.to_string())
}

fn broken(why: &str) -> Failure {
    Failure::new(ErrorKind::Protocol, "make a model", why)
}
