//! What every network promises as an estimator and in a file.

use std::sync::atomic::{AtomicUsize, Ordering};

use taceva_core::{
    Channel, Channels, ErrorKind, FeatureShape, Features, Frame, FrameInfo, ModelError,
    PixelFormat, Progress, Regressor, Silent, Targets, TrainingSet,
};
use taceva_models::{
    FeatureSpec, FitInput, Model, ModelEstimator, ModelFit, ModelRegressor, Provenance, Settings,
    find,
};

const NETWORKS: [&str; 4] = ["cnn", "resnet10", "resnet18", "resnet34"];

const SHAPE: FeatureShape = FeatureShape {
    height: 20,
    width: 24,
    depth: 1,
};

/// Pictures of a blob, and where it is.
struct Recording {
    features: Features,
    channels: Channels,
    labels: Vec<f64>,
}

/// Even numbers in 0..1 from a linear congruential generator (Knuth's MMIX constants).
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).expect("32 bits")) / 2_f64.powi(32)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision"
)]
fn recording(samples: usize, seed: u64) -> Recording {
    let mut next = numbers(seed);
    let (mut values, mut labels) = (Vec::new(), Vec::new());
    for _ in 0..samples {
        let (y, x) = (4.0 + 12.0 * next(), 4.0 + 16.0 * next());
        for (row, column) in (0..20_u8).flat_map(|row| (0..24_u8).map(move |column| (row, column)))
        {
            let square = (f64::from(row) - y).powi(2) + (f64::from(column) - x).powi(2);
            values.push((0.2 + 0.5 * (-square / 18.0).exp() + 0.01 * next()) as f32);
        }
        labels.extend([x, y]);
    }
    Recording {
        features: Features::new(SHAPE, values).expect("whole samples"),
        channels: Channels::new([Channel::PX, Channel::PY]).expect("distinct"),
        labels,
    }
}

impl Recording {
    fn set(&self) -> TrainingSet<'_> {
        let targets = Targets {
            channels: &self.channels,
            values: &self.labels,
        };
        TrainingSet {
            features: &self.features,
            targets,
            groups: None,
        }
    }
}

fn estimator(name: &str, words: &[&str]) -> Box<dyn ModelEstimator> {
    let settings = Settings::parse(words.iter().copied()).expect("well formed");
    find(name)
        .expect("registered")
        .estimator(&settings)
        .expect("valid")
}

fn predict(regressor: &dyn Regressor, features: &Features) -> Vec<f64> {
    let mut into = vec![0.0; features.samples() * regressor.channels().len()];
    regressor.predict(features, &mut into).expect("finite");
    into
}

