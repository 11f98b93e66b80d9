//! Guarantees of single models beyond those of every estimator.

use crate::linear_recordings::{Recording, both_shapes, distance, fit, model, predict, recording};
use taceva_core::{Features, SilentProgress};
use taceva_models::{ChosenBy, Pca};

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

/// Squared error on `group` of a ridge regression fitted without it, at the penalty of all samples.
fn without(recording: &Recording, group: &[usize], strength: f64, channel: usize) -> f64 {
    let samples = recording.features.samples();
    let others: Vec<usize> = (0..samples).filter(|row| !group.contains(row)).collect();
    let rest = recording.select(&others);
    // The penalty is relative to the mean eigenvalue of the part; this keeps its absolute value.
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
fn ridge_refitted_keeps_its_penalty() {
    for recording in both_shapes(0.1) {
        let rows: Vec<usize> = (0..recording.features.samples()).collect();
        let (first, last) = rows.split_at(rows.len() / 2);
        let (first, last) = (recording.select(first), recording.select(last));
        let refitted = model("ridge", &["strength=0.1", "scale=none"])
            .fit_linear(&first.set(), Some(&last.set()), &SilentProgress)
            .expect("fits");
        assert!(refitted.refitted);
        let same = 0.1 * mean_eigenvalue(&first) / mean_eigenvalue(&recording);
        let words = format!("strength={same:e}");
        let both = fit(&*model("ridge", &[&words, "scale=none"]), &recording.set());
        let expected = predict(&both.regressor, &recording.features);
        let found = predict(&refitted.regressor, &recording.features);
        assert!(distance(&found, &expected) < 1e-9);
    }
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
        let pca = Pca::fit(&recording.features, rank, &SilentProgress).expect("as many directions");
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
        let error = Pca::fit(&recording.features, rank + 1, &SilentProgress).expect_err("too many");
        assert_eq!(
            error.to_string(),
            format!(
                "`pca={}`: {samples} training samples vary in {rank} directions",
                rank + 1
            )
        );
    }
}
