//! Estimator of a plugin: fitted, called, saved and loaded.

use taceva_core::{
    Args, Channel, Channels, ErrorKind, FeatureShape, Features, ModelError, Progress, Saved,
    SavedRegressor, SilentProgress, Targets, TrainingSet,
};
use taceva_host::{FitRequest, InProcess, Session};

use crate::fixture::{Fixture, MEAN};

struct Samples {
    features: Features,
    channels: Channels,
    values: Vec<f64>,
}

fn samples() -> Samples {
    let shape = FeatureShape::flat(2);
    Samples {
        features: Features::new(shape, vec![0.0, 1.0, 2.0, 3.0]).expect("whole"),
        channels: Channels::new([Channel::FZ, Channel::PZ]).expect("distinct"),
        values: vec![1.0, 10.0, 3.0, 30.0],
    }
}

fn fit(
    session: &InProcess,
    samples: &Samples,
    progress: &dyn Progress,
) -> Result<Box<dyn SavedRegressor>, ModelError> {
    let training = TrainingSet::new(
        &samples.features,
        Targets::new(&samples.channels, &samples.values),
    );
    let settings = Args::default();
    let request = FitRequest::new(&settings, &training, progress);
    session.fit(&MEAN, &request)
}

#[test]
fn a_model_that_was_kept_predicts_what_it_did_before() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let (session, samples) = (fixture.session(), samples());
    let model = fit(&session, &samples, &SilentProgress).expect("fits");
    let mut predicted = vec![0.0; 4];
    model
        .predict(&samples.features, &mut predicted)
        .expect("predicts");
    assert_eq!(predicted, [2.0, 20.0, 2.0, 20.0]);
    let bytes = model.save().expect("saves");
    drop(model);
    let saved = Saved::new(&bytes, &samples.channels, samples.features.shape());
    let again = session.load(&MEAN, &saved).expect("loads");
    let mut repeated = vec![0.0; 4];
    again
        .predict(&samples.features, &mut repeated)
        .expect("predicts");
    assert_eq!(repeated, predicted);
    let error = again
        .predict(&samples.features, &mut [0.0; 3])
        .expect_err("3");
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    let damaged = Saved::new(&bytes[1..], saved.channels, saved.shape);
    let error = session.load(&MEAN, &damaged).map(|_| ()).expect_err("cut");
    assert_eq!(error.kind(), ErrorKind::Protocol);
}

struct Cancelled;

impl Progress for Cancelled {
    fn is_cancelled(&self) -> bool {
        true
    }
}

struct Panics;

impl Progress for Panics {
    fn advance(&self, _: u64) {
        panic!("whoever listens has a bug");
    }
    fn is_cancelled(&self) -> bool {
        false
    }
}

#[test]
fn a_fit_ends_when_it_is_cancelled_and_when_whoever_listens_panics() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let (session, samples) = (fixture.session(), samples());
    for progress in [&Cancelled as &dyn Progress, &Panics] {
        let error = fit(&session, &samples, progress).map(|_| ());
        assert_eq!(error.expect_err("cancelled").kind(), ErrorKind::Interrupted);
    }
}

#[test]
fn predictions_that_are_no_numbers_and_models_longer_than_they_said_are_refused() {
    let Some(fixture) = Fixture::built(&["BAD_PREDICTION", "WROTE_TOO_MUCH"]) else {
        return;
    };
    let (session, samples) = (fixture.session(), samples());
    let model = fit(&session, &samples, &SilentProgress).expect("fits");
    let error = model.predict(&samples.features, &mut [0.0; 4]);
    assert_eq!(error.expect_err("infinite").kind(), ErrorKind::DeviceFault);
    let error = model.save().expect_err("longer");
    assert_eq!(error.kind(), ErrorKind::Abi);
}

#[test]
fn numbers_that_are_not_finite_are_never_handed_over() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let (session, mut samples) = (fixture.session(), samples());
    samples.values[2] = f64::NAN;
    let error = fit(&session, &samples, &SilentProgress).map(|_| ());
    assert_eq!(error.expect_err("NaN").kind(), ErrorKind::InvalidArgument);
}
