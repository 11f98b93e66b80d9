//! What a model is, what it was fitted on, and how well it did there.

mod auto;
mod distance;
mod library;
mod network;
mod plugin;

use serde::{Deserialize, Serialize};
use taceva_core::{InputInfo, Unit};

pub(crate) use self::auto::FOLDS;
pub use self::auto::{AutoCard, AutoTrial, Untried};
pub use self::distance::DistanceCard;
pub use self::library::LibraryCard;
pub use self::network::NetworkCard;
pub use self::plugin::PluginCard;
use crate::features::FeatureSpec;
use crate::features::choice::FeatureChoice;
use crate::training::choice::Choice;
use crate::training::file::limits::FORMAT;

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
    /// What it was fitted on, and the only thing it takes: `frame` in the file, or `signals`.
    #[serde(flatten)]
    pub input: InputInfo,
    /// What the numbers of each channel of a place are divided by, a power of two next to its spread over the training part; of signals alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<Vec<f64>>,
    /// How far beyond the labels of the training part predictions may go, as a share of their range.
    pub margin: f64,
    /// What it learnt: each channel that it predicts, of an angle with a period its sine and cosine.
    pub channels: Vec<ChannelCard>,
    /// The angles among what it predicts that have a period.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub angles: Vec<AngleCard>,
    /// Limits of the distance from its training samples; absent of a model that looks at nothing or is of before models said so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<DistanceCard>,
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
    /// The mean label of the training part, the best constant answer, by which skill is measured.
    pub mean: f64,
    /// Whether every label of the training part is the same: the channel is predicted as that.
    pub constant_label: bool,
}

/// An angle with a period, which is learnt as the channels `NAME_sin` and `NAME_cos`.
///
/// ```
/// let text = r#"{"name": "yaw", "period": 360, "from_zero": false, "mean": -12.5}"#;
/// let angle: taceva_models::AngleCard = serde_json::from_str(text)?;
/// assert_eq!((angle.name.as_str(), angle.period), ("yaw", 360));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AngleCard {
    /// The name.
    pub name: String,
    /// Degrees after which it repeats.
    pub period: u16,
    /// True if predictions run from 0 to the period, as the labels do, and not from minus half of it.
    pub from_zero: bool,
    /// The mean direction of the training part, degrees.
    pub mean: f64,
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
    /// The view of its frames, of a recording whose samples have several pictures: `left`, or `left+right` side by side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// What made the recording.
    pub source: Source,
    /// How it was split.
    pub split: Option<SplitCard>,
    /// What else a reader should know.
    pub notes: Vec<String>,
    /// Scores of models fitted alike on samples that they have not seen, of a model that was fitted on every sample.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub validation: Option<ValidationCard>,
}

/// Cross-validation behind a model that was fitted on every sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValidationCard {
    /// The split, such as `cv:5 by-point`.
    pub split: String,
    /// The seed of the split.
    pub seed: u64,
    /// Samples that were predicted, each once.
    pub samples: usize,
    /// Findings on neighbouring samples that resemble each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neighbours: Option<String>,
    /// The scores.
    pub scores: Vec<ValidationScore>,
}

/// Score of a cross-validation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValidationScore {
    /// The metric: `mae`.
    pub metric: String,
    /// The channel.
    pub channel: String,
    /// The value, in the unit of the metric and channel.
    pub value: f64,
    /// Both ends of its interval of 95 %, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
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

/// The parts of a card that describe a kind of model.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct KindCard {
    pub(crate) form: Option<Form>,
    pub(crate) network: Option<NetworkCard>,
    pub(crate) ensemble: Vec<NetworkCard>,
    pub(crate) library: Option<LibraryCard>,
    pub(crate) plugin: Option<PluginCard>,
}

impl From<Form> for KindCard {
    fn from(form: Form) -> KindCard {
        KindCard {
            form: Some(form),
            ..KindCard::default()
        }
    }
}

impl ModelCard {
    /// The version of the format that this crate writes.
    pub const FORMAT: &'static str = FORMAT;

    /// The parts that describe the kind of model.
    pub(crate) fn kind(&self) -> KindCard {
        KindCard {
            form: self.form,
            network: self.network.clone(),
            ensemble: self.ensemble.clone(),
            library: self.library.clone(),
            plugin: self.plugin.clone(),
        }
    }
}
