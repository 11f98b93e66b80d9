//! Model cards: kind of model, training data, and errors of the fit.

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

/// Description stored in a model file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelCard {
    /// Version of the file format, `major.minor`.
    pub format: String,
    /// Version of TacEva that fitted the model.
    pub taceva: String,
    /// Name of the model.
    pub model: String,
    /// Settings given by the user, as `key=value`.
    pub settings: Vec<String>,
    /// Chosen setting and error of each channel.
    pub choice: Choice,
    /// True if the model was refitted on training and validation parts with the chosen settings.
    pub refitted: bool,
    /// Features of frames or signals.
    pub features: FeatureSpec,
    /// Share of the training variance kept by principal components, if there are any.
    pub pca_variance: Option<f64>,
    /// Only accepted input: size and format of frames (`frame` in the file), or grid of signals (`signals`).
    #[serde(flatten)]
    pub input: InputInfo,
    /// Divisors of each channel of a taxel: spread over the training part, rounded to a power of two. `None` for frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<Vec<f64>>,
    /// Allowed excess of predictions over the training labels, as a share of their range.
    pub margin: f64,
    /// Learnt channels: each predicted channel, or sine and cosine of an angle with a period.
    pub channels: Vec<ChannelCard>,
    /// Predicted angles with a period.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub angles: Vec<AngleCard>,
    /// Limits of the distance from the training samples. `None` for a model that uses no features, or in older files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<DistanceCard>,
    /// Number of samples of each part.
    pub samples: SampleCounts,
    /// Provenance of the samples.
    pub provenance: Provenance,
    /// Form of a model that is neither linear nor a network.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub form: Option<Form>,
    /// Record of an automatic choice of model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub auto: Option<AutoCard>,
    /// Record of an automatic choice of features.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature_choice: Option<FeatureChoice>,
    /// Network settings, for a network.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub network: Option<NetworkCard>,
    /// Network settings of each member, for an ensemble.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ensemble: Vec<NetworkCard>,
    /// Library that fitted the model and is needed to read it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<LibraryCard>,
    /// Plugin that fitted the model and is needed for predictions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plugin: Option<PluginCard>,
}

/// Form of a model that is neither linear nor a network.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Form {
    /// Kernel on landmarks.
    Kernel {
        /// Number of landmarks: training samples with which every sample is compared.
        landmarks: usize,
        /// Kernel length, in typical distances of a sample from the mean.
        length: f64,
        /// True if the model estimates standard deviations of its predictions.
        deviations: bool,
    },
    /// Nearest training samples.
    Neighbours {
        /// Number of stored samples.
        samples: usize,
    },
    /// Model that predicts one of the training labels.
    Classes {
        /// Number of classes, summed over channels.
        classes: usize,
    },
    /// Sum of trees.
    Trees {
        /// Number of trees.
        trees: usize,
    },
    /// Model of another library.
    Library,
}

/// A channel and its training labels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChannelCard {
    /// Name of the channel.
    pub name: String,
    /// Unit of predictions.
    pub unit: Unit,
    /// Least training label.
    pub minimum: f64,
    /// Range of the training labels; 1 if they are constant.
    pub span: f64,
    /// Mean training label: the best constant prediction, the reference of skill.
    pub mean: f64,
    /// True if all training labels are equal. The channel is then predicted as this label.
    pub constant_label: bool,
}

/// An angle with a period, learnt as the channels `NAME_sin` and `NAME_cos`.
///
/// ```
/// let text = r#"{"name": "yaw", "period": 360, "from_zero": false, "mean": -12.5}"#;
/// let angle: taceva_models::AngleCard = serde_json::from_str(text)?;
/// assert_eq!((angle.name.as_str(), angle.period), ("yaw", 360));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AngleCard {
    /// Name of the angle.
    pub name: String,
    /// Unit of predictions, degrees or radians.
    #[serde(default = "degree", skip_serializing_if = "is_degree")]
    pub unit: Unit,
    /// Period, degrees.
    pub period: u16,
    /// True for predictions from 0 to the period, like the labels; false for predictions around 0.
    pub from_zero: bool,
    /// Mean direction of the training part, in `unit`.
    pub mean: f64,
}

fn degree() -> Unit {
    Unit::Degree
}

fn is_degree(unit: &Unit) -> bool {
    *unit == Unit::Degree
}

/// Number of samples of each part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SampleCounts {
    /// Training samples.
    pub train: usize,
    /// Validation samples, which chose settings.
    pub validation: usize,
}

/// Provenance of samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Digest of the recording, `sha256:…`. For several recordings: digest of all, in order.
    pub data: Option<String>,
    /// Digest of each recording, in order, if there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<String>,
    /// View of the frames, if samples have several pictures: `left`, or `left+right` side by side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// Origin of the recording.
    pub source: Source,
    /// Split of the recording.
    pub split: Option<SplitCard>,
    /// Further notes for readers.
    pub notes: Vec<String>,
    /// Cross-validation scores, for a model fitted on every sample.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub validation: Option<ValidationCard>,
}

/// Cross-validation of a model that was fitted on every sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValidationCard {
    /// Split, such as `cv:5 by-point`.
    pub split: String,
    /// Seed of the split.
    pub seed: u64,
    /// Number of predicted samples.
    pub samples: usize,
    /// Findings about similar neighbouring samples.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neighbours: Option<String>,
    /// Scores of the cross-validation.
    pub scores: Vec<ValidationScore>,
}

/// Score of a cross-validation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValidationScore {
    /// Metric of the score, such as `mae`.
    pub metric: String,
    /// Channel of the score.
    pub channel: String,
    /// Value, in the unit of metric and channel.
    pub value: f64,
    /// 95 % interval, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
}

/// Origin of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// A real sensor.
    Recorded,
    /// A simulated sensor.
    Simulated,
    /// Artificial numbers for a test.
    Synthetic,
    /// Origin not stated.
    #[default]
    Unknown,
}

/// A split and its seed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SplitCard {
    /// Split as written, with its fractions.
    pub split: String,
    /// Seed of the split.
    pub seed: u64,
}

/// Entries of a card that describe the kind of model.
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
    /// Version of the format that this crate writes.
    pub const FORMAT: &'static str = FORMAT;

    /// Entries that describe the kind of model.
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
