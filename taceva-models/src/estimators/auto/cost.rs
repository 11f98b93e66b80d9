//! Estimated work of trials and fits of a model, from the numbers of samples, features and channels only.

use crate::estimators::library::LibrarySizes;
use taceva_core::whole_size;

/// Numbers of samples, features and channels of a training part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    pub(super) samples: f64,
    pub(super) features: f64,
    /// Number of values per picture for networks; `None` without pictures.
    pub(super) picture: Option<f64>,
    pub(super) channels: f64,
}

impl Sizes {
    /// Sizes of a part that contains the fraction `share` of the samples.
    pub(super) fn share(self, share: f64) -> Sizes {
        Sizes {
            samples: share * self.samples,
            ..self
        }
    }

    pub(super) fn of_library(self) -> LibrarySizes {
        LibrarySizes {
            samples: whole_size(self.samples),
            features: whole_size(self.features),
            targets: whole_size(self.channels),
        }
    }
}

/// Number of multiplications that count as one second of work.
const RATE: f64 = 1e9;

/// Name of the small network; `DEEPER` names the residual networks.
pub(super) const NETWORK: &str = "cnn";
pub(super) const DEEPER: [&str; 3] = ["resnet10", "resnet18", "resnet34"];

/// Converts a number of multiplications to seconds of work.
pub(super) fn seconds(work: f64) -> f64 {
    work / RATE
}

/// Number of multiplications of one fit of the model `name` with default settings; `None` if the model cannot be fitted.
///
/// Each estimate is the leading term of the work, with a measured factor. One second of work takes about one processor second (docs/models.md).
pub(super) fn work(name: &str, sizes: Sizes) -> Option<f64> {
    let Sizes {
        samples,
        features,
        picture,
        channels,
    } = sizes;
    let gram = |samples: f64, features: f64| {
        let (small, large) = (samples.min(features), samples.max(features));
        0.1 * small * small * large + 0.4 * small.powi(3)
    };
    let landmarks = samples.min(500.0);
    let kernel = 0.4 * samples * landmarks * features
        + 1.2 * (samples * landmarks * landmarks + gram(samples, landmarks));
    // Each sample once per epoch, forward and backward.
    let network = |a_place: f64, epochs: f64| Some(epochs * samples * picture? * a_place);
    Some(match name {
        "baseline" => samples * features,
        "ridge" => 2.0 * gram(samples, features),
        "pls" => 4.0 * 60.0 * samples * features,
        "elastic-net" => {
            0.2 * samples * features * features + 20.0 * 100.0 * channels * features * features
        }
        "kernel-ridge" => kernel,
        "gaussian-process" => 1.5 * kernel,
        "knn" => 0.1 * samples * samples * features,
        "lda" => channels * (0.5 * samples * features * features + 9.0 * features.powi(3)),
        "random-forest" => {
            2_000.0 * channels * 0.3 * features * samples * samples.log2().max(1.0) * 2.0
        }
        "gradient-boosting" => {
            15.0 * 300.0 * channels * 0.1 * features * (5.0 * samples + 32.0 * 256.0)
        }
        "cnn" => network(120.0, 200.0)?,
        "resnet10" => network(1_350.0, 60.0)?,
        "resnet18" => network(2_600.0, 60.0)?,
        "resnet34" => network(5_200.0, 60.0)?,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_small_network_of_a_recording_of_some_thousand_frames_takes_less_than_half_an_hour() {
        let sizes = Sizes {
            samples: 3_000.0,
            features: 1_024.0,
            picture: Some(128.0 * 96.0),
            channels: 6.0,
        };
        let cnn = seconds(work(NETWORK, sizes).expect("pictures"));
        assert!((600.0..1_200.0).contains(&cnn), "{cnn}");
        for name in DEEPER {
            assert!(seconds(work(name, sizes).expect("pictures")) > 3.0 * cnn);
        }
        let flat = Sizes {
            picture: None,
            ..sizes
        };
        assert!(work(NETWORK, flat).is_none());
        assert!(work("ridge", flat).is_some());
    }
}
