//! Tests of periodic angles, which models learn as directions.

use taceva_core::{
    Channel, Channels, Features, FrameInfo, PixelFormat, SilentProgress, Targets, TrainingSet, Unit,
};
use taceva_models::{Color, FeatureSpec, FitInput, Model, ModelSettings, Provenance, find};

const SPEC: FeatureSpec = FeatureSpec {
    width: 2,
    height: 2,
    color: Color::Gray,
    difference: false,
    pca: None,
    ..FeatureSpec::DEFAULT
};

const FRAME: FrameInfo = FrameInfo {
    width: 2,
    height: 2,
    format: PixelFormat::Gray8,
};

/// Forces and yaws, with four features as a picture would have them.
fn drawn(yaws: impl Iterator<Item = f64>) -> (Features, Vec<f64>) {
    let mut values = Vec::new();
    let mut labels = Vec::new();
    for (number, yaw) in yaws.enumerate() {
        let force = 0.1 * f64::from(u32::try_from(number % 17).expect("small"));
        let phase = yaw.to_radians();
        #[expect(clippy::cast_possible_truncation, reason = "features are 32 bits")]
        let pixels = [phase.cos(), phase.sin(), force, 1.0].map(|value| value as f32);
        values.extend(pixels);
        labels.extend([force, yaw]);
    }
    let features = Features::new(SPEC.shape(), values).expect("whole");
    (features, labels)
}

fn channels(period: Option<u16>) -> Channels {
    let yaw = Channel::named("yaw", Unit::Degree).expect("plain");
    let yaw = match period {
        Some(period) => yaw.with_period(period).expect("an angle"),
        None => yaw,
    };
    Channels::new([Channel::FZ, yaw]).expect("distinct")
}

fn fitted(name: &str, channels: &Channels, features: &Features, labels: &[f64]) -> Model {
    let settings = ModelSettings::default();
    let estimator = find(name).expect("registered");
    let estimator = estimator.estimator(&settings).expect("valid");
    let input = FitInput {
        estimator: &*estimator,
        settings: &settings,
        features: SPEC,
        input: FRAME.into(),
        training: TrainingSet::new(features, Targets::new(channels, labels)),
        validation: None,
        provenance: Provenance::default(),
    };
    Model::fit(input, &SilentProgress).expect("fitted")
}

/// Greatest errors of the force and of the yaw. The yaw error is measured along the shorter way around the circle.
fn errors(channels: &Channels, found: &[f64], labels: &[f64]) -> [f64; 2] {
    let mut greatest = [0.0_f64; 2];
    for (found, labels) in found.chunks(2).zip(labels.chunks(2)) {
        for (at, channel) in channels.iter().enumerate() {
            let error = (channel.nearest(found[at], labels[at]) - labels[at]).abs();
            greatest[at] = greatest[at].max(error);
        }
    }
    greatest
}

/// Yaws around the circle, between -180 and 180 degrees.
fn around(start: f64) -> impl Iterator<Item = f64> {
    (0..160).map(move |number| (start + f64::from(number) * 23.7).rem_euclid(360.0) - 180.0)
}

#[test]
fn a_yaw_across_180_degrees_is_predicted_by_linear_models_only_as_a_direction() {
    let (features, labels) = drawn(around(0.0));
    let (test, truth) = drawn(around(11.0));
    let periodic = channels(Some(360));
    for name in ["ridge", "pls"] {
        let model = fitted(name, &periodic, &features, &labels);
        assert_eq!(model.channels(), &periodic);
        let found = model.predict(&test).expect("predicted");
        assert_eq!(found.len(), truth.len());
        let [force, yaw] = errors(&periodic, &found, &truth);
        assert!(force < 0.1 && yaw < 3.0, "{name}: {force} N, {yaw} degrees");
        assert!(
            found
                .iter()
                .skip(1)
                .step_by(2)
                .all(|yaw| yaw.abs() <= 180.0)
        );
        let plain = fitted(name, &channels(None), &features, &labels);
        let found = plain.predict(&test).expect("predicted");
        assert!(errors(&periodic, &found, &truth)[1] > 30.0, "{name}");
    }
}

#[test]
fn angles_from_0_to_360_come_back_so_and_a_model_file_keeps_the_period() {
    let (features, labels) = drawn(around(0.0).map(|yaw| yaw.rem_euclid(360.0)));
    let periodic = channels(Some(360));
    let model = fitted("ridge", &periodic, &features, &labels);
    let found = model.predict(&features).expect("predicted");
    let yaws = found.iter().skip(1).step_by(2);
    assert!(yaws.clone().all(|yaw| (0.0..=360.0).contains(yaw)));
    assert!(yaws.clone().any(|yaw| *yaw > 200.0));
    let read = Model::from_bytes(&model.to_bytes().expect("written")).expect("read");
    assert_eq!(read, model);
    assert_eq!(read.predict(&features).expect("predicted"), found);
    let constants: Vec<&str> = read.constants().map(|(name, _)| name).collect();
    assert_eq!(constants, ["Fz", "yaw"]);
}

#[test]
fn an_angle_in_radians_is_learnt_by_its_own_period_and_a_model_file_keeps_the_unit() {
    let radians = |values: &[f64]| -> Vec<f64> {
        let rows = values.chunks(2);
        rows.flat_map(|row| [row[0], row[1].to_radians()]).collect()
    };
    let (features, labels) = drawn(around(0.0));
    let (test, truth) = drawn(around(11.0));
    let truth = radians(&truth);
    let yaw = Channel::named("yaw", Unit::Radian).expect("plain");
    let yaw = yaw.with_period(360).expect("an angle");
    let channels = Channels::new([Channel::FZ, yaw]).expect("distinct");
    for name in ["ridge", "pls"] {
        let model = fitted(name, &channels, &features, &radians(&labels));
        let found = model.predict(&test).expect("predicted");
        let [force, yaw] = errors(&channels, &found, &truth);
        assert!(
            force < 0.1 && yaw < 3.0_f64.to_radians(),
            "{name}: {force} N, {yaw} rad"
        );
        let read = Model::from_bytes(&model.to_bytes().expect("written")).expect("read");
        assert_eq!(read.channels(), &channels);
        assert_eq!(read.predict(&test).expect("predicted"), found);
    }
}

#[test]
fn a_model_without_periods_is_as_it_was() {
    let (features, labels) = drawn(around(0.0).map(|yaw| yaw / 10.0));
    let model = fitted("ridge", &channels(None), &features, &labels);
    assert!(model.card().angles.is_empty());
    assert!(!String::from_utf8_lossy(&model.to_bytes().expect("written")).contains("\"angles\""));
    let bounds = model.label_bounds();
    assert!(bounds.of(0).is_some() && bounds.of(1).is_some());
    let periodic = fitted("ridge", &channels(Some(360)), &features, &labels);
    let bounds = periodic.label_bounds();
    assert!(bounds.of(0).is_some() && bounds.of(1).is_none());
}
