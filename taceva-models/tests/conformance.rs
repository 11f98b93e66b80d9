//! What every estimator promises, and what each promises on top of that.

use std::sync::atomic::{AtomicUsize, Ordering};

use taceva_core::{
    Channel, Channels, ErrorKind, FeatureShape, Features, ModelError, Progress, Regressor, Silent,
    Targets, TrainingSet,
};
use taceva_models::{ALL, ChosenBy, LinearEstimator, LinearFit, Pca, Settings, find};

/// Reproducible numbers for tests: a linear congruential generator (Knuth's MMIX constants).
struct Numbers(u64);

impl Numbers {
    /// Evenly distributed in -0.5..0.5.
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let high = u32::try_from(self.0 >> 32).expect("32 bits");
        f64::from(high) / 2_f64.powi(32) - 0.5
    }
}

/// Samples whose labels are linear in their features, with a little noise.
#[derive(Clone)]
struct Recording {
    features: Features,
    channels: Channels,
    labels: Vec<f64>,
    groups: Vec<u32>,
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision"
)]
fn recording(samples: usize, width: usize, noise: f64, seed: u64) -> Recording {
    let mut map = Numbers(42);
    let weights: Vec<f64> = (0..3 * width).map(|_| map.next()).collect();
    let mut numbers = Numbers(seed);
    let values: Vec<f32> = (0..samples * width)
        .map(|_| (0.5 + numbers.next()) as f32)
        .collect();
    let features = Features::new(FeatureShape::flat(width), values).expect("whole samples");
    let mut labels = Vec::new();
    for sample in 0..samples {
        for row in weights.chunks_exact(width) {
            let seen = features.sample(sample).iter().zip(row);
            let clean: f64 = seen.map(|(&value, weight)| f64::from(value) * weight).sum();
            labels.push(2.0 + clean + noise * numbers.next());
        }
    }
    Recording {
        features,
        channels: Channels::new([Channel::FX, Channel::FY, Channel::FZ]).expect("distinct"),
        labels,
        groups: (0..samples)
            .map(|sample| u32::try_from(sample * 5 / samples).expect("below 5"))
            .collect(),
    }
}

impl Recording {
    fn set(&self) -> TrainingSet<'_> {
        TrainingSet {
            features: &self.features,
            targets: Targets {
                channels: &self.channels,
                values: &self.labels,
            },
            groups: None,
        }
    }

    fn grouped(&self) -> TrainingSet<'_> {
        TrainingSet {
            groups: Some(&self.groups),
            ..self.set()
        }
    }

    fn select(&self, rows: &[usize]) -> Recording {
        Recording {
            features: self.features.select(rows),
            channels: self.channels.clone(),
            labels: rows
                .iter()
                .flat_map(|&row| self.labels[row * 3..row * 3 + 3].to_vec())
                .collect(),
            groups: rows.iter().map(|&row| self.groups[row]).collect(),
        }
    }
}

fn model(name: &str, words: &[&str]) -> Box<dyn LinearEstimator> {
    let settings = Settings::parse(words.iter().copied()).expect("well formed");
    find(name)
        .expect("registered")
        .estimator(&settings)
        .expect("valid settings")
}

fn every_model() -> impl Iterator<Item = Box<dyn LinearEstimator>> {
    ALL.iter().map(|info| model(info.name, &[]))
}

fn fit(estimator: &dyn LinearEstimator, set: &TrainingSet<'_>) -> LinearFit {
    estimator
        .fit_linear(set, None, &Silent)
        .unwrap_or_else(|error| panic!("{}: {error}", estimator.name()))
}

fn predict(regressor: &dyn Regressor, features: &Features) -> Vec<f64> {
    let mut into = vec![0.0; features.samples() * regressor.channels().len()];
    regressor.predict(features, &mut into).expect("finite");
    into
}

fn refusal(result: Result<LinearFit, ModelError>, name: &str) -> String {
    match result {
        Ok(_) => panic!("{name} accepted what it should refuse"),
        Err(error) => error.to_string(),
    }
}

