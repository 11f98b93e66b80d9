//! Checks of estimators.

use std::thread;

use taceva_core::{
    Channel, Channels, ErrorKind, FeatureShape, Features, ModelError, Progress, Saved,
    SavedRegressor, SilentProgress, Targets, TrainingSet,
};

use super::subject::{Draw, Subject, writable_memory};
use super::{Check, Of};
use crate::promise::{Unmet, expect, refused};
use taceva_host::{FitRequest, Session};

const OF: Of = Of::Estimator;

pub(super) const CHECKS: &[Check] = &[
    OF.check("estimator/fits-and-predicts", fits),
    OF.check("estimator/fits-the-same-twice", same_twice),
    OF.check("estimator/keeps-a-model", keeps),
    OF.check("estimator/refuses-hostile-models", hostile),
    OF.check("estimator/ends-when-cancelled", cancels),
    OF.check("estimator/predicts-nothing-of-nothing", nothing),
    OF.check("estimator/predicts-in-threads", threads),
    OF.check("estimator/memory-of-1000-models", memory),
];

const SAMPLES: usize = 12;
/// Shape of features from pictures of 32×32 pixels, the default size in a study. Layers of a network require this size.
const SHAPE: FeatureShape = FeatureShape {
    height: 32,
    width: 32,
    depth: 1,
};

struct Samples {
    features: Features,
    channels: Channels,
    values: Vec<f64>,
}

/// Random training samples whose targets are sums of features.
fn samples(seed: u64) -> Result<Samples, Unmet> {
    let mut draw = Draw::new(seed);
    let mut values = Vec::new();
    let mut features = Vec::new();
    for _ in 0..SAMPLES {
        let sample: Vec<f32> = draw
            .bytes(SHAPE.len())
            .iter()
            .map(|byte| f32::from(*byte) / 255.0)
            .collect();
        let sum: f64 = sample.iter().copied().map(f64::from).sum();
        values.extend([sum, 2.0 - sum]);
        features.extend(sample);
    }
    Ok(Samples {
        features: Features::new(SHAPE, features)?,
        channels: Channels::new([Channel::FZ, Channel::PZ])
            .map_err(|error| Unmet::Broken(error.to_string()))?,
        values,
    })
}

fn fit(
    subject: &Subject,
    samples: &Samples,
    progress: &dyn Progress,
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let settings = subject.args().map_err(|_| {
        ModelError::new(
            ErrorKind::InvalidArgument,
            "it requires settings without defaults",
        )
    })?;
    let training = TrainingSet::new(
        &samples.features,
        Targets::new(&samples.channels, &samples.values),
    );
    let key = subject
        .key()
        .map_err(|_| ModelError::new(ErrorKind::Internal, "no estimator"))?;
    let request = FitRequest::new(&settings, &training, progress);
    subject.session.fit(key, &request)
}

fn predicted(model: &dyn SavedRegressor, samples: &Samples) -> Result<Vec<u64>, ModelError> {
    let mut into = vec![0.0; samples.values.len()];
    model.predict(&samples.features, &mut into)?;
    Ok(into.into_iter().map(f64::to_bits).collect())
}

fn fits(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    predicted(&*fit(subject, &samples, &SilentProgress)?, &samples)?;
    Ok(())
}

fn same_twice(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    let one = predicted(&*fit(subject, &samples, &SilentProgress)?, &samples)?;
    let other = predicted(&*fit(subject, &samples, &SilentProgress)?, &samples)?;
    expect(one == other, || {
        "two fits on the same samples give different predictions".to_owned()
    })
}

fn load(
    subject: &Subject,
    samples: &Samples,
    bytes: &[u8],
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let key = subject
        .key()
        .map_err(|_| ModelError::new(ErrorKind::Internal, "no estimator"))?;
    let saved = Saved::new(bytes, &samples.channels, samples.features.shape());
    subject.session.load(key, &saved)
}

fn keeps(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    let model = fit(subject, &samples, &SilentProgress)?;
    let before = predicted(&*model, &samples)?;
    let bytes = model.save()?;
    expect(bytes == model.save()?, || {
        "saving it twice gives different bytes".to_owned()
    })?;
    drop(model);
    let again = load(subject, &samples, &bytes)?;
    expect(predicted(&*again, &samples)? == before, || {
        "the loaded model gives different predictions".to_owned()
    })?;
    expect(again.save()? == bytes, || {
        "saving the loaded model gives different bytes".to_owned()
    })
}

/// `load` rejects garbage bytes and truncated models. A model with a flipped bit is rejected or predicts.
fn hostile(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    let bytes = fit(subject, &samples, &SilentProgress)?.save()?;
    let mut draw = Draw::new(subject.probe.seed);
    for length in [0, 1, 7, 64, 4096] {
        let answer = load(subject, &samples, &draw.bytes(length));
        let kinds = [
            ErrorKind::Protocol,
            ErrorKind::InvalidArgument,
            ErrorKind::OutOfRange,
        ];
        refused(&format!("loading {length} random bytes"), answer, &kinds)?;
    }
    for cut in 0..bytes.len().min(200) {
        let answer = load(subject, &samples, &bytes[..cut]);
        expect(answer.is_err(), || {
            format!("the first {cut} bytes of a model were loaded as a model")
        })?;
    }
    for _ in 0..500 {
        let mut damaged = bytes.clone();
        let place = usize::try_from(draw.next()).unwrap_or(0) % damaged.len().max(1);
        let bit = draw.next().to_le_bytes()[0] % 8;
        if let Some(byte) = damaged.get_mut(place) {
            *byte ^= 1 << bit;
        }
        if let Ok(model) = load(subject, &samples, &damaged) {
            // Any prediction or error passes.
            let _ = predicted(&*model, &samples);
        }
    }
    Ok(())
}

struct Cancelled;

impl Progress for Cancelled {
    fn is_cancelled(&self) -> bool {
        true
    }
}

/// A cancelled fit returns `Interrupted`, unless the fit finished before the cancellation.
fn cancels(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    match fit(subject, &samples, &Cancelled) {
        Err(error) if error.kind() != ErrorKind::Interrupted => Err(error.into()),
        _ => fits(subject),
    }
}

fn nothing(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    let model = fit(subject, &samples, &SilentProgress)?;
    let none = Features::new(samples.features.shape(), Vec::new())?;
    Ok(model.predict(&none, &mut [])?)
}

fn threads(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    let model = fit(subject, &samples, &SilentProgress)?;
    let expected = predicted(&*model, &samples)?;
    let same = thread::scope(|scope| {
        let asking: Vec<_> = (0..4)
            .map(|_| {
                scope.spawn(|| {
                    (0..50)
                        .all(|_| predicted(&*model, &samples).is_ok_and(|found| found == expected))
                })
            })
            .collect();
        asking
            .into_iter()
            .all(|thread| thread.join().unwrap_or(false))
    });
    expect(same, || {
        "four threads got different predictions from one thread".to_owned()
    })
}

fn memory(subject: &Subject) -> Result<(), Unmet> {
    let samples = samples(subject.probe.seed)?;
    let bytes = fit(subject, &samples, &SilentProgress)?.save()?;
    let round = || load(subject, &samples, &bytes).map(drop);
    (0..100).try_for_each(|_| round())?;
    let before = writable_memory()?;
    (0..900).try_for_each(|_| round())?;
    let grown = writable_memory()?.saturating_sub(before);
    expect(grown < 1 << 20, || {
        format!(
            "900 models leaked {} KiB, expected less than 1024",
            grown >> 10
        )
    })
}
