//! What trying a model takes, from the sizes of a recording alone.

use super::validate::FOLDS;

/// The sizes of a training part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    pub(super) samples: f64,
    pub(super) features: f64,
    pub(super) channels: f64,
    pub(super) is_picture: bool,
}

/// How many multiplications a second of the budget stands for.
const RATE: f64 = 1e9;

/// The seconds of the budget that trying the model called `name` takes; `None` where it cannot be tried.
///
/// Leading terms of what the fits with default settings do, at five folds of which four are used each time.
pub(super) fn seconds(name: &str, sizes: Sizes) -> Option<f64> {
    let Sizes {
        features,
        channels,
        is_picture,
        ..
    } = sizes;
    let samples = 0.8 * sizes.samples;
    let gram = |samples: f64, features: f64| {
        let (small, large) = (samples.min(features), samples.max(features));
        // Products run at several multiplications at once; the spectrum costs about nine times its cube.
        0.25 * small * small * large + 9.0 * small.powi(3)
    };
    let landmarks = samples.min(500.0);
    let kernel = 2.0 * samples * landmarks * features
        + 6.0 * (samples * landmarks * landmarks + gram(samples, landmarks));
    let picture = |per_pixel: f64, epochs: f64| {
        is_picture.then_some(3.0 * epochs * samples * features * per_pixel / 20.0)
    };
    let work = match name {
        "baseline" => samples * features,
        "ridge" => 2.0 * gram(samples, features),
        "pls" => 4.0 * 60.0 * samples * features,
        "elastic-net" => {
            0.5 * samples * features * features + 50.0 * 100.0 * channels * features * features
        }
        "kernel-ridge" => kernel,
        "gaussian-process" => 1.5 * kernel,
        "knn" => samples * samples * features,
        "lda" => channels * (0.5 * samples * features * features + 9.0 * features.powi(3)),
        "random-forest" => {
            100.0 * channels * 0.3 * features * samples * samples.log2().max(1.0) * 2.0
        }
        "gradient-boosting" => {
            2.0 * 300.0 * channels * 0.1 * features * (5.0 * samples + 32.0 * 256.0)
        }
        "cnn" => picture(2_500.0, 200.0)?,
        "resnet10" => picture(40_000.0, 60.0)?,
        "resnet18" => picture(70_000.0, 60.0)?,
        "resnet34" => picture(140_000.0, 60.0)?,
        _ => return None,
    };
    Some(trying(work))
}

/// The seconds of the budget that trying a model takes, one fit of which takes `work` multiplications.
pub(super) fn trying(work: f64) -> f64 {
    FOLDS as f64 * work / RATE
}