/// Largest difference, relative to the largest expected number.
fn distance(found: &[f64], expected: &[f64]) -> f64 {
    let largest = expected
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let difference = |(a, b): (&f64, &f64)| (a - b).abs();
    found
        .iter()
        .zip(expected)
        .map(difference)
        .fold(0.0, f64::max)
        / largest
}

/// Wide (fewer samples than features) and tall, because the two take different ways.
fn both_shapes(noise: f64) -> [Recording; 2] {
    [recording(60, 90, noise, 1), recording(300, 40, noise, 2)]
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
            // The noise alone has a standard deviation of 0.02 / √12 = 0.0058; the labels one of about 0.5.
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
        let result = estimator.fit_linear(&recording.set(), None, &Silent);
        assert_eq!(
            refusal(result, estimator.name()),
            "1 training samples, at least 2 are needed"
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
        let result = estimator.fit_linear(&broken.set(), None, &Silent);
        assert_eq!(
            refusal(result, estimator.name()),
            "training sample 3: feature 2 is not finite"
        );
        let result = estimator.fit_linear(&clean.set(), Some(&broken.set()), &Silent);
        assert_eq!(
            refusal(result, estimator.name()),
            "validation sample 3: feature 2 is not finite"
        );
        let mut broken = clean.clone();
        broken.labels[3 * 5 + 1] = f64::INFINITY;
        let result = estimator.fit_linear(&broken.set(), None, &Silent);
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
        let result = estimator.fit_linear(&training.set(), Some(&other_width.set()), &Silent);
        assert_eq!(
            refusal(result, estimator.name()),
            "validation samples of 5 features, training samples of 4"
        );
        let short = TrainingSet {
            groups: Some(&training.groups[1..]),
            ..training.set()
        };
        let result = estimator.fit_linear(&short, None, &Silent);
        assert_eq!(
            refusal(result, estimator.name()),
            "19 groups for 20 training samples"
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
        assert_eq!(error.to_string(), "6 places for 20 samples of 3 channels");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    // Larger than a block and a slab, so that there is work to share.
    for recording in [recording(300, 1100, 0.1, 11), recording(1100, 300, 0.1, 12)] {
        for estimator in every_model() {
            for set in [recording.set(), recording.grouped()] {
                let with = |threads: usize| {
                    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
                    let fit = || {
                        let fit = fit(&*estimator, &set);
                        let found = predict(&fit.regressor, &recording.features);
                        let weights = fit.regressor.weights().iter();
                        weights
                            .chain(&found)
                            .map(|value| value.to_bits())
                            .collect::<Vec<_>>()
                    };
                    pool.build().expect("threads").install(fit)
                };
                assert_eq!(with(1), with(2), "{}", estimator.name());
                assert_eq!(with(1), with(5), "{}", estimator.name());
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

/// Cancels after some questions.
struct Cancel {
    after: usize,
    asked: AtomicUsize,
}

impl Progress for Cancel {
    fn begin(&self, _stage: &str, _steps: Option<u64>) {}
    fn advance(&self, _steps: u64) {}
    fn end(&self) {}
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
        // Of a scale that does not depend on the part, and a penalty that does not: components have none.
        let words = ["components=5", "scale=none"];
        let estimator = model("pls", &words);
        let refitted = estimator
            .fit_linear(&first.set(), Some(&last.set()), &Silent)
            .expect("fits");
        assert!(refitted.refitted);
        let mut spans_of_first = recording.clone();
        // Label ranges come from the training part; with ranges alike in all channels they cannot matter.
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
            .fit_linear(&first.set(), Some(&last.set()), &Silent)
            .expect("fits");
        let expected = predict(&both.regressor, &recording.features);
        let found = predict(&refitted.regressor, &recording.features);
        assert!(distance(&found, &expected) < 1e-9);
    }
}

#[test]
fn an_endless_penalty_leaves_the_mean() {
    for recording in both_shapes(0.1) {
        let ridge = fit(&*model("ridge", &["strength=1e12"]), &recording.set());
        let baseline = fit(&*model("baseline", &[]), &recording.set());
        let expected = predict(&baseline.regressor, &recording.features);
        let found = predict(&ridge.regressor, &recording.features);
        assert!(distance(&found, &expected) < 1e-9);
    }
}

#[test]
fn ridge_solves_the_normal_equations() {
    for recording in both_shapes(0.1) {
        let words = ["strength=0.03", "scale=none"];
        let fit = fit(&*model("ridge", &words), &recording.set());
        let (samples, width) = (
            recording.features.samples(),
            recording.features.shape().len(),
        );
        let mean = |feature: usize| {
            let values = (0..samples).map(|row| f64::from(recording.features.sample(row)[feature]));
            values.sum::<f64>() / samples as f64
        };
        let means: Vec<f64> = (0..width).map(mean).collect();
        let centred = |row: usize, feature: usize| {
            f64::from(recording.features.sample(row)[feature]) - means[feature]
        };
        let trace: f64 = (0..samples)
            .flat_map(|row| (0..width).map(move |feature| (row, feature)))
            .map(|(row, feature)| centred(row, feature).powi(2))
            .sum();
        let penalty = 0.03 * trace / samples.min(width) as f64;
        let predictions = predict(&fit.regressor, &recording.features);
        // Xᵀ(y − Xw − b) = λw, and the residuals sum to 0.
        for channel in 0..3 {
            let residual =
                |row: usize| recording.labels[row * 3 + channel] - predictions[row * 3 + channel];
            let total: f64 = (0..samples).map(residual).sum();
            assert!(total.abs() < 1e-9, "{total}");
            for feature in 0..width {
                let left: f64 = (0..samples)
                    .map(|row| centred(row, feature) * residual(row))
                    .sum();
                let right = penalty * fit.regressor.weights()[channel * width + feature];
                assert!((left - right).abs() < 1e-9, "{left} for {right}");
            }
        }
    }
}

#[test]
fn leaving_groups_out_equals_fitting_without_them() {
    for recording in both_shapes(0.3) {
        for grouped in [true, false] {
            let set = if grouped {
                recording.grouped()
            } else {
                recording.set()
            };
            let chosen = fit(&*model("ridge", &["scale=none"]), &set);
            let samples = recording.features.samples();
            let groups: Vec<Vec<usize>> = if grouped {
                let rows = |group| {
                    (0..samples)
                        .filter(|&row| recording.groups[row] == group)
                        .collect()
                };
                (0..5).map(rows).collect()
            } else {
                (0..samples).map(|row| vec![row]).collect()
            };
            let by = if grouped {
                ChosenBy::LeaveOneGroupOut
            } else {
                ChosenBy::LeaveOneOut
            };
            assert_eq!(chosen.choice.by, by);
            for (channel, choice) in chosen.choice.channels.iter().enumerate() {
                let strength = choice.value.expect("chosen");
                let squares: f64 = groups
                    .iter()
                    .map(|group| without(&recording, group, strength, channel))
                    .sum();
                let expected = (squares / samples as f64).sqrt();
                let found = choice.rmse.expect("known");
                assert!(
                    (found / expected - 1.0).abs() < 1e-9,
                    "{found} for {expected} at {strength}, {samples} samples, grouped {grouped}"
                );
            }
        }
    }
}

/// The squared error on `group` of a ridge regression that never saw it, at the penalty of all samples.
fn without(recording: &Recording, group: &[usize], strength: f64, channel: usize) -> f64 {
    let samples = recording.features.samples();
    let others: Vec<usize> = (0..samples).filter(|row| !group.contains(row)).collect();
    let rest = recording.select(&others);
    // The penalty is relative to the mean eigenvalue of the part: make it the same in absolute terms.
    let relative = strength * mean_eigenvalue(recording) / mean_eigenvalue(&rest);
    let words = [format!("strength={relative:e}"), "scale=none".to_owned()];
    let estimator = model("ridge", &[words[0].as_str(), words[1].as_str()]);
    let found = predict(
        &fit(&*estimator, &rest.set()).regressor,
        &recording.features,
    );
    let error =
        |&row: &usize| (found[row * 3 + channel] - recording.labels[row * 3 + channel]).powi(2);
    group.iter().map(error).sum()
}

fn mean_eigenvalue(recording: &Recording) -> f64 {
    let (samples, width) = (
        recording.features.samples(),
        recording.features.shape().len(),
    );
    let mut trace = 0.0;
    for feature in 0..width {
        let column = || (0..samples).map(|row| f64::from(recording.features.sample(row)[feature]));
        let mean = column().sum::<f64>() / samples as f64;
        trace += column().map(|value| (value - mean).powi(2)).sum::<f64>();
    }
    trace / samples.min(width) as f64
}

#[test]
fn all_directions_of_pls_give_least_squares() {
    let recording = recording(120, 12, 0.3, 14);
    let pls = fit(&*model("pls", &["components=12"]), &recording.set());
    assert_eq!(pls.choice.channels[0].value, Some(12.0));
    let ridge = fit(&*model("ridge", &["strength=1e-12"]), &recording.set());
    let expected = predict(&ridge.regressor, &recording.features);
    let found = predict(&pls.regressor, &recording.features);
    assert!(distance(&found, &expected) < 1e-9);
}

#[test]
fn the_first_direction_of_pls_is_that_of_the_covariance() {
    let mut recording = recording(50, 6, 0.3, 15);
    recording.labels = recording
        .labels
        .iter()
        .step_by(3)
        .flat_map(|l| [*l; 3])
        .collect();
    let fit = fit(
        &*model("pls", &["components=1", "scale=none"]),
        &recording.set(),
    );
    let mean = recording.labels.iter().sum::<f64>() / 150.0;
    let covariance: Vec<f64> = (0..6)
        .map(|feature| {
            let value = |row: usize| f64::from(recording.features.sample(row)[feature]);
            (0..50)
                .map(|row| value(row) * (recording.labels[row * 3] - mean))
                .sum()
        })
        .collect();
    let weights = &fit.regressor.weights()[..6];
    let ratio = weights[0] / covariance[0];
    let expected: Vec<f64> = covariance.iter().map(|value| value * ratio).collect();
    assert!(distance(weights, &expected) < 1e-9);
}

#[test]
fn principal_components_are_orthonormal_and_keep_all_distances() {
    for recording in both_shapes(0.1) {
        let (samples, width) = (
            recording.features.samples(),
            recording.features.shape().len(),
        );
        let rank = (samples - 1).min(width);
        let pca = Pca::fit(&recording.features, rank, &Silent).expect("as many directions");
        let components: Vec<&[f64]> = pca.components().collect();
        for (position, first) in components.iter().enumerate() {
            for (other, second) in components.iter().enumerate() {
                let product: f64 = first.iter().zip(*second).map(|(a, b)| a * b).sum();
                let expected = f64::from(u8::from(position == other));
                assert!(
                    (product - expected).abs() < 1e-12,
                    "{position} {other}: {product}"
                );
            }
        }
        let ratio = pca.variance_ratio();
        assert!(ratio.windows(2).all(|pair| pair[0] >= pair[1]));
        assert!((ratio.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        let reduced = pca.transform(&recording.features).expect("same shape");
        let distance = |features: &Features| -> f64 {
            let pairs = features.sample(0).iter().zip(features.sample(1));
            pairs
                .map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2))
                .sum()
        };
        // Coordinates are rounded to f32.
        assert!((distance(&reduced) / distance(&recording.features) - 1.0).abs() < 1e-5);
        let error = Pca::fit(&recording.features, rank + 1, &Silent).expect_err("too many");
        assert_eq!(
            error.to_string(),
            format!(
                "`pca={}`: {samples} training samples vary in {rank} directions",
                rank + 1
            )
        );
    }
}
