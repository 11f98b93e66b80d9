//! Recordings from a known linear map, and helpers of both suites.

use taceva_core::{
    Channel, Channels, FeatureShape, Features, Regressor, SilentProgress, Targets, TrainingSet,
};
use taceva_models::{Baseline, LinearEstimator, LinearFit, ModelSettings, Pls, Ridge};

/// Reproducible test numbers: a linear congruential generator (Knuth's MMIX constants).
struct Numbers(u64);

impl Numbers {
    /// Number that is uniformly distributed in -0.5..0.5.
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
pub(crate) struct Recording {
    pub(crate) features: Features,
    pub(crate) channels: Channels,
    pub(crate) labels: Vec<f64>,
    pub(crate) groups: Vec<u32>,
}

/// Draws samples × features. The map is always the same; the seed determines features and noise.
#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision"
)]
pub(crate) fn recording(samples: usize, width: usize, noise: f64, seed: u64) -> Recording {
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
    pub(crate) fn set(&self) -> TrainingSet<'_> {
        TrainingSet::new(&self.features, Targets::new(&self.channels, &self.labels))
    }

    pub(crate) fn grouped(&self) -> TrainingSet<'_> {
        self.set().with_groups(&self.groups[..])
    }

    pub(crate) fn select(&self, rows: &[usize]) -> Recording {
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

/// Linear model with the name `name` and the settings `words`.
pub(crate) fn model(name: &str, words: &[&str]) -> Box<dyn LinearEstimator> {
    let settings = ModelSettings::parse(words.iter().copied()).expect("well formed");
    let valid = "valid settings";
    match name {
        "baseline" => Box::new(Baseline::from_settings(&settings).expect(valid)),
        "ridge" => Box::new(Ridge::from_settings(&settings).expect(valid)),
        "pls" => Box::new(Pls::from_settings(&settings).expect(valid)),
        _ => panic!("{name} is not a linear model"),
    }
}

/// Fits without a validation part.
pub(crate) fn fit(estimator: &dyn LinearEstimator, set: &TrainingSet<'_>) -> LinearFit {
    estimator
        .fit_linear(set, None, &SilentProgress)
        .unwrap_or_else(|error| panic!("{}: {error}", estimator.name()))
}

/// Predictions of every sample.
pub(crate) fn predict(regressor: &dyn Regressor, features: &Features) -> Vec<f64> {
    let mut into = vec![0.0; features.samples() * regressor.channels().len()];
    regressor.predict(features, &mut into).expect("finite");
    into
}

/// Largest difference between two lists, relative to the largest expected number.
pub(crate) fn distance(found: &[f64], expected: &[f64]) -> f64 {
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

/// A wide (fewer samples than features) and a tall recording, which are computed differently.
pub(crate) fn both_shapes(noise: f64) -> [Recording; 2] {
    [recording(60, 90, noise, 1), recording(300, 40, noise, 2)]
}
