//! Guarantees of every linear estimator.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::linear_recordings::{Recording, both_shapes, distance, fit, model, predict, recording};
use taceva_core::{
    ErrorKind, FeatureShape, Features, ModelError, Progress, Regressor, SilentProgress,
};
use taceva_models::{LinearEstimator, LinearFit};

/// Names of the linear models.
const LINEAR: [&str; 3] = ["baseline", "ridge", "pls"];

fn every_model() -> impl Iterator<Item = Box<dyn LinearEstimator>> {
    LINEAR.into_iter().map(|name| model(name, &[]))
}

fn refusal(result: Result<LinearFit, ModelError>, name: &str) -> String {
    match result {
        Ok(_) => panic!("{name} accepted what it should refuse"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_linear_map_with_noise_is_recovered_by_all_but_the_baseline() {
    for recording in [recording(400, 40, 0.02, 3), recording(200, 30, 0.02, 4)] {
        let rows: Vec<usize> = (0..recording.features.samples()).collect();
        let (training, test) = rows.split_at(rows.len() - 50);
        let (training, test) = (recording.select(training), recording.select(test));
        for estimator in every_model().filter(|estimator| estimator.name() != "baseline") {
            let fit = fit(&*estimator, &training.set());
            let found = predict(&fit.regressor, &test.features);
            let errors = found.iter().zip(&test.labels).map(|(a, b)| (a - b).powi(2));
            let rms = (errors.sum::<f64>() / found.len() as f64).sqrt();
            // The noise has a standard deviation of 0.02 / √12 = 0.0058, the labels about 0.5.
            assert!(rms < 0.008, "{}: {rms}", estimator.name());
        }
    }
}

#[test]
fn the_baseline_is_the_mean() {
    let recording = recording(50, 8, 0.1, 5);
    let fit = fit(&*model("baseline", &[]), &recording.set());
    for (channel, bias) in fit.regressor.bias().iter().enumerate() {
        let labels = recording.labels.iter().skip(channel).step_by(3);
        let mean = labels.sum::<f64>() / 50.0;
        assert!((bias - mean).abs() < 1e-12);
    }
    assert!(fit.regressor.weights().iter().all(|weight| *weight == 0.0));
}

#[test]
fn a_constant_label_is_predicted_exactly_and_named() {
    for mut recording in both_shapes(0.1) {
        recording
            .labels
            .iter_mut()
            .skip(1)
            .step_by(3)
            .for_each(|label| *label = 0.1);
        for estimator in every_model() {
            for set in [recording.set(), recording.grouped()] {
                let fit = fit(&*estimator, &set);
                let found = predict(&fit.regressor, &recording.features);
                assert!(
                    found
                        .iter()
                        .skip(1)
                        .step_by(3)
                        .all(|value| value.to_bits() == 0.1_f64.to_bits()),
                    "{}",
                    estimator.name()
                );
                let constant: Vec<bool> = (0..3).map(|c| fit.scaling.is_constant(c)).collect();
                assert_eq!(constant, [false, true, false]);
            }
        }
    }
}

#[test]
fn features_that_never_change_give_the_mean() {
    let mut recording = recording(20, 6, 0.1, 6);
    recording.features = Features::new(FeatureShape::flat(6), vec![0.25; 120]).expect("whole");
    for estimator in every_model() {
        let fit = fit(&*estimator, &recording.set());
        let mean = recording.labels.iter().step_by(3).sum::<f64>() / 20.0;
        let found = predict(&fit.regressor, &recording.features)[0];
        assert!((found - mean).abs() < 1e-12, "{}", estimator.name());
    }
}

#[test]
fn too_few_samples_are_refused() {
    let recording = recording(1, 4, 0.1, 7);
    for estimator in every_model() {
        let result = estimator.fit_linear(&recording.set(), None, &SilentProgress);
        assert_eq!(
            refusal(result, estimator.name()),
            "1 training sample, at least 2 are needed"
        );
    }
}

#[test]
fn two_samples_are_enough() {
    let recording = recording(2, 4, 0.1, 7);
    for estimator in every_model() {
        fit(&*estimator, &recording.set());
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_where_they_stand() {
    let clean = recording(20, 4, 0.1, 8);
    for estimator in every_model() {
        let mut values = clean.features.values().to_vec();
        values[4 * 3 + 2] = f32::NAN;
        let broken = Recording {
            features: Features::new(clean.features.shape(), values).expect("whole"),
            ..clean.clone()
        };
        let result = estimator.fit_linear(&broken.set(), None, &SilentProgress);
        assert_eq!(
            refusal(result, estimator.name()),
            "training sample 3: feature 2 is not finite"
        );
        let result = estimator.fit_linear(&clean.set(), Some(&broken.set()), &SilentProgress);
        assert_eq!(
            refusal(result, estimator.name()),
            "validation sample 3: feature 2 is not finite"
        );
        let mut broken = clean.clone();
        broken.labels[3 * 5 + 1] = f64::INFINITY;
        let result = estimator.fit_linear(&broken.set(), None, &SilentProgress);
        assert_eq!(
            refusal(result, estimator.name()),
            "training sample 5: `Fy` is not finite"
        );
    }
}

#[test]
fn parts_that_do_not_fit_each_other_are_refused() {
    let training = recording(20, 4, 0.1, 9);
    let other_width = recording(20, 5, 0.1, 9);
    for estimator in every_model() {
        let result =
            estimator.fit_linear(&training.set(), Some(&other_width.set()), &SilentProgress);
        assert_eq!(
            refusal(result, estimator.name()),
            "validation samples of 5 features, expected 4 as in training"
        );
        let short = training.set().with_groups(&training.groups[1..]);
        let result = estimator.fit_linear(&short, None, &SilentProgress);
        assert_eq!(
            refusal(result, estimator.name()),
            "19 groups for 20 training samples, expected a group for each sample"
        );
    }
}

#[test]
fn predicting_another_shape_is_an_error() {
    let recording = recording(20, 4, 0.1, 10);
    let other = Features::new(FeatureShape::flat(5), vec![0.0; 10]).expect("whole");
    for estimator in every_model() {
        let regressor = fit(&*estimator, &recording.set()).regressor;
        let error = regressor.predict(&other, &mut [0.0; 6]).expect_err("shape");
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        let error = regressor
            .predict(&recording.features, &mut [0.0; 6])
            .expect_err("buffer");
        assert_eq!(
            error.to_string(),
            "a buffer of 6 values, expected 20 samples × 3 channels"
        );
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    // Larger than a block and a slab, so that threads share the work.
    let (wide, tall) = (recording(280, 1040, 0.1, 11), recording(1040, 280, 0.1, 12));
    for (recording, set) in [(&wide, wide.grouped()), (&tall, tall.set())] {
        for estimator in every_model() {
            let with = |threads: usize| -> Vec<u64> {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
                pool.build().expect("threads").install(|| {
                    let fit = fit(&*estimator, &set);
                    let found = predict(&fit.regressor, &recording.features);
                    let numbers = fit.regressor.weights().iter().chain(&found);
                    numbers.map(|value| value.to_bits()).collect()
                })
            };
            let alone = with(1);
            for threads in [2, 5] {
                assert!(
                    with(threads) == alone,
                    "{} with {threads}",
                    estimator.name()
                );
            }
        }
    }
}

#[test]
fn the_unit_of_labels_does_not_matter() {
    for recording in both_shapes(0.1) {
        let mut scaled = recording.clone();
        scaled.labels.iter_mut().for_each(|label| *label *= 1000.0);
        for estimator in every_model() {
            let small = fit(&*estimator, &recording.grouped());
            let large = fit(&*estimator, &scaled.grouped());
            let expected: Vec<f64> = predict(&small.regressor, &recording.features)
                .into_iter()
                .map(|value| value * 1000.0)
                .collect();
            let found = predict(&large.regressor, &recording.features);
            assert!(distance(&found, &expected) < 1e-9, "{}", estimator.name());
        }
    }
}

#[test]
fn the_order_of_training_samples_does_not_matter() {
    for recording in both_shapes(0.1) {
        let samples = recording.features.samples();
        let rows: Vec<usize> = (0..samples).map(|row| (row * 7 + 3) % samples).collect();
        let mut sorted = rows.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..samples), "a permutation");
        let permuted = recording.select(&rows);
        for estimator in every_model() {
            let first = fit(&*estimator, &recording.grouped());
            let second = fit(&*estimator, &permuted.grouped());
            let expected = predict(&first.regressor, &recording.features);
            let found = predict(&second.regressor, &recording.features);
            assert!(distance(&found, &expected) < 1e-9, "{}", estimator.name());
        }
    }
}

/// Progress receiver that cancels after a number of progress queries.
struct Cancel {
    after: usize,
    asked: AtomicUsize,
}

impl Progress for Cancel {
    fn is_cancelled(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.after
    }
}

#[test]
fn a_cancelled_fit_stops_with_an_error() {
    let recording = recording(60, 90, 0.1, 13);
    for estimator in every_model().filter(|estimator| estimator.name() != "baseline") {
        for after in 0..3 {
            let progress = Cancel {
                after,
                asked: AtomicUsize::new(0),
            };
            let error = estimator
                .fit_linear(&recording.grouped(), None, &progress)
                .err()
                .unwrap_or_else(|| panic!("{} went on", estimator.name()));
            assert_eq!(error.kind(), ErrorKind::Interrupted);
        }
    }
}

#[test]
fn learning_from_validation_too_equals_learning_from_both_at_once() {
    for recording in both_shapes(0.1) {
        let rows: Vec<usize> = (0..recording.features.samples()).collect();
        let (first, last) = rows.split_at(rows.len() / 2);
        let (first, last) = (recording.select(first), recording.select(last));
        // Components have no penalty, and here no scale, so neither depends on the part.
        let words = ["components=5", "scale=none"];
        let estimator = model("pls", &words);
        let refitted = estimator
            .fit_linear(&first.set(), Some(&last.set()), &SilentProgress)
            .expect("fits");
        assert!(refitted.refitted);
        let mut spans_of_first = recording.clone();
        // Label ranges come from the training part. With equal ranges in all channels they have no effect.
        spans_of_first.labels = recording
            .labels
            .iter()
            .step_by(3)
            .flat_map(|l| [*l; 3])
            .collect();
        let both = fit(&*estimator, &spans_of_first.set());
        let first = spans_of_first.select(&rows[..rows.len() / 2]);
        let last = spans_of_first.select(&rows[rows.len() / 2..]);
        let refitted = estimator
            .fit_linear(&first.set(), Some(&last.set()), &SilentProgress)
            .expect("fits");
        let expected = predict(&both.regressor, &recording.features);
        let found = predict(&refitted.regressor, &recording.features);
        assert!(distance(&found, &expected) < 1e-9);
    }
}

#[test]
fn without_a_penalty_an_exact_map_is_found_to_the_last_digits_or_refused() {
    let exact = recording(60, 8, 0.0, 14);
    let fit = fit(&*model("ridge", &["strength=0"]), &exact.set());
    let found = predict(&fit.regressor, &exact.features);
    assert!(distance(&found, &exact.labels) < 1e-14);
    let penalised =
        crate::linear_recordings::fit(&*model("ridge", &["strength=1e-12"]), &exact.set());
    let found = predict(&penalised.regressor, &exact.features);
    assert!(distance(&found, &exact.labels) < 1e-9);
    let few = recording(6, 8, 0.0, 14);
    let result = model("ridge", &["strength=0"]).fit_linear(&few.set(), None, &SilentProgress);
    let said = refusal(result, "ridge");
    assert!(
        said.starts_with("6 samples for 8 weights: least squares"),
        "{said}"
    );
}
