//! Unfitted networks and their settings.

use taceva_core::{FeatureShape, SignalInfo};
use taceva_network::GpuKind;
use taceva_network::{Architecture, Augmentation, ConvolutionForm, Depth, Loss, Optimizer, Recipe};

use super::appearance::Preparation;
use super::classifier;
use super::head::{CLASS_WEIGHTS, ClassWeights, HEAD};
use super::regressor::picture;
use crate::features::Preprocessing;
use crate::features::{Color, FeatureError, FeatureKinds, FeatureSpec};
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::checkpoint::Checkpoints;
use crate::training::info::ModelInfo;

/// Unfitted network. Training uses AdamW, a one-cycle learning rate, and Huber's loss on standardised labels. With a validation part, the epoch of
/// least validation error is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkEstimator {
    kind: Kind,
    /// Training settings, except noise and shifts of the pictures. These are in [`preparation`](Self::preparation).
    recipe: Recipe,
    preparation: Preparation,
    /// Algorithm that computes convolutions during prediction.
    pub(super) convolutions: ConvolutionForm,
    /// Kind of GPU for training; `None` for the CPU.
    pub(super) gpu: Option<GpuKind>,
    /// Class weights of the loss, for a network that predicts classes. `None` for a network that predicts numbers.
    pub(super) classes: Option<ClassWeights>,
    pub(super) checkpoints: Option<Checkpoints>,
}

/// Architecture of the network: five plain layers, or residual layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    FiveLayers,
    Residual(Depth),
}

const EPOCHS: SettingInfo = SettingInfo {
    key: "epochs",
    accepts: "a whole number from 1 to 100000",
    default: "200 for cnn, 60 for residual networks",
    about: "number of times the network is trained on each sample",
};
const BATCH: SettingInfo = SettingInfo {
    key: "batch",
    accepts: "a whole number from 2 to 4096",
    default: "32",
    about: "number of samples per training step",
};
const RATE: SettingInfo = SettingInfo {
    key: "rate",
    accepts: "a number above 0 and at most 10",
    default: "0.003 for cnn, 0.001 for residual networks",
    about: "the highest learning rate of the one-cycle schedule",
};
const DECAY: SettingInfo = SettingInfo {
    key: "weight_decay",
    accepts: "a number from 0 to 10",
    default: "0.1",
    about: "the weight decay of AdamW",
};
const SEED: SettingInfo = SettingInfo {
    key: "seed",
    accepts: "a whole number",
    default: "1",
    about: "the seed of the first weights, the order of samples and the augmentation",
};
const PATIENCE: SettingInfo = SettingInfo {
    key: "patience",
    accepts: "a number of epochs from 1 on",
    default: "no early stop",
    about: "number of epochs without improvement on the validation part after which training stops",
};
const BRIGHTNESS: SettingInfo = SettingInfo {
    key: "brightness",
    accepts: "a number from 0 to 1",
    default: "0",
    about: "greatest relative change of the brightness of training pictures, after preprocessing",
};
const CONVOLUTIONS: SettingInfo = SettingInfo {
    key: "convolutions",
    accepts: "winograd, mixed or direct",
    default: "winograd",
    about: "the form of convolutions for predictions: winograd is fastest for batches, mixed for single pictures, as from a sensor",
};
const DEVICE: SettingInfo = SettingInfo {
    key: "device",
    accepts: "cpu, cuda or wgpu",
    default: "cpu",
    about: "the device for training; a GPU needs a program built with the feature of that name, and its last digits vary between runs",
};

const SETTINGS: &[SettingInfo] = &{
    let [appearance, jitter, noise, local_mean, contrast] = Preparation::SETTINGS;
    [
        EPOCHS,
        BATCH,
        RATE,
        DECAY,
        SEED,
        PATIENCE,
        appearance,
        jitter,
        noise,
        BRIGHTNESS,
        local_mean,
        contrast,
        CONVOLUTIONS,
        DEVICE,
        HEAD,
        CLASS_WEIGHTS,
    ]
};

/// Minimum number of rows and columns of a grid of taxels. Each of five layers halves both.
const PLACES_LEAST: u32 = 8;

/// Default feature settings of every network.
const FEATURES: FeatureSpec = FeatureSpec {
    kinds: FeatureKinds::PIXELS,
    width: 128,
    height: 96,
    color: Color::Gray,
    difference: false,
    pca: None,
    channels: None,
    window: None,
};

/// Builds the registry entry of a network from its name, its description and its architecture.
macro_rules! info {
    ($name:literal, $about:literal, $kind:expr) => {
        ModelInfo {
            name: $name,
            about: $about,
            settings: SETTINGS,
            features: Some(FEATURES),
            make: |settings| Ok(Box::new(NetworkEstimator::from_settings($kind, settings)?)),
            load: classifier::load,
        }
    };
}

impl NetworkEstimator {
    /// Entry of the small network in the model registry.
    pub const CNN: ModelInfo = info!(
        "cnn",
        "five convolutions: sees where markers move, fitted in a minute",
        Kind::FiveLayers
    );
    /// Entry of the ten-layer residual network in the model registry.
    pub const RESNET_10: ModelInfo = info!(
        "resnet10",
        "a residual network of ten layers",
        Kind::Residual(Depth::Ten)
    );
    /// Entry of the eighteen-layer residual network in the model registry.
    pub const RESNET_18: ModelInfo = info!(
        "resnet18",
        "a residual network of eighteen layers",
        Kind::Residual(Depth::Eighteen)
    );
    /// Entry of the thirty-four-layer residual network in the model registry.
    pub const RESNET_34: ModelInfo = info!(
        "resnet34",
        "a residual network of thirty-four layers",
        Kind::Residual(Depth::ThirtyFour)
    );

