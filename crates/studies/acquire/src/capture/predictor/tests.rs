//! Tests that a predictor never blocks its caller, and counts dropped frames.

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

/// Test model that predicts the brightness of uniform frames, in N.
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

/// Offers `count` frames of brightness 0, 1, 2 … at the interval `every`. The callback takes the time `listens` for each prediction.
fn offered(count: u8, every: Duration, listens: Duration) -> (Vec<Prediction>, PredictionCounts) {
    let model = model();
    let heard = Mutex::new(Vec::new());
    let listener = |_: &Frame, prediction: &Prediction, _: &PredictionCounts| {
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
            // Time to copy a small frame, with slack for a busy machine.
            assert!(
                began.elapsed() < Duration::from_millis(80),
                "{:?}",
                began.elapsed()
            );
            std::thread::sleep(every);
        }
        predictor.end();
    });
    let counts = predictor.counts();
    (heard.into_inner().expect("whole"), counts)
}

#[test]
fn a_model_slower_than_its_camera_drops_older_frames_keeps_the_last_and_delays_nobody() {
    let (predictions, counts) = offered(40, Duration::from_millis(5), Duration::from_millis(40));
    assert_eq!(
        (counts.seen, counts.latencies.count()),
        (40, counts.predicted)
    );
    assert_eq!(counts.predicted + counts.dropped, 40);
    assert!(counts.dropped > 10, "{counts:?}");
    let stamps: Vec<f64> = predictions
        .iter()
        .map(|prediction| prediction.stamp_s)
        .collect();
    assert!(stamps.is_sorted(), "{stamps:?}");
    let last = predictions.last().expect("some");
    assert!((last.values[0] - 39.0 / 255.0).abs() < 0.01, "{last:?}");
    assert_eq!(counts.outside, Some(0));
}

#[test]
fn what_is_not_real_waits_for_the_model_and_every_frame_is_predicted() {
    let model = model();
    let heard = |_: &Frame, _: &Prediction, _: &PredictionCounts| {
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
    let counts = predictor.counts();
    assert_eq!((counts.seen, counts.predicted, counts.dropped), (10, 10, 0));
    assert_eq!(
        counts.latencies.count(),
        0,
        "its stamps are of another clock"
    );
    // The training data end at a brightness of 127.
    assert!(
        counts
            .outside
            .is_some_and(|outside| (1..6).contains(&outside)),
        "{counts:?}"
    );
}

#[test]
fn frames_that_come_after_the_end_wait_for_nobody() {
    let model = model();
    let heard = |_: &Frame, _: &Prediction, _: &PredictionCounts| {};
    let predictor = LivePredictor::new(&model, &heard);
    predictor.end();
    for _ in 0..3 {
        predictor.offer(&frame(1), 0.0, DriverSource::Simulated);
    }
    assert_eq!(predictor.counts().seen, 0);
}

#[test]
fn a_frame_of_another_size_midway_ends_the_predictions_with_both_sizes() {
    let model = model();
    let heard = |_: &Frame, _: &Prediction, _: &PredictionCounts| {};
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
    assert_eq!(predictor.counts().predicted, 1);
}
