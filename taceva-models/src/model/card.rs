//! What a model is, what it was fitted on, and how well it did there.

use serde::{Deserialize, Serialize};
use taceva_core::{InputInfo, Unit};

use super::input::FitInput;
use crate::estimators::auto::AutoCard;
use crate::estimators::library::LibraryCard;
use crate::estimators::network::NetworkCard;
use crate::estimators::plugin::PluginCard;
use crate::features::FeatureSpec;
use crate::features::choice::FeatureChoice;
use crate::training::choice::Choice;
use crate::training::fit::{ModelFit, ModelRegressor};
use crate::training::label_scaling::label_means;

/// How far beyond the labels of the training part predictions may go, as a share of their range.
pub(super) const MARGIN: f64 = 0.25;

/// The description kept in a model file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelCard {
    /// The version of the file format, `major.minor`.
    pub format: String,
    /// The version of TacEva that fitted it.
    pub taceva: String,
    /// The name of the model.
    pub model: String,
    /// The settings a person gave, as `key=value`.
    pub settings: Vec<String>,
    /// What was chosen for each channel, and the error there.
    pub choice: Choice,
    /// Whether the validation part was learnt from too, once the settings were chosen.
    pub refitted: bool,
    /// What it sees of a frame, or of signals.
    pub features: FeatureSpec,
    /// The share of the training part's variance that the principal components keep, if there are any.
    pub pca_variance: Option<f64>,
    /// What it was fitted on, and the only thing it takes: `frame` in the file, as in every older one, or `signals`.
    #[serde(flatten)]
    pub input: InputInfo,
    /// What the numbers of each channel of a place are divided by, a power of two next to its spread over the training part; of signals alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<Vec<f64>>,
    /// How far beyond the labels of the training part predictions may go, as a share of their range; no bound where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// What it predicts.
    pub channels: Vec<ChannelCard>,
    /// How many samples it was fitted on.
    pub samples: SampleCounts,
    /// Where the samples come from.
    pub provenance: Provenance,
    /// What it is where it is neither linear nor a network.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub form: Option<Form>,
    /// How the model was chosen, where a person left that open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub auto: Option<AutoCard>,
    /// How its features were chosen, where a person left that open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature_choice: Option<FeatureChoice>,
    /// The network, where the model is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub network: Option<NetworkCard>,
    /// The networks, where the model is the mean of several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ensemble: Vec<NetworkCard>,
    /// The library that fitted it and is needed to read it, where the model is of one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<LibraryCard>,
    /// The plugin that fitted it and is needed to predict with it, where the model is of one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plugin: Option<PluginCard>,
}

/// What a model that is neither linear nor a network consists of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Form {
    /// A kernel of landmarks.
    Kernel {
        /// How many landmarks there are: training samples with which every sample is compared.
        landmarks: usize,
        /// How far the kernel reaches, in typical distances of a sample from the mean.
        length: f64,
        /// Whether it estimates the standard deviation of its predictions.
        deviations: bool,
    },
    /// Training samples that are looked up.
    Neighbours {
        /// How many are kept.
        samples: usize,
    },
    /// Classes.
    Classes {
        /// How many there are, over all channels.
        classes: usize,
    },
    /// Trees whose answers are added up.
    Trees {
        /// How many there are.
        trees: usize,
    },
    /// Parameters of another library's model.
    Library,
}

impl Form {
    pub(crate) fn of(regressor: &ModelRegressor) -> Option<Form> {
        match regressor {
            ModelRegressor::Linear(_)
            | ModelRegressor::Network(_)
            | ModelRegressor::Ensemble(_)
            | ModelRegressor::Plugin(_) => None,
            ModelRegressor::Kernel(kernel) => Some(Form::Kernel {
                landmarks: kernel.landmarks(),
                length: kernel.length(),
                deviations: kernel.knows_deviations(),
            }),
            ModelRegressor::Neighbours(neighbours) => Some(Form::Neighbours {
                samples: neighbours.samples(),
            }),
            ModelRegressor::Classes(classes) => Some(Form::Classes {
                classes: classes.classes(),
            }),
            ModelRegressor::Trees(trees) => Some(Form::Trees {
                trees: trees.trees(),
            }),
            ModelRegressor::Library(_) => Some(Form::Library),
            ModelRegressor::Projected(projected) => Form::of(projected.inner()),
        }
    }
}

