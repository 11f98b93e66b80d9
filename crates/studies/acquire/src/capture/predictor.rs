//! The thread that predicts the newest frame, while older ones that it had no time for are left out and counted.

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

/// Time between two looks at whether it is over.
const LOOK: Duration = Duration::from_millis(50);

/// Counts of the frames that a predictor was offered.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct PredictionCounts {
    /// Frames that came while it predicted.
    pub seen: u64,
    /// Frames that were predicted.
    pub predicted: u64,
    /// Frames that were left out because a newer one came before the model was free.
    pub dropped: u64,
    /// Predicted frames outside what the model has seen; `None` where it does not know.
    pub outside: Option<u64>,
    /// From the stamp of each frame until its prediction was there; none where stamps are of another clock than this machine's.
    pub latencies: Latencies,
}

/// A listener to predictions, each with its frame and the counts so far.
type Heard<'a> = &'a (dyn Fn(&Frame, &Prediction, &PredictionCounts) + Sync);

/// Predicts frames on a thread of its own. It holds one frame, the newest, and nobody waits for it: a capture is as fast as without it.
pub struct LivePredictor<'a> {
    model: &'a LiveModel,
    heard: Heard<'a>,
    /// Known once there is a frame without contact, where one is needed.
    extractor: OnceLock<Extractor>,
    offered: Mutex<Offered>,
    /// A frame came, or was taken away, or it is over.
    changed: Condvar,
    counts: Mutex<PredictionCounts>,
    table: Option<Mutex<PredictionTable>>,
    failure: OnceLock<String>,
}

/// The newest frame, and whether more will come.
#[derive(Default)]
struct Offered {
    newest: Option<Newest>,
    is_over: bool,
}

struct Newest {
    frame: Frame,
    stamp_s: f64,
    /// True if the stamp is of this machine's clock.
    is_timed: bool,
}

impl<'a> LivePredictor<'a> {
    /// A predictor by `model`; `heard` is called with each prediction, its frame and what became of all frames, on the thread of the predictor.
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

    /// The same, keeping every prediction for a table beside the recording.
    #[must_use]
    pub fn with_table(self) -> LivePredictor<'a> {
        let table = PredictionTable::new(self.model.channels());
        LivePredictor {
            table: Some(Mutex::new(table)),
            ..self
        }
    }

    /// The model.
    pub fn model(&self) -> &LiveModel {
        self.model
    }

    /// Counts of the frames so far.
    pub fn counts(&self) -> PredictionCounts {
        lock(&self.counts).clone()
    }

    /// The reason why it predicts no more, if the model failed.
    pub fn failure(&self) -> Option<&str> {
        self.failure.get().map(String::as_str)
    }

    /// The predictions that were kept.
    pub(super) fn table(&self) -> Option<MutexGuard<'_, PredictionTable>> {
        self.table.as_ref().map(lock)
    }

    /// Makes ready for frames like `untouched`, which is the reference where the model needs one.
    pub(super) fn begin(
        &self,
        info: taceva_core::FrameInfo,
        untouched: Option<&Frame>,
    ) -> Result<(), AcquireError> {
        let extractor = self.model.extractor(info, untouched)?;
        // Begun twice it goes on with the first reference.
        drop(self.extractor.set(extractor));
        Ok(())
    }

    /// Leaves `frame`, true at `stamp_s`, for the thread that predicts, in the place of an older one. Only what is not real waits for that thread.
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

    /// Predicts what is offered until it is [over](LivePredictor::end).
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
                    // The first failure is the one that is told.
                    drop(self.failure.set(problem));
                    return;
                }
            }
        }
    }

    /// Lets the thread end once it has predicted the frame that waits.
    pub(super) fn end(&self) {
        lock(&self.offered).is_over = true;
        self.changed.notify_all();
    }

    /// The newest frame, waited for; `None` once it is over.
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

    /// Counts and keeps a prediction, and passes it on.
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

/// Lets nobody wait for a thread that has ended, however it did.
struct Over<'p, 'a>(&'p LivePredictor<'a>);

impl Drop for Over<'_, '_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
