//! Kernel models: compare the features x of a sample with the features x' of landmarks by exp(−‖x − x'‖² / 2ℓ²D). Landmarks are selected training
//! samples, and ℓ is the kernel length.
//!
//! D is the variance over the training part, summed over features. A length ℓ therefore has the same meaning for bright and dark pictures, and for
//! many and few features. The Nyström approximation with landmarks replaces a kernel of all training samples. Every linear method of this crate can
//! be fitted to Nyström features. Ridge regression on Nyström features is kernel ridge regression.

mod gaussian_process;
mod landmarks;
mod likelihood;
mod nystrom;
mod reach;
mod regressor;
mod ridge;
mod uncertainty;

pub use self::gaussian_process::GaussianProcess;
pub use self::reach::NORMAL_95;
pub use self::regressor::KernelRegressor;
pub use self::ridge::KernelRidge;

use taceva_core::{Features, ModelError, Progress, TrainingSet};

use self::landmarks::Landmarks;
use self::nystrom::Nystrom;
use crate::linalg::FeatureScale;
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};

const LENGTH: SettingInfo = SettingInfo {
    key: "length",
    accepts: "a number from 0.01 to 1000",
    default: "chosen, one for all channels",
    about: "length scale of the kernel, in typical distances of a sample from the mean",
};
const LANDMARKS: SettingInfo = SettingInfo {
    key: "landmarks",
    accepts: "a whole number from 1 to 5000",
    default: "500",
    about: "greatest number of landmarks: training samples with which all samples are compared",
};

/// Candidate kernel lengths, relative to the root mean square distance of a training sample from the mean. The longest gives the simplest model.
const LENGTHS: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Settings shared by all kernel methods.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kernel {
    scale: FeatureScale,
    length: Option<f64>,
    landmarks: usize,
}

impl Kernel {
    /// Settings that every kernel method lists in the registry.
    const SETTINGS: &'static [SettingInfo] =
        &[FeatureScale::SETTING, LENGTH, LANDMARKS, SettingInfo::REFIT];

    fn from_settings(settings: &ModelSettings) -> Result<Kernel, SettingError> {
        Ok(Kernel {
            scale: FeatureScale::from_settings(settings)?,
            length: settings.value(&LENGTH, None, |text| number(text, 0.01..=1000.0).map(Some))?,
            landmarks: settings.value(&LANDMARKS, 500, |text| number(text, 1..=5000))?,
        })
    }

    fn lengths(&self) -> Vec<f64> {
        self.length
            .map_or_else(|| LENGTHS.to_vec(), |length| vec![length])
    }

    fn landmarks(
        &self,
        training: &Features,
        progress: &dyn Progress,
    ) -> Result<Landmarks, ModelError> {
        Landmarks::choose(training, self.scale, self.landmarks, progress)
    }
}

/// Nyström features of training and validation part, for one kernel length.
struct Mapped {
    map: Nystrom,
    training: Features,
    validation: Option<Features>,
}

impl Mapped {
    fn new(landmarks: &Landmarks, length: f64, validation: Option<&Features>) -> Mapped {
        let map = Nystrom::new(landmarks, length);
        Mapped {
            training: map.of_training(landmarks),
            validation: validation.map(|features| map.of(features)),
            map,
        }
    }

    fn training<'s>(&'s self, set: &TrainingSet<'s>) -> TrainingSet<'s> {
        TrainingSet::new(&self.training, set.targets).with_groups(set.groups)
    }

    fn validation<'s>(&'s self, set: Option<&TrainingSet<'s>>) -> Option<TrainingSet<'s>> {
        let features = self.validation.as_ref()?;
        set.map(|set| TrainingSet::new(features, set.targets).with_groups(set.groups))
    }
}