fn refusal(result: Result<ModelFit, ModelError>) -> String {
    match result {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_blob_is_found() {
    let (training, validation, test) = (recording(200, 1), recording(40, 2), recording(60, 3));
    let words = ["epochs=30", "batch=20", "jitter=0", "local_mean=0"];
    let fit = estimator("cnn", &words)
        .fit_model(&training.set(), Some(&validation.set()), &Silent)
        .expect("fits");
    let found = predict(&fit.regressor, &test.features);
    let errors = found
        .iter()
        .zip(&test.labels)
        .map(|(found, label)| (found - label).powi(2));
    let rms = (errors.sum::<f64>() / found.len() as f64).sqrt();
    // The labels spread by about four pixels.
    assert!(rms < 1.0, "{rms}");
    let kept = fit.choice.channels[0].rmse.expect("measured");
    assert!(kept < 1.0 && fit.choice.setting.as_deref() == Some("epoch"));
}

#[test]
fn a_constant_label_is_predicted_exactly() {
    let mut training = recording(16, 1);
    training
        .labels
        .iter_mut()
        .skip(1)
        .step_by(2)
        .for_each(|label| *label = 0.1);
    for name in NETWORKS {
        let fit = estimator(name, &["epochs=1", "batch=8"])
            .fit_model(&training.set(), None, &Silent)
            .expect("fits");
        let found = predict(&fit.regressor, &training.features);
        assert!(
            found
                .iter()
                .skip(1)
                .step_by(2)
                .all(|value| value.to_bits() == 0.1_f64.to_bits()),
            "{name}"
        );
        assert!(found[0].to_bits() != found[2].to_bits(), "{name}");
    }
    training.labels.iter_mut().for_each(|label| *label = -2.5);
    let fit = estimator("cnn", &["epochs=1", "batch=8"])
        .fit_model(&training.set(), None, &Silent)
        .expect("fits");
    let found = predict(&fit.regressor, &training.features);
    assert!(
        found
            .iter()
            .all(|value| value.to_bits() == (-2.5_f64).to_bits())
    );
}

#[test]
fn what_cannot_be_learnt_from_is_refused() {
    let training = recording(16, 1);
    for name in NETWORKS {
        let few = estimator(name, &["batch=17"]).fit_model(&training.set(), None, &Silent);
        assert_eq!(refusal(few), "16 training samples, a batch takes 17");
        let mut broken = recording(16, 1);
        broken.labels[5] = f64::NAN;
        let result = estimator(name, &[]).fit_model(&broken.set(), None, &Silent);
        assert_eq!(refusal(result), "training sample 2: `Py` is not finite");
        let result =
            estimator(name, &["batch=8"]).fit_model(&training.set(), Some(&broken.set()), &Silent);
        assert_eq!(refusal(result), "validation sample 2: `Py` is not finite");
    }
    let settings = Settings::parse(["epoch=3"]).expect("well formed");
    let error = find("cnn")
        .expect("registered")
        .estimator(&settings)
        .err()
        .expect("refused");
    assert_eq!(
        error.to_string(),
        "`epoch`: unknown key, did you mean `epochs`?"
    );
}

/// Cancels after some questions.
struct Cancel(usize, AtomicUsize);

impl Progress for Cancel {
    fn begin(&self, _stage: &str, _steps: Option<u64>) {}
    fn advance(&self, _steps: u64) {}
    fn end(&self) {}
    fn is_cancelled(&self) -> bool {
        self.1.fetch_add(1, Ordering::Relaxed) >= self.0
    }
}

#[test]
fn a_cancelled_fit_stops_with_an_error() {
    let training = recording(16, 1);
    for name in NETWORKS {
        let progress = Cancel(2, AtomicUsize::new(0));
        let result = estimator(name, &["batch=8"]).fit_model(&training.set(), None, &progress);
        assert_eq!(
            result.expect_err("cancelled").kind(),
            ErrorKind::Interrupted,
            "{name}"
        );
    }
}

#[test]
fn any_number_of_threads_and_any_unit_of_labels_give_the_same_bits() {
    let (training, validation) = (recording(24, 1), recording(10, 2));
    for name in ["cnn", "resnet10"] {
        let with = |threads: usize, unit: f64| -> Vec<f64> {
            let mut training = recording(24, 1);
            training.labels.iter_mut().for_each(|label| *label *= unit);
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().expect("threads").install(|| {
                let estimator = estimator(name, &["epochs=2", "batch=8"]);
                let fit = estimator
                    .fit_model(&training.set(), None, &Silent)
                    .expect("fits");
                predict(&fit.regressor, &validation.features)
            })
        };
        let alone = with(1, 1.0);
        assert!(
            with(3, 1.0)
                .iter()
                .zip(&alone)
                .all(|(a, b)| a.to_bits() == b.to_bits()),
            "{name}"
        );
        // A power of two changes no digit on the way.
        let larger = with(2, 1024.0);
        assert!(
            larger
                .iter()
                .zip(&alone)
                .all(|(a, b)| a.to_bits() == (1024.0 * b).to_bits()),
            "{name}"
        );
    }
    assert_eq!(training.labels.len(), 48);
}

const FRAME: FrameInfo = FrameInfo {
    width: 48,
    height: 40,
    format: PixelFormat::Gray8,
};

fn model(name: &str, words: &[&str], pca: Option<u32>) -> Result<Model, ModelError> {
    let training = recording(24, 1);
    let settings = Settings::parse(words.iter().copied()).expect("well formed");
    let spec = FeatureSpec {
        width: 24,
        height: 20,
        pca,
        ..FeatureSpec::default()
    };
    Model::fit(
        FitInput {
            estimator: &*estimator(name, words),
            settings: &settings,
            features: spec,
            frame: FRAME,
            training: training.set(),
            validation: None,
            provenance: Provenance::default(),
        },
        &Silent,
    )
}

#[test]
fn a_file_gives_the_same_model_and_the_same_bits() {
    for name in NETWORKS {
        let model = model(name, &["epochs=1", "batch=8"], None).expect("fits");
        let bytes = model.to_bytes().expect("small");
        let again = Model::from_bytes(&bytes).expect("its own bytes");
        assert!(again == model, "{name}");
        assert!(again.to_bytes().expect("small") == bytes, "{name}");
        let features = recording(5, 9).features;
        let bits = |model: &Model| -> Vec<u64> {
            let found = model.predict(&features).expect("finite");
            found.iter().map(|value| value.to_bits()).collect()
        };
        assert_eq!(bits(&again), bits(&model), "{name}");
        assert!(model.reads_features());
    }
    let resnet = model("resnet10", &["epochs=1", "batch=8"], None).expect("fits");
    let ModelRegressor::Network(network) = resnet.regressor() else {
        panic!("a network")
    };
    let names: Vec<String> = network
        .tensors()
        .into_iter()
        .map(|tensor| tensor.name)
        .collect();
    assert!(names.contains(&"layer2.0.downsample.1.running_var".to_owned()));
}

#[test]
fn components_are_no_picture() {
    let error = model("cnn", &["epochs=1", "batch=8"], Some(4)).expect_err("refused");
    assert_eq!(
        error.to_string(),
        "a network reads pictures, and principal components are none"
    );
}

#[test]
fn no_damaged_file_panics_or_opens_as_something_else() {
    let model = model("cnn", &["epochs=1", "batch=8"], None).expect("fits");
    let bytes = model.to_bytes().expect("small");
    let header = usize::from(u16::from_le_bytes([bytes[0], bytes[1]])) + 8;
    let mut next = numbers(11);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place below the bound"
    )]
    let mut below = |bound: usize| (next() * bound as f64) as usize;
    for _ in 0..3_000 {
        let mut damaged = bytes.clone();
        // Most of the damage where the file says what it is.
        for _ in 0..=below(3) {
            let within = if below(4) > 0 { header } else { bytes.len() };
            damaged[below(within)] = u8::try_from(below(256)).expect("a byte");
        }
        if let Ok(opened) = Model::from_bytes(&damaged) {
            let ModelRegressor::Network(network) = opened.regressor() else {
                panic!("a network")
            };
            assert!(
                network
                    .tensors()
                    .iter()
                    .flat_map(|tensor| &tensor.values)
                    .all(|value| value.is_finite())
            );
        }
    }
    let frames = [Frame::new(FRAME, vec![7; 48 * 40]).expect("whole")];
    let extractor = model.extractor(FRAME, None).expect("its own frames");
    assert!(
        model
            .predict(&extractor.extract_all(&frames).expect("one kind"))
            .is_ok()
    );
}
