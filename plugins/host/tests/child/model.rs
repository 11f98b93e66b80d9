//! Models through a child: made, called, saved and loaded, with bit-identical numbers.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use taceva_core::{
    Args, Channel, Channels, DriverKey, ErrorKind, FeatureShape, Features, ModelError, Progress,
    Regressor, SilentProgress, Targets, TrainingSet,
};
use taceva_host::{FitRequest, Patience, Saved, SavedRegressor, Session};

use crate::runner::Test;
use crate::{child, served};

pub(crate) const TESTS: &[Test] = &[
    (
        "a_model_says_the_same_through_a_child",
        a_model_says_the_same_through_a_child,
    ),
    (
        "a_fit_tells_how_far_it_is_and_ends_when_it_is_asked_to",
        a_fit_tells_how_far_it_is_and_ends_when_it_is_asked_to,
    ),
    (
        "a_model_that_fails_says_why_and_one_that_lies_is_a_fault",
        a_model_that_fails_says_why_and_one_that_lies_is_a_fault,
    ),
];

const SUMS: DriverKey = DriverKey::fixed("odd/sums");

/// Predicts the sum of the features times the mean of the training targets, for each channel.
struct Sums {
    means: Vec<f64>,
    channels: Channels,
    shape: FeatureShape,
}

impl Regressor for Sums {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        for sample in 0..features.samples() {
            let sum: f32 = features.sample(sample).iter().sum();
            for (place, mean) in self.means.iter().enumerate() {
                into[sample * self.means.len() + place] = f64::from(sum) * mean;
            }
        }
        Ok(())
    }
}

impl SavedRegressor for Sums {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        Ok(self
            .means
            .iter()
            .flat_map(|mean| mean.to_le_bytes())
            .collect())
    }
}

pub(crate) fn fit(
    estimator: &DriverKey,
    request: &FitRequest<'_>,
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let training = request.training;
    let channels = training.targets.channels.clone();
    match estimator.as_str() {
        "odd/sums" => {}
        "odd/endless" => loop {
            request.progress.begin("turn in circles", Some(2));
            request.progress.advance(1);
            request.progress.end();
            std::thread::sleep(Duration::from_millis(1));
            if request.progress.is_cancelled() {
                return Err(ModelError::new(
                    ErrorKind::Interrupted,
                    "odd/endless: cancelled",
                ));
            }
        },
        "odd/panic" => panic!("no more ideas"),
        "odd/lie" => {
            return Ok(Box::new(Sums {
                means: vec![f64::NAN; channels.len()],
                channels,
                shape: training.features.shape(),
            }));
        }
        _ => return Err(ModelError::new(ErrorKind::NotFound, "no such estimator")),
    }
    let mut means = vec![0.0; channels.len()];
    for row in training.targets.values.chunks_exact(channels.len()) {
        for (mean, value) in means.iter_mut().zip(row) {
            *mean += value;
        }
    }
    let groups: u32 = training.groups.into_iter().flatten().sum();
    let validation = request.validation.map_or(0, |set| set.features.samples());
    for mean in &mut means {
        *mean += f64::from(groups) + f64::from(u32::try_from(validation).expect("few"));
    }
    Ok(Box::new(Sums {
        means,
        channels,
        shape: training.features.shape(),
    }))
}

pub(crate) fn load(
    _: &DriverKey,
    saved: &Saved<'_>,
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let means = saved
        .bytes
        .chunks_exact(8)
        .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight")));
    let means: Vec<f64> = means.collect();
    if means.len() != saved.channels.len() || !saved.bytes.len().is_multiple_of(8) {
        return Err(ModelError::new(ErrorKind::Protocol, "odd/sums: no model"));
    }
    Ok(Box::new(Sums {
        means,
        channels: saved.channels.clone(),
        shape: saved.shape,
    }))
}

/// Training set of 20,000 samples. It is larger than any message.
struct Lesson {
    features: Features,
    channels: Channels,
    targets: Vec<f64>,
    groups: Vec<u32>,
}

fn lesson() -> Lesson {
    let shape = FeatureShape {
        height: 2,
        width: 3,
        depth: 1,
    };
    let samples = 20_000_u16;
    let values = (0..u32::from(samples) * 6).map(|count| (count % 97) as u8);
    let values = values.map(|count| f32::from(count) / 7.0).collect();
    let targets = (0..samples).flat_map(|count| [f64::from(count) / 3.0, 0.1]);
    Lesson {
        features: Features::new(shape, values).expect("whole"),
        channels: Channels::new([Channel::PZ, Channel::FZ]).expect("each once"),
        targets: targets.collect(),
        groups: (0..u32::from(samples)).map(|count| count / 100).collect(),
    }
}

