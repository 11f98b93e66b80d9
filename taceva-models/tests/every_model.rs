//! What every registered model promises, from its training samples to its file.

mod blobs;

use std::sync::atomic::{AtomicUsize, Ordering};

use blobs::{FRAME, Recording, SHAPE, numbers, recording};
use taceva_core::{ErrorKind, FeatureShape, Features, ModelError, Progress, Regressor, Silent};
use taceva_models::{
    ALL, FeatureSpec, FitInput, Model, ModelEstimator, ModelFit, Provenance, Settings, find,
};

/// A model as the suite fits it, and what it promises beyond what all do.
struct Case {
    name: &'static str,
    /// Settings that make it quick.
    words: &'static [&'static str],
    /// Samples without which it cannot be fitted.
    least: usize,
    /// How far predictions may move, relative to the largest, where training samples come in another order; `None` where the order is
    /// part of what is drawn.
    order: Option<f64>,
    /// Whether it is but a deeper form of another, which stands for it where every model is fitted several times.
    deeper: bool,
    /// Whether principal components may take the place of pixels.
    components: bool,
    /// The largest root mean square error on the blobs, whose labels deviate by 4.
    error: f64,
}

const fn case(name: &'static str, words: &'static [&'static str], error: f64) -> Case {
    Case {
        name,
        words,
        least: 2,
        order: Some(1e-9),
        deeper: false,
        components: true,
        error,
    }
}

const fn network(name: &'static str) -> Case {
    Case {
        least: 8,
        order: None,
        components: false,
        ..case(name, &["epochs=1", "batch=8"], f64::INFINITY)
    }
}

const CASES: &[Case] = &[
    case("baseline", &[], 5.0),
    case("ridge", &[], 0.6),
    case("pls", &[], 0.6),
    // The path ends where a sweep changes little, wherever it started.
    Case {
        order: Some(1e-3),
        ..case("elastic-net", &[], 0.9)
    },
    // Samples are compared in single precision.
    Case {
        order: Some(1e-4),
        ..case("kernel-ridge", &[], 0.4)
    },
    Case {
        order: None,
        ..case("svr", &[], 0.6)
    },
    Case {
        order: Some(1e-4),
        ..case("gaussian-process", &[], 0.4)
    },
    Case {
        order: Some(1e-5),
        ..case("knn", &[], 1.0)
    },
    Case {
        order: None,
        ..case("random-forest", &["trees=40"], 1.5)
    },
    Case {
        order: None,
        ..case("gradient-boosting", &["most=40"], 1.5)
    },
    network("cnn"),
    network("resnet10"),
    Case {
        deeper: true,
        ..network("resnet18")
    },
    Case {
        deeper: true,
        ..network("resnet34")
    },
    Case {
        least: 5,
        order: None,
        ..case("auto", &["budget_s=0.02"], 0.6)
    },
];

impl Case {
    fn estimator(&self) -> Box<dyn ModelEstimator> {
        let settings = Settings::parse(self.words.iter().copied()).expect("well formed");
        let info = find(self.name).expect("registered");
        info.estimator(&settings).expect("valid settings")
    }

    fn fit(&self, training: &Recording, held: Option<&Recording>) -> Result<ModelFit, ModelError> {
        let held = held.map(Recording::set);
        self.estimator()
            .fit_model(&training.set(), held.as_ref(), &Silent)
    }

    fn fitted(&self, training: &Recording, held: Option<&Recording>) -> ModelFit {
        self.fit(training, held)
            .unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }

    fn refusal(&self, training: &Recording, held: Option<&Recording>) -> String {
        match self.fit(training, held) {
            Ok(_) => panic!("{} accepted what it should refuse", self.name),
            Err(error) => error.to_string(),
        }
    }

    fn model(&self, training: &Recording, pca: Option<u32>) -> Model {
        let settings = Settings::parse(self.words.iter().copied()).expect("well formed");
        let estimator = self.estimator();
        let features = FeatureSpec {
            width: 24,
            height: 20,
            pca,
            ..FeatureSpec::default()
        };
        let input = FitInput {
            estimator: &*estimator,
            settings: &settings,
            features,
            frame: FRAME,
            training: training.set(),
            validation: None,
            provenance: Provenance::default(),
        };
        Model::fit(input, &Silent).unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }
}

fn predict(regressor: &dyn Regressor, features: &Features) -> Vec<f64> {
    let mut into = vec![0.0; features.samples() * regressor.channels().len()];
    regressor.predict(features, &mut into).expect("finite");
    into
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

fn rms(found: &[f64], labels: &[f64]) -> f64 {
    let errors = found.iter().zip(labels).map(|(a, b)| (a - b).powi(2));
    (errors.sum::<f64>() / found.len() as f64).sqrt()
}

#[test]
fn no_model_is_registered_without_being_held_to_this() {
    let registered: Vec<&str> = ALL.iter().map(|info| info.name).collect();
    let held: Vec<&str> = CASES.iter().map(|case| case.name).collect();
    assert_eq!(registered, held);
}

#[test]
fn a_blob_is_found_with_and_without_a_validation_part() {
    let (training, held, test) = (recording(160, 1), recording(40, 2), recording(60, 3));
    for case in CASES.iter().filter(|case| case.error.is_finite()) {
        for validation in [None, Some(&held)] {
            let fit = case.fitted(&training, validation);
            let found = predict(&fit.regressor, &test.features);
            assert_eq!(found.len(), 120);
            let error = rms(&found, &test.labels);
            assert!(error < case.error, "{}: {error}", case.name);
            if validation.is_some() {
                let said = fit.choice.channels[0].rmse.expect("measured");
                assert!(said < 1.5 * case.error, "{}: {said}", case.name);
            }
        }
    }
}

#[test]
fn a_constant_label_is_predicted_exactly_and_named() {
    let mut training = recording(24, 1);
    let second = training.labels.iter_mut().skip(1).step_by(2);
    second.for_each(|label| *label = 0.1);
    for case in CASES.iter().filter(|case| !case.deeper) {
        for held in [None, Some(&training)] {
            let fit = case.fitted(&training, held);
            let found = predict(&fit.regressor, &recording(5, 7).features);
            let exact = |value: &f64| value.to_bits() == 0.1_f64.to_bits();
            assert!(found.iter().skip(1).step_by(2).all(exact), "{}", case.name);
            assert!(!fit.scaling.is_constant(0) && fit.scaling.is_constant(1));
        }
    }
}

#[test]
fn features_that_never_change_give_a_number() {
    let mut training = recording(24, 1);
    training.features = Features::new(SHAPE, vec![0.25; 24 * SHAPE.len()]).expect("whole");
    let (least, most) = training.labels.iter().step_by(2).fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(least, most), label| (least.min(*label), most.max(*label)),
    );
    for case in CASES.iter().filter(|case| case.error.is_finite()) {
        let fit = case.fitted(&training, None);
        let found = predict(&fit.regressor, &training.features)[0];
        assert!((least..=most).contains(&found), "{}: {found}", case.name);
    }
}

#[test]
fn as_many_samples_as_are_needed_are_enough_and_one_less_is_refused() {
    for case in CASES {
        case.fitted(&recording(case.least, 7), None);
        let said = case.refusal(&recording(case.least - 1, 7), None);
        let few = format!("{} training samples, ", case.least - 1);
        assert!(said.starts_with(&few), "{}: {said}", case.name);
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_where_they_stand() {
    let clean = recording(24, 8);
    let mut values = clean.features.values().to_vec();
    values[SHAPE.len() * 3 + 2] = f32::NAN;
    let broken = Recording {
        features: Features::new(SHAPE, values).expect("whole"),
        ..clean.clone()
    };
    let mut mislabelled = clean.clone();
    mislabelled.labels[2 * 5 + 1] = f64::INFINITY;
    for case in CASES {
        let said = case.refusal(&broken, None);
        assert_eq!(
            said, "training sample 3: feature 2 is not finite",
            "{}",
            case.name
        );
        let said = case.refusal(&clean, Some(&broken));
        assert_eq!(
            said, "validation sample 3: feature 2 is not finite",
            "{}",
            case.name
        );
        let said = case.refusal(&mislabelled, None);
        assert_eq!(
            said, "training sample 5: `Py` is not finite",
            "{}",
            case.name
        );
    }
}

#[test]
fn parts_that_do_not_fit_each_other_are_refused() {
    let training = recording(24, 9);
    let mut other = recording(24, 9);
    other.features = Features::new(FeatureShape::flat(20), vec![0.5; 480]).expect("whole");
    for case in CASES {
        let said = case.refusal(&training, Some(&other));
        let expected = "validation samples of 20 features, training samples of 480";
        assert_eq!(said, expected, "{}", case.name);
        let regressor = case.fitted(&training, None).regressor;
        let error = regressor
            .predict(&other.features, &mut [0.0; 48])
            .expect_err("shape");
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{}", case.name);
        let error = regressor
            .predict(&training.features, &mut [0.0; 6])
            .expect_err("buffer");
        assert_eq!(error.to_string(), "6 places for 24 samples of 2 channels");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (training, held, test) = (recording(80, 11), recording(30, 12), recording(70, 13));
    for case in CASES.iter().filter(|case| !case.deeper) {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().expect("threads").install(|| {
                let fit = case.fitted(&training, Some(&held));
                bits(&predict(&fit.regressor, &test.features))
            })
        };
        let alone = with(1);
        for threads in [2, 5] {
            assert!(with(threads) == alone, "{} with {threads}", case.name);
        }
    }
}

#[test]
fn a_sample_is_predicted_alone_as_among_others() {
    let (training, test) = (recording(40, 14), recording(33, 15));
    for case in CASES.iter().filter(|case| !case.deeper) {
        let regressor = case.fitted(&training, None).regressor;
        let together = predict(&regressor, &test.features);
        for (sample, expected) in together.chunks_exact(2).enumerate() {
            let alone = predict(&regressor, &test.features.select(&[sample]));
            assert_eq!(bits(&alone), bits(expected), "{} at {sample}", case.name);
        }
    }
}

#[test]
fn the_unit_of_labels_does_not_matter() {
    let (training, test) = (recording(60, 16), recording(20, 17));
    let mut larger = training.clone();
    // A power of two changes no digit on the way.
    larger.labels.iter_mut().for_each(|label| *label *= 1024.0);
    for case in CASES.iter().filter(|case| !case.deeper) {
        let small = predict(&case.fitted(&training, None).regressor, &test.features);
        let large = predict(&case.fitted(&larger, None).regressor, &test.features);
        let expected: Vec<f64> = small.iter().map(|value| value * 1024.0).collect();
        assert_eq!(bits(&large), bits(&expected), "{}", case.name);
    }
}

#[test]
fn the_order_of_training_samples_does_not_matter_where_nothing_is_drawn() {
    let (training, held, test) = (recording(80, 18), recording(30, 19), recording(40, 20));
    let rows: Vec<usize> = (0..80).map(|row| (row * 7 + 3) % 80).collect();
    let permuted = training.select(&rows);
    for case in CASES {
        let Some(tolerance) = case.order else {
            continue;
        };
        let expected = predict(
            &case.fitted(&training, Some(&held)).regressor,
            &test.features,
        );
        let found = predict(
            &case.fitted(&permuted, Some(&held)).regressor,
            &test.features,
        );
        let largest = expected
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        let pairs = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
        let moved = pairs.fold(0.0, f64::max) / largest;
        assert!(moved < tolerance, "{}: {moved}", case.name);
    }
}

#[test]
fn a_file_gives_the_same_model_and_the_same_bits() {
    let (training, test) = (recording(40, 21), recording(9, 22));
    for case in CASES {
        let components = case.components.then_some(Some(6));
        for pca in [None].into_iter().chain(components) {
            let model = case.model(&training, pca);
            let bytes = model.to_bytes().expect("small");
            let again = Model::from_bytes(&bytes)
                .unwrap_or_else(|error| panic!("{} {pca:?}: {error}", case.name));
            assert!(again == model, "{} {pca:?}", case.name);
            assert!(again.to_bytes().expect("small") == bytes, "{}", case.name);
            let found = |model: &Model| bits(&model.predict(&test.features).expect("finite"));
            assert_eq!(found(&again), found(&model), "{} {pca:?}", case.name);
            assert_eq!(model.reads_features(), case.name != "baseline");
        }
    }
}

#[test]
fn no_damaged_file_panics() {
    let (training, test) = (recording(12, 23), recording(2, 24));
    let mut next = numbers(11);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place below the bound"
    )]
    let mut below = |bound: usize| (next() * bound as f64) as usize;
    for case in CASES.iter().filter(|case| case.components) {
        let bytes = case.model(&training, Some(3)).to_bytes().expect("small");
        let header = usize::from(u16::from_le_bytes([bytes[0], bytes[1]])) + 8;
        for _ in 0..1_000 {
            let mut damaged = bytes.clone();
            for _ in 0..=below(3) {
                let within = if below(2) > 0 { header } else { bytes.len() };
                damaged[below(within)] = u8::try_from(below(256)).expect("a byte");
            }
            if let Ok(opened) = Model::from_bytes(&damaged) {
                // A number may have changed, but never so that predicting fails in any but the said way.
                if let Err(error) = opened.predict(&test.features) {
                    let said = [ErrorKind::OutOfRange, ErrorKind::InvalidArgument];
                    assert!(said.contains(&error.kind()), "{}: {error}", case.name);
                }
            }
        }
    }
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
    let training = recording(24, 25);
    for case in CASES.iter().filter(|case| case.name != "baseline") {
        for after in 0..2 {
            let progress = Cancel(after, AtomicUsize::new(0));
            let result = case.estimator().fit_model(&training.set(), None, &progress);
            let error = result
                .err()
                .unwrap_or_else(|| panic!("{} went on", case.name));
            assert_eq!(error.kind(), ErrorKind::Interrupted, "{}", case.name);
        }
    }
}

fn case_of(name: &str) -> &'static Case {
    let mut cases = CASES.iter();
    cases.find(|case| case.name == name).expect("listed")
}