    /// Builds the small network of five convolutions from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn cnn(settings: &ModelSettings) -> Result<NetworkEstimator, SettingError> {
        NetworkEstimator::from_settings(Kind::FiveLayers, settings)
    }

    fn from_settings(
        kind: Kind,
        settings: &ModelSettings,
    ) -> Result<NetworkEstimator, SettingError> {
        settings.check_keys(SETTINGS)?;
        let (epochs, rate) = match kind {
            Kind::FiveLayers => (200, 3e-3),
            Kind::Residual(_) => (60, 1e-3),
        };
        let weight_decay = settings.value(&DECAY, 0.1, |text| number(text, 0.0..=10.0))?;
        let gpu = settings.value(&DEVICE, None, gpu_of)?;
        if let Some(kind) = gpu {
            kind.check_built()
                .map_err(|source| SettingError::Device { kind, source })?;
        }
        let weights = settings.value(&CLASS_WEIGHTS, ClassWeights::Equal, ClassWeights::of)?;
        let predicts_classes = settings.value(&HEAD, false, |text| match text {
            "numbers" => Some(false),
            "classes" => Some(true),
            _ => None,
        })?;
        Ok(NetworkEstimator {
            kind,
            recipe: Recipe {
                epochs: settings.value(&EPOCHS, epochs, |text| number(text, 1..=100_000))?,
                batch: settings.value(&BATCH, 32, |text| number(text, 2..=4096))?,
                rate: settings.value(&RATE, rate, |text| {
                    number(text, 0.0..=10.0).filter(|rate| *rate > 0.0)
                })?,
                optimizer: Optimizer::AdamW {
                    betas: (0.9, 0.999),
                    epsilon: 1e-8,
                    weight_decay,
                },
                loss: Loss::Huber { delta: 1.0 },
                seed: settings.value(&SEED, 1, |text| text.parse().ok())?,
                patience: settings.value(&PATIENCE, None, |text| number(text, 1..).map(Some))?,
                augmentation: Augmentation {
                    brightness: settings.value(&BRIGHTNESS, 0.0, |text| number(text, 0.0..=1.0))?,
                    ..Augmentation::default()
                },
                ..Recipe::default()
            },
            preparation: Preparation::from_settings(settings)?,
            convolutions: settings.value(&CONVOLUTIONS, ConvolutionForm::Winograd, form_of)?,
            gpu,
            classes: predicts_classes.then_some(weights),
            checkpoints: None,
        })
    }

    /// Copy of the estimator for signals of taxels, with the grid `info`. Fails if the grid is too small.
    pub(super) fn for_signals(&self, info: SignalInfo) -> Result<NetworkEstimator, FeatureError> {
        if info.rows.min(info.columns) < PLACES_LEAST {
            let least = PLACES_LEAST;
            return Err(FeatureError::NarrowGrid { info, least });
        }
        let mut own = self.clone();
        own.preparation = self.preparation.of_signals();
        Ok(own)
    }

    /// Training settings and preprocessing for pictures of `shape`.
    pub(super) fn recipe(&self, shape: FeatureShape) -> (Recipe, Preprocessing) {
        let prepared = self.preparation.of(shape);
        let mut recipe = self.recipe.clone();
        recipe.augmentation.noise = prepared.noise;
        recipe.augmentation.jitter = prepared.jitter();
        (recipe, prepared.preprocessing)
    }

    /// Copy of the estimator with a recipe modified by `change`.
    pub(super) fn with_recipe(&self, change: impl FnOnce(&mut Recipe)) -> NetworkEstimator {
        let mut own = self.clone();
        change(&mut own.recipe);
        own
    }

    pub(super) fn info(&self) -> ModelInfo {
        match self.kind {
            Kind::FiveLayers => NetworkEstimator::CNN,
            Kind::Residual(Depth::Ten) => NetworkEstimator::RESNET_10,
            Kind::Residual(Depth::Eighteen) => NetworkEstimator::RESNET_18,
            Kind::Residual(Depth::ThirtyFour) => NetworkEstimator::RESNET_34,
        }
    }

    pub(super) fn architecture(&self, shape: FeatureShape, outputs: usize) -> Architecture {
        match self.kind {
            Kind::FiveLayers => Architecture::five_layers(picture(shape), outputs),
            Kind::Residual(depth) => Architecture::residual(depth, picture(shape), outputs),
        }
    }
}

/// Parses the setting `convolutions`; `None` for an unknown word.
fn form_of(word: &str) -> Option<ConvolutionForm> {
    match word {
        "winograd" => Some(ConvolutionForm::Winograd),
        "mixed" => Some(ConvolutionForm::Mixed),
        "direct" => Some(ConvolutionForm::Direct),
        _ => None,
    }
}

/// Parses the setting `device`. `Some(None)` means the CPU, `Some(Some(kind))` a GPU, and `None` an unknown device.
fn gpu_of(device: &str) -> Option<Option<GpuKind>> {
    if device == "cpu" {
        return Some(None);
    }
    let mut kinds = GpuKind::ALL.into_iter();
    kinds.find(|kind| kind.name() == device).map(Some)
}
