//! The thread that predicts the newest frame, while older ones that it had no time for are left out and counted.

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

/// How long somebody waits before looking whether it is over.
const LOOK: Duration = Duration::from_millis(50);

/// What became of the frames that a predictor was offered.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct PredictionTally {
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

/// Who hears a prediction, with its frame and what became of all frames so far.
type Heard<'a> = &'a (dyn Fn(&Frame, &Prediction, &PredictionTally) + Sync);

/// Predicts frames on a thread of its own. It holds one frame, the newest, and nobody waits for it: a capture is as fast as without it.
pub struct LivePredictor<'a> {
    model: &'a LiveModel,
    heard: Heard<'a>,
    /// Known once there is a frame without contact, where one is needed.
    extractor: OnceLock<Extractor>,
    offered: Mutex<Offered>,
    /// A frame came, or was taken away, or it is over.
    changed: Condvar,
    tally: Mutex<PredictionTally>,
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
    /// Whether the stamp is of this machine's clock.
    is_timed: bool,
}

impl<'a> LivePredictor<'a> {
    /// A predictor by `model`; `heard` is called with each prediction, its frame and what became of all frames, on the thread of the predictor.
    pub fn new(
        model: &'a LiveModel,
        heard: &'a (dyn Fn(&Frame, &Prediction, &PredictionTally) + Sync),
    ) -> LivePredictor<'a> {
        LivePredictor {
            model,
            heard,
            extractor: OnceLock::new(),
            offered: Mutex::default(),
            changed: Condvar::new(),
            tally: Mutex::new(PredictionTally {
                outside: model.knows_distance().then_some(0),
                ..PredictionTally::default()
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

    /// What became of the frames so far.
    pub fn tally(&self) -> PredictionTally {
        lock(&self.tally).clone()
    }

    /// Why it predicts no more, if the model failed.
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
        let mut tally = lock(&self.tally);
        tally.seen += 1;
        tally.dropped += u64::from(older.is_some());
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
                    lock(&self.tally).dropped += 1;
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
        let tally = self.counted(newest, &prediction);
        (self.heard)(&newest.frame, &prediction, &tally);
        if let Some(mut table) = self.table() {
            table.push(prediction);
        }
    }

    fn counted(&self, newest: &Newest, prediction: &Prediction) -> PredictionTally {
        let mut tally = lock(&self.tally);
        tally.predicted += 1;
        if let (Some(outside), Some(true)) = (&mut tally.outside, prediction.is_outside()) {
            *outside += 1;
        }
        if newest.is_timed {
            let took_s = MonotonicClock.now_s() - newest.stamp_s;
            tally.latencies.add(took_s);
        }
        tally.clone()
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

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::time::Instant;

    use taceva_core::random::SplitMix64;
    use taceva_core::{
        Channel, Channels, FeatureShape, Features, FrameInfo, PixelFormat, SilentProgress, Targets,
        TrainingSet,
    };
    use taceva_models::{FeatureSpec, FitInput, Model, ModelSettings, Provenance, find};

    use super::*;

    const INFO: FrameInfo = FrameInfo {
        width: 8,
        height: 6,
        format: PixelFormat::Gray8,
    };

    fn frame(level: u8) -> Frame {
        Frame::new(INFO, vec![level; 48]).expect("whole")
    }

    /// A model of the brightness of even frames, in N.
    fn model() -> LiveModel {
        let spec = FeatureSpec {
            width: 4,
            height: 3,
            ..FeatureSpec::default()
        };
        let shape = FeatureShape {
            height: 3,
            width: 4,
            depth: 1,
        };
        let mut random = SplitMix64::new(5);
        let levels: Vec<f32> = (0..40)
            .map(|_| f32::from(random.next_u64().to_le_bytes()[0] / 2) / 255.0)
            .collect();
        let values = levels.iter().flat_map(|level| [*level; 12]).collect();
        let features = Features::new(shape, values).expect("whole");
        let labels: Vec<f64> = levels.iter().map(|level| f64::from(*level)).collect();
        let channels = Channels::new([Channel::FZ]).expect("one");
        let settings = ModelSettings::default();
        let estimator = find("ridge").expect("known");
        let estimator = estimator.estimator(&settings).expect("valid");
        let input = FitInput {
            estimator: &*estimator,
            settings: &settings,
            features: spec,
            input: INFO.into(),
            training: TrainingSet::new(&features, Targets::new(&channels, &labels)),
            validation: None,
            provenance: Provenance::default(),
        };
        let model = Model::fit(input, &SilentProgress).expect("learnable");
        LiveModel::new(model, Path::new("m.taceva")).expect("of frames")
    }

    /// Offers `count` frames `every` so often, of brightness 0, 1, 2 …, to a predictor whose listener takes `listens`.
    fn offered(
        count: u8,
        every: Duration,
        listens: Duration,
    ) -> (Vec<Prediction>, PredictionTally) {
        let model = model();
        let heard = Mutex::new(Vec::new());
        let listener = |_: &Frame, prediction: &Prediction, _: &PredictionTally| {
            std::thread::sleep(listens);
            lock(&heard).push(prediction.clone());
        };
        let predictor = LivePredictor::new(&model, &listener);
        predictor.begin(INFO, None).expect("fits");
        std::thread::scope(|scope| {
            scope.spawn(|| predictor.run());
            for level in 0..count {
                let began = Instant::now();
                predictor.offer(&frame(level), MonotonicClock.now_s(), DriverSource::Real);
                // A copy of a small frame, and what a busy machine adds to it.
                assert!(
                    began.elapsed() < Duration::from_millis(80),
                    "{:?}",
                    began.elapsed()
                );
                std::thread::sleep(every);
            }
            predictor.end();
        });
        let tally = predictor.tally();
        (heard.into_inner().expect("whole"), tally)
    }

    #[test]
    fn a_model_slower_than_its_camera_drops_older_frames_keeps_the_last_and_delays_nobody() {
        let (predictions, tally) = offered(40, Duration::from_millis(5), Duration::from_millis(40));
        assert_eq!((tally.seen, tally.latencies.count()), (40, tally.predicted));
        assert_eq!(tally.predicted + tally.dropped, 40);
        assert!(tally.dropped > 10, "{tally:?}");
        let stamps: Vec<f64> = predictions
            .iter()
            .map(|prediction| prediction.stamp_s)
            .collect();
        assert!(stamps.is_sorted(), "{stamps:?}");
        let last = predictions.last().expect("some");
        assert!((last.values[0] - 39.0 / 255.0).abs() < 0.01, "{last:?}");
        assert_eq!(tally.outside, Some(0));
    }

    #[test]
    fn what_is_not_real_waits_for_the_model_and_every_frame_is_predicted() {
        let model = model();
        let heard = |_: &Frame, _: &Prediction, _: &PredictionTally| {
            std::thread::sleep(Duration::from_millis(10));
        };
        let predictor = LivePredictor::new(&model, &heard).with_table();
        predictor.begin(INFO, None).expect("fits");
        std::thread::scope(|scope| {
            scope.spawn(|| predictor.run());
            for level in 0..10 {
                predictor.offer(
                    &frame(20 * level),
                    f64::from(level),
                    DriverSource::Simulated,
                );
            }
            predictor.end();
        });
        let tally = predictor.tally();
        assert_eq!((tally.seen, tally.predicted, tally.dropped), (10, 10, 0));
        assert_eq!(
            tally.latencies.count(),
            0,
            "its stamps are of another clock"
        );
        // Training ended at a brightness of 127.
        assert!(
            tally
                .outside
                .is_some_and(|outside| (1..6).contains(&outside)),
            "{tally:?}"
        );
    }

    #[test]
    fn frames_that_come_after_the_end_wait_for_nobody() {
        let model = model();
        let heard = |_: &Frame, _: &Prediction, _: &PredictionTally| {};
        let predictor = LivePredictor::new(&model, &heard);
        predictor.end();
        for _ in 0..3 {
            predictor.offer(&frame(1), 0.0, DriverSource::Simulated);
        }
        assert_eq!(predictor.tally().seen, 0);
    }

    #[test]
    fn a_frame_of_another_size_midway_ends_the_predictions_with_both_sizes() {
        let model = model();
        let heard = |_: &Frame, _: &Prediction, _: &PredictionTally| {};
        let predictor = LivePredictor::new(&model, &heard);
        predictor.begin(INFO, None).expect("fits");
        let wider = FrameInfo { width: 10, ..INFO };
        let other = Frame::new(wider, vec![1; 60]).expect("whole");
        std::thread::scope(|scope| {
            scope.spawn(|| predictor.run());
            for picture in [&frame(3), &other, &frame(4), &frame(5)] {
                predictor.offer(picture, 0.0, DriverSource::Simulated);
            }
        });
        let failure = predictor.failure().expect("it failed");
        assert!(
            failure.contains("10×6") && failure.contains("8×6"),
            "{failure}"
        );
        let error = model.check(wider).expect_err("another size").to_string();
        assert!(error.contains("10×6") && error.contains("8×6"), "{error}");
        assert_eq!(predictor.tally().predicted, 1);
    }
}