#[test]
fn a_gaussian_process_knows_how_sure_it_is() {
    let (training, test) = (recording(200, 31), recording(200, 32));
    let regressor = case_of("gaussian-process")
        .fitted(&training, None)
        .regressor;
    let found = predict(&regressor, &test.features);
    let deviations = regressor.deviations(&test.features).expect("its shape");
    let deviations = deviations.expect("known");
    let errors = found.iter().zip(&test.labels).map(|(a, b)| (a - b).abs());
    let inside = errors
        .zip(&deviations)
        .filter(|(error, deviation)| *error < 1.96 * **deviation);
    let coverage = inside.count() as f64 / found.len() as f64;
    // 0.95 is nominal; its landmarks are all the samples there are.
    assert!((0.85..=1.0).contains(&coverage), "{coverage}");
    // A picture without any blob is like none that was learnt from.
    let empty = Features::new(SHAPE, vec![0.2; SHAPE.len()]).expect("one sample");
    let unsure = regressor
        .deviations(&empty)
        .expect("its shape")
        .expect("known");
    let mut sorted = deviations;
    sorted.sort_by(f64::total_cmp);
    assert!(unsure[0] > 2.0 * sorted[sorted.len() / 2], "{unsure:?}");
    let other = case_of("kernel-ridge").fitted(&training, None).regressor;
    assert!(other.deviations(&empty).expect("its shape").is_none());
}