/// A channel, and the labels it was learnt from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChannelCard {
    /// The name.
    pub name: String,
    /// The unit of predictions.
    pub unit: Unit,
    /// The least label of the training part.
    pub minimum: f64,
    /// Greatest minus least label of the training part; 1 where that is 0.
    pub span: f64,
    /// The mean label of the training part, the best constant answer, by which skill is measured; absent in files from before skill was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean: Option<f64>,
    /// Whether every label of the training part is the same: the channel is predicted as that.
    pub constant_label: bool,
}

/// Samples of each part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SampleCounts {
    /// Learnt from.
    pub train: usize,
    /// Settings were chosen by them.
    pub validation: usize,
}

/// Where samples come from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// The digest of the recording, `sha256:…`; of several that of all of them in their order.
    pub data: Option<String>,
    /// The digest of each recording, in their order, where there were several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<String>,
    /// What made the recording.
    pub source: Source,
    /// How it was split.
    pub split: Option<SplitCard>,
    /// What else a reader should know.
    pub notes: Vec<String>,
}

/// What made a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// A real sensor.
    Recorded,
    /// A simulated sensor.
    Simulated,
    /// Numbers made up for a test.
    Synthetic,
    /// Nobody wrote it down.
    #[default]
    Unknown,
}

/// A split and its seed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SplitCard {
    /// As people write it, with its fractions.
    pub split: String,
    /// The seed.
    pub seed: u64,
}

impl ModelCard {
    /// The version of the format that this crate writes.
    pub const FORMAT: &'static str = crate::training::file::limits::FORMAT;

    pub(super) fn new(
        input: &FitInput<'_>,
        fit: &ModelFit,
        (model, auto): (&str, Option<AutoCard>),
        (pca_variance, spread): (Option<f64>, Option<Vec<f64>>),
    ) -> ModelCard {
        let channels = input.training.targets.channels.iter().enumerate();
        let means = label_means(input.training.targets);
        ModelCard {
            format: ModelCard::FORMAT.into(),
            taceva: env!("CARGO_PKG_VERSION").into(),
            model: model.into(),
            settings: input.settings.words().collect(),
            choice: fit.choice.clone(),
            refitted: fit.refitted,
            features: input.features,
            pca_variance,
            input: input.input,
            spread,
            margin: Some(MARGIN),
            channels: channels
                .map(|(position, channel)| ChannelCard {
                    name: channel.name().into(),
                    unit: channel.unit(),
                    minimum: fit.scaling.minimum()[position],
                    span: fit.scaling.span()[position],
                    mean: Some(means[position]),
                    constant_label: fit.scaling.is_constant(position),
                })
                .collect(),
            samples: SampleCounts {
                train: input.training.features.samples(),
                validation: input.validation.map_or(0, |set| set.features.samples()),
            },
            provenance: input.provenance.clone(),
            auto,
            feature_choice: None,
            form: Form::of(&fit.regressor),
            network: match &fit.regressor {
                ModelRegressor::Network(network) => Some(network.card().clone()),
                _ => None,
            },
            ensemble: match &fit.regressor {
                ModelRegressor::Ensemble(ensemble) => ensemble.cards(),
                _ => Vec::new(),
            },
            library: match &fit.regressor {
                ModelRegressor::Library(library) => Some(library.card().clone()),
                _ => None,
            },
            plugin: match &fit.regressor {
                ModelRegressor::Plugin(plugin) => Some(plugin.card().clone()),
                _ => None,
            },
        }
    }
}
