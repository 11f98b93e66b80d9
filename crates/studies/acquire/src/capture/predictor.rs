//! Thread that predicts the newest frame. Older frames are dropped and counted.

#[cfg(test)]
mod tests;

use std::sync::{Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use taceva_core::{DriverSource, Frame};
use taceva_drivers::MonotonicClock;
use taceva_models::Extractor;

use super::latencies::Latencies;
use super::live_model::LiveModel;
use super::prediction::Prediction;
use super::prediction_table::PredictionTable;
use crate::error::AcquireError;

/// Interval between checks for the end of the thread.
const LOOK: Duration = Duration::from_millis(50);

/// Counts of the frames that a predictor received.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct PredictionCounts {
    /// Number of frames received.
    pub seen: u64,
    /// Number of frames predicted.
    pub predicted: u64,
    /// Number of frames dropped because a newer frame arrived while the model was busy.
    pub dropped: u64,
    /// Number of predicted frames outside the training data; `None` if the model does not compute the distance.
    pub outside: Option<u64>,
    /// Latencies from the time stamp of each frame to its prediction. Empty if another clock stamps the frames.
    pub latencies: Latencies,
}

/// Callback that receives a prediction, its frame and the current counts.
type Heard<'a> = &'a (dyn Fn(&Frame, &Prediction, &PredictionCounts) + Sync);

/// Predicts frames on its own thread. It stores only the newest frame, and never blocks a capture.
pub struct LivePredictor<'a> {
    model: &'a LiveModel,
    heard: Heard<'a>,
    /// Feature extractor, created when the format of frames and any reference frame are known.
    extractor: OnceLock<Extractor>,
    offered: Mutex<Offered>,
    /// Notified when a frame arrives, when a frame is taken for prediction, and when the predictor ends.
    changed: Condvar,
    counts: Mutex<PredictionCounts>,
    table: Option<Mutex<PredictionTable>>,
    failure: OnceLock<String>,
}

/// Newest frame that waits for its prediction, and a flag that ends the thread.
#[derive(Default)]
struct Offered {
    newest: Option<Newest>,
    is_over: bool,
}

struct Newest {
    frame: Frame,
    stamp_s: f64,
    /// True if the time stamp is from the clock of this machine.
    is_timed: bool,
}