#[test]
fn what_was_never_seen_is_not_extrapolated_beyond_the_bounds() {
    let training = recording(60, 33);
    let model = case_of("ridge").model(&training, None);
    let glaring = training.features.values().iter().map(|value| 50.0 * value);
    let glaring = Features::new(SHAPE, glaring.collect()).expect("whole samples");
    let found = model.predict(&glaring).expect("finite");
    let counts = model.bounded(&found);
    assert!(counts.iter().sum::<usize>() > 60, "{counts:?}");
    for (position, count) in counts.into_iter().enumerate() {
        let [least, greatest] = model.bounds(position).expect("a new model");
        let card = &model.card().channels[position];
        assert!((least - (card.minimum - 0.25 * card.span)).abs() < 1e-9);
        let own = found.iter().skip(position).step_by(2);
        let on_bound = own.filter(|value| **value <= least || **value >= greatest);
        assert_eq!(on_bound.count(), count);
    }
    let seen = model.predict(&training.features).expect("finite");
    assert_eq!(model.bounded(&seen), [0, 0]);
}

#[test]
fn a_choice_among_models_says_what_was_tried_and_keeps_the_one_it_took() {
    let training = recording(40, 34);
    let model = case_of("auto").model(&training, None);
    let card = model.card();
    let auto = card.auto.as_ref().expect("chosen");
    let best = auto.best().expect("tried");
    assert_eq!(
        (best.model.as_str(), card.model.as_str()),
        ("ridge", "ridge")
    );
    assert!(auto.tried.iter().any(|trial| trial.model == "baseline"));
    let unaffordable = auto
        .untried
        .iter()
        .find(|untried| untried.model == "resnet34");
    assert_eq!(unaffordable.expect("untried").reason, "beyond the budget");
    let said = auto.to_string();
    assert!(said.starts_with("auto took ridge: error 0."), "{said}");
    let alone = case_of("ridge").model(&training, None);
    assert_eq!(model.regressor(), alone.regressor());
}
