//! Time of fitting and predicting six channels, by samples × features.

use divan::Bencher;
use taceva_core::{
    Channel, Channels, FeatureShape, Features, Regressor, SilentProgress, Targets, TrainingSet,
};
use taceva_models::{LinearEstimator, ModelSettings, Ridge, find};

fn main() {
    divan::main();
}

const SHAPES: [(usize, usize); 3] = [(320, 1024), (3500, 1024), (1000, 3072)];

struct Recording {
    features: Features,
    channels: Channels,
    labels: Vec<f64>,
}

/// Sixty latent patterns plus noise, like pictures of a gel; fixed seed.
#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision"
)]
fn recording((samples, width): (usize, usize)) -> Recording {
    const PATTERNS: usize = 60;
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).expect("32 bits")) / 2_f64.powi(32) - 0.5
    };
    let patterns: Vec<f64> = (0..PATTERNS * width).map(|_| random()).collect();
    let map: Vec<f64> = (0..PATTERNS * 6).map(|_| random()).collect();
    let (mut values, mut labels) = (Vec::new(), Vec::new());
    for _ in 0..samples {
        let latent: Vec<f64> = (0..PATTERNS).map(|_| random()).collect();
        let along = |table: &[f64], columns: usize, column: usize| -> f64 {
            let entries = table.iter().skip(column).step_by(columns);
            entries
                .zip(&latent)
                .map(|(entry, latent)| entry * latent)
                .sum()
        };
        for feature in 0..width {
            values.push((0.5 + 0.05 * along(&patterns, width, feature)) as f32);
        }
        for channel in 0..6 {
            labels.push(along(&map, 6, channel));
        }
        values
            .iter_mut()
            .rev()
            .take(width)
            .for_each(|value| *value += 0.01 * random() as f32);
        labels
            .iter_mut()
            .rev()
            .take(6)
            .for_each(|label| *label += 0.1 * random());
    }
    Recording {
        features: Features::new(FeatureShape::flat(width), values).expect("whole samples"),
        channels: Channels::new(Channel::SIX).expect("distinct"),
        labels,
    }
}

impl Recording {
    fn set(&self) -> TrainingSet<'_> {
        TrainingSet::new(&self.features, Targets::new(&self.channels, &self.labels))
    }
}

/// Tries every strength on a validation part, then refits on both parts.
#[divan::bench(args = SHAPES, sample_count = 3)]
fn ridge(bencher: Bencher, shape: (usize, usize)) {
    fit(bencher, "ridge", shape);
}

/// Tries up to sixty directions on a validation part, then refits on both parts.
#[divan::bench(args = SHAPES, sample_count = 3)]
fn pls(bencher: Bencher, shape: (usize, usize)) {
    fit(bencher, "pls", shape);
}

fn fit(bencher: Bencher, name: &str, shape: (usize, usize)) {
    let (training, validation) = (recording(shape), recording((shape.0 / 4, shape.1)));
    let estimator = find(name)
        .expect("registered")
        .estimator(&ModelSettings::default())
        .expect("valid");
    bencher.bench_local(|| {
        estimator
            .fit_model(&training.set(), Some(&validation.set()), &SilentProgress)
            .expect("learnable")
    });
}

#[divan::bench(args = [1024, 3072])]
fn predict_one_sample(bencher: Bencher, width: usize) {
    let recording = recording((100, width));
    let estimator = Ridge::from_settings(&ModelSettings::default()).expect("defaults");
    let fit = estimator
        .fit_linear(&recording.set(), None, &SilentProgress)
        .expect("learnable");
    let mut into = vec![0.0; fit.regressor.channels().len()];
    bencher.bench_local(|| {
        fit.regressor
            .predict_one(divan::black_box(recording.features.sample(0)), &mut into)
    });
}