impl Lesson {
    fn set(&self) -> TrainingSet<'_> {
        TrainingSet::new(&self.features, Targets::new(&self.channels, &self.targets))
            .with_groups(&self.groups[..])
    }
}

fn fitted(
    session: &dyn Session,
    estimator: &DriverKey,
    progress: &dyn Progress,
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let lesson = lesson();
    let (settings, training) = (Args::default(), lesson.set());
    let request = FitRequest::new(&settings, &training, progress).with_validation(&training);
    session.fit(estimator, &request)
}

fn predicted(model: &dyn Regressor) -> Result<Vec<u64>, ModelError> {
    let lesson = lesson();
    let mut into = vec![0.0; lesson.targets.len()];
    model.predict(&lesson.features, &mut into)?;
    Ok(into.into_iter().map(f64::to_bits).collect())
}

fn a_model_says_the_same_through_a_child() {
    let (without, with) = (served().expect("sound"), child(Patience::default()));
    let here = fitted(&without, &SUMS, &SilentProgress).expect("a model");
    let there = fitted(&with, &SUMS, &SilentProgress).expect("a model");
    assert_eq!(there.channels(), here.channels());
    assert_eq!(there.shape(), here.shape());
    let expected = predicted(&*here).expect("predicted");
    assert_eq!(predicted(&*there).expect("predicted"), expected);
    let bytes = there.save().expect("kept");
    assert_eq!(bytes, here.save().expect("kept"));

    let saved = Saved::new(&bytes, here.channels(), here.shape());
    drop(there);
    let loaded = with.load(&SUMS, &saved).expect("loaded");
    assert_eq!(predicted(&*loaded).expect("predicted"), expected);
    let cut = Saved::new(&bytes[1..], saved.channels, saved.shape);
    let error = with.load(&SUMS, &cut).map(drop).expect_err("no model");
    assert_eq!(error.kind(), ErrorKind::Protocol);
    assert_eq!(error.to_string(), "odd/sums: no model");
    let wrong = loaded.predict(&lesson().features, &mut [0.0]);
    assert_eq!(
        wrong.expect_err("too short").kind(),
        ErrorKind::InvalidArgument
    );
}

/// Counts progress reports, and cancels after the first step.
#[derive(Default)]
struct Impatient {
    told: Mutex<BTreeMap<String, u64>>,
    has_enough: AtomicBool,
}

impl Progress for Impatient {
    fn begin(&self, stage: &str, steps: Option<u64>) {
        let stage = format!("{stage} {steps:?}");
        *self.told.lock().expect("whole").entry(stage).or_default() += 1;
    }

    fn advance(&self, steps: u64) {
        assert_eq!(steps, 1);
        self.has_enough.store(true, Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        self.has_enough.load(Ordering::Relaxed)
    }
}

fn a_fit_tells_how_far_it_is_and_ends_when_it_is_asked_to() {
    let session = child(Patience::default());
    let progress = Impatient::default();
    let endless = DriverKey::fixed("odd/endless");
    let error = fitted(&session, &endless, &progress).map(drop);
    let error = error.expect_err("cancelled");
    assert_eq!(error.kind(), ErrorKind::Interrupted, "{error}");
    let told = progress.told.lock().expect("whole");
    let stages: Vec<&String> = told.keys().collect();
    assert_eq!(stages, ["turn in circles Some(2)"]);
    assert_eq!(session.child().fate(), None);
}

fn a_model_that_fails_says_why_and_one_that_lies_is_a_fault() {
    let session = child(Patience::default());
    let panic = fitted(&session, &DriverKey::fixed("odd/panic"), &SilentProgress);
    let panic = panic.map(drop).expect_err("a panic");
    assert_eq!(panic.kind(), ErrorKind::Panicked);
    assert!(panic.to_string().contains("no more ideas"), "{panic}");
    let absent = fitted(&session, &DriverKey::fixed("odd/none"), &SilentProgress);
    assert_eq!(
        absent.map(drop).expect_err("none").kind(),
        ErrorKind::NotFound
    );
    let liar = fitted(&session, &DriverKey::fixed("odd/lie"), &SilentProgress).expect("a model");
    let lie = predicted(&*liar).expect_err("NaN");
    assert_eq!(lie.kind(), ErrorKind::DeviceFault);
    assert!(lie.to_string().contains("NaN"), "{lie}");
    let good = fitted(&session, &SUMS, &SilentProgress).expect("unharmed");
    predicted(&*good).expect("predicted");
}