impl<'a> LivePredictor<'a> {
    /// Creates a predictor with `model`. Its thread calls `heard` with each prediction, the frame and the counts.
    pub fn new(
        model: &'a LiveModel,
        heard: &'a (dyn Fn(&Frame, &Prediction, &PredictionCounts) + Sync),
    ) -> LivePredictor<'a> {
        LivePredictor {
            model,
            heard,
            extractor: OnceLock::new(),
            offered: Mutex::default(),
            changed: Condvar::new(),
            counts: Mutex::new(PredictionCounts {
                outside: model.knows_distance().then_some(0),
                ..PredictionCounts::default()
            }),
            table: None,
            failure: OnceLock::new(),
        }
    }

    /// Enables a table of all predictions, to be written next to the recording.
    #[must_use]
    pub fn with_table(self) -> LivePredictor<'a> {
        let table = PredictionTable::new(self.model.channels());
        LivePredictor {
            table: Some(Mutex::new(table)),
            ..self
        }
    }

    /// Model of the predictor.
    pub fn model(&self) -> &LiveModel {
        self.model
    }

    /// Current counts of received, predicted and dropped frames.
    pub fn counts(&self) -> PredictionCounts {
        lock(&self.counts).clone()
    }

    /// Reason why predictions ended, if the model failed.
    pub fn failure(&self) -> Option<&str> {
        self.failure.get().map(String::as_str)
    }

    /// Stored predictions; `None` if no table was requested.
    pub(super) fn table(&self) -> Option<MutexGuard<'_, PredictionTable>> {
        self.table.as_ref().map(lock)
    }

    /// Prepares for frames of the format `info`. The frame `untouched` is the reference frame if the model needs a reference frame.
    pub(super) fn begin(
        &self,
        info: taceva_core::FrameInfo,
        untouched: Option<&Frame>,
    ) -> Result<(), AcquireError> {
        let extractor = self.model.extractor(info, untouched)?;
        // A second call keeps the first reference.
        drop(self.extractor.set(extractor));
        Ok(())
    }

    /// Passes `frame` with the time stamp `stamp_s`, in s, to the thread. A frame of a real device replaces a waiting frame. With a simulated or
    /// recorded source, this call waits until the earlier frame is predicted.
    pub(super) fn offer(&self, frame: &Frame, stamp_s: f64, source: DriverSource) {
        let is_timed = source == DriverSource::Real;
        let frame = frame.clone();
        let mut offered = lock(&self.offered);
        while !is_timed && offered.newest.is_some() && !offered.is_over {
            let waited = self.changed.wait_timeout(offered, LOOK);
            offered = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        if offered.is_over {
            return;
        }
        let older = offered.newest.replace(Newest {
            frame,
            stamp_s,
            is_timed,
        });
        drop(offered);
        self.changed.notify_all();
        let mut counts = lock(&self.counts);
        counts.seen += 1;
        counts.dropped += u64::from(older.is_some());
    }

    /// Predicts frames until [`end`](LivePredictor::end) is called.
    pub(super) fn run(&self) {
        let _over = Over(self);
        let Some(extractor) = self.extractor.get() else {
            return;
        };
        let mut features = vec![0.0; extractor.shape().len()];
        while let Some(newest) = self.next() {
            let predicted = self.predict(extractor, &newest, &mut features);
            match predicted {
                Ok(prediction) => self.take(&newest, prediction),
                Err(problem) => {
                    lock(&self.counts).dropped += 1;
                    // Keeps the first failure.
                    drop(self.failure.set(problem));
                    return;
                }
            }
        }
    }

    /// Ends the thread after the prediction of the waiting frame.
    pub(super) fn end(&self) {
        lock(&self.offered).is_over = true;
        self.changed.notify_all();
    }

    /// Waits for the newest frame; `None` at the end.
    fn next(&self) -> Option<Newest> {
        let mut offered = lock(&self.offered);
        loop {
            if let Some(newest) = offered.newest.take() {
                drop(offered);
                self.changed.notify_all();
                return Some(newest);
            }
            if offered.is_over {
                return None;
            }
            let waited = self.changed.wait_timeout(offered, LOOK);
            offered = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn predict(
        &self,
        extractor: &Extractor,
        newest: &Newest,
        features: &mut [f32],
    ) -> Result<Prediction, String> {
        let words = |error: &dyn std::fmt::Display| error.to_string();
        extractor
            .extract(&newest.frame, features)
            .map_err(|error| words(&error))?;
        let sample = taceva_core::Features::new(extractor.shape(), features.to_vec())
            .map_err(|error| words(&error))?;
        let model = self.model.model();
        let values = model.predict(&sample).map_err(|error| words(&error))?;
        let prediction = Prediction::new(newest.stamp_s, values);
        let distances = model.distances(&sample).map_err(|error| words(&error))?;
        let distance = distances.and_then(|distances| distances.first().copied());
        Ok(match distance {
            Some(distance) => prediction.with_distance(distance),
            None => prediction,
        })
    }

    /// Counts and stores a prediction, and calls the callback.
    fn take(&self, newest: &Newest, prediction: Prediction) {
        let counts = self.counted(newest, &prediction);
        (self.heard)(&newest.frame, &prediction, &counts);
        if let Some(mut table) = self.table() {
            table.push(prediction);
        }
    }

    fn counted(&self, newest: &Newest, prediction: &Prediction) -> PredictionCounts {
        let mut counts = lock(&self.counts);
        counts.predicted += 1;
        if let (Some(outside), Some(true)) = (&mut counts.outside, prediction.is_outside()) {
            *outside += 1;
        }
        if newest.is_timed {
            let took_s = MonotonicClock.now_s() - newest.stamp_s;
            counts.latencies.add(took_s);
        }
        counts.clone()
    }
}

/// Guard that ends the predictor when its thread ends. No caller then waits forever.
struct Over<'p, 'a>(&'p LivePredictor<'a>);

impl Drop for Over<'_, '_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
