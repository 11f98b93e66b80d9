//! Model cards. A card describes the model, its training data and its choice of settings.

mod auto;
mod distance;
mod library;
mod network;
mod plugin;
mod task;

use serde::{Deserialize, Serialize};
use taceva_core::{InputInfo, Unit};

pub(crate) use self::auto::FOLDS;
pub use self::auto::{AutoCard, AutoTrial, Untried};
pub use self::distance::DistanceCard;
pub use self::library::LibraryCard;
pub use self::network::{ClassCard, NetworkCard};
pub use self::plugin::PluginCard;
pub use self::task::TaskCard;
use crate::features::FeatureSpec;
use crate::features::choice::FeatureChoice;
use crate::training::choice::Choice;
use crate::training::file::limits::FORMAT;

/// Description of a model, stored in its file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelCard {
    /// Version of the file format, `major.minor`.
    pub format: String,
    /// Version of TacEva with which the model was fitted.
    pub taceva: String,
    /// Name of the model in the registry, such as `ridge`.
    pub model: String,
    /// Settings that the user gave, as `key=value`.
    pub settings: Vec<String>,
    /// Setting chosen for each channel, and its error.
    pub choice: Choice,
    /// True if the model was refitted on the training and validation parts after its settings were chosen.
    pub refitted: bool,
    /// Features that the model computes from frames or signals.
    pub features: FeatureSpec,
    /// Share of the training variance that the principal components explain; `None` without principal components.
    pub pca_variance: Option<f64>,
    /// Accepted input. In the file, `frame` states the size and format of frames, or `signals` the taxel grid.
    #[serde(flatten)]
    pub input: InputInfo,
    /// Divisor of each signal channel: its spread over the training part, rounded to a power of two. `None` for a model of frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<Vec<f64>>,
    /// Maximum amount by which predictions may exceed the range of the training labels, as a share of this range.
    pub margin: f64,
    /// Channels that the regressor predicts. An angle with a period is represented by its sine and cosine.
    pub channels: Vec<ChannelCard>,
    /// Predicted angles with a period.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub angles: Vec<AngleCard>,
    /// Limits above which a sample is too unlike the training samples; `None` for a model without features, or in older files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<DistanceCard>,
    /// Number of samples in each part.
    pub samples: SampleCounts,
    /// Provenance of the samples.
    pub provenance: Provenance,
    /// Form of the model; `None` for a linear model, a network or a plugin model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub form: Option<Form>,
    /// Record of the automatic choice among models; `None` if the user named the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub auto: Option<AutoCard>,
    /// Record of the automatic choice among features; `None` if features were not chosen automatically.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature_choice: Option<FeatureChoice>,
    /// Settings of the network; `None` for a model without a network, and for an ensemble.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub network: Option<NetworkCard>,
    /// Network settings of each ensemble member; empty if the model is not an ensemble.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ensemble: Vec<NetworkCard>,
    /// External library that fitted the model and is needed to read it; `None` for a model of TacEva or a plugin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<LibraryCard>,
    /// Plugin that fitted the model and is needed for predictions; `None` without a plugin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plugin: Option<PluginCard>,
}

/// Form of a model other than a linear model or a network.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Form {
    /// Model of kernel values between a sample and landmarks.
    Kernel {
        /// Number of landmarks: training samples to which the kernel compares every sample.
        landmarks: usize,
        /// Kernel length, relative to the root mean square distance of training samples from their mean.
        length: f64,
        /// True if the model estimates standard deviations of its predictions.
        deviations: bool,
    },
    /// Model that predicts from the nearest training samples.
    Neighbours {
        /// Number of stored training samples.
        samples: usize,
    },
    /// Classifier. Every prediction is one of the training labels.
    Classes {
        /// Total number of classes over all channels.
        classes: usize,
    },
    /// Sum of decision trees.
    Trees {
        /// Number of trees.
        trees: usize,
    },
    /// Model fitted by an external library.
    Library,
}

/// Channel of a model, with statistics of its training labels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChannelCard {
    /// Name of the channel.
    pub name: String,
    /// Unit of the channel.
    pub unit: Unit,
    /// Least training label.
    pub minimum: f64,
    /// Range of the training labels; 1 if all labels are equal.
    pub span: f64,
    /// Mean training label, which is the best constant prediction. Skill is measured relative to this prediction.
    pub mean: f64,
    /// True if all training labels of the channel are equal. The model then always predicts this label.
    pub constant_label: bool,
}

/// Angle with a period. The model learns its sine and cosine as the channels `NAME_sin` and `NAME_cos`.
///
/// ```
/// let text = r#"{"name": "yaw", "period": 360, "from_zero": false, "mean": -12.5}"#;
/// let angle: taceva_models::AngleCard = serde_json::from_str(text)?;
/// assert_eq!((angle.name.as_str(), angle.period), ("yaw", 360));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AngleCard {
    /// Name of the predicted angle.
    pub name: String,
    /// Unit of predictions: degrees or radians.
    #[serde(default = "degree", skip_serializing_if = "is_degree")]
    pub unit: Unit,
    /// Period, in degrees.
    pub period: u16,
    /// True if predictions are between 0 and the period. False if they are between minus and plus half a period.
    pub from_zero: bool,
    /// Mean direction of the training labels, in `unit`.
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
    /// Number of training samples.
    pub train: usize,
    /// Number of validation samples, on which settings were chosen.
    pub validation: usize,
}

/// Provenance of the samples of a fit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Digest of the recording, `sha256:…`; for several recordings, the digest of all of them in order. `None` if unknown.
    pub data: Option<String>,
    /// Digest of each recording, in order; empty for a single recording.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<String>,
    /// View of the frames: `left`, or `left+right` for two pictures side by side. `None` if each sample has a single picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// Origin of the recording: real sensor, simulation or test data.
    pub source: Source,
    /// Split of the recording; `None` if the recording was not split.
    pub split: Option<SplitCard>,
    /// Notes on the samples and their split, as sentences for the user.
    pub notes: Vec<String>,
    /// Cross-validation of a model that was fitted to all samples; `None` if there was none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub validation: Option<ValidationCard>,
    /// Task whose classes or pose the model predicts; `None` for a model of other channels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub task: Option<TaskCard>,
}

/// Cross-validation of a model that was fitted to all samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValidationCard {
    /// Specification of the split, such as `cv:5 by-point`.
    pub split: String,
    /// Seed of the random assignment of samples to parts.
    pub seed: u64,
    /// Number of samples in the test parts.
    pub samples: usize,
    /// Note on neighbouring samples that resemble each other; `None` if there is no such note.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neighbours: Option<String>,
    /// Scores of the cross-validation.
    pub scores: Vec<ValidationScore>,
}

/// Score of one metric and channel in a cross-validation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValidationScore {
    /// Name of the metric, such as `mae`.
    pub metric: String,
    /// Name of the channel.
    pub channel: String,
    /// Value of the score. Its unit depends on the metric and the channel.
    pub value: f64,
    /// Lower and upper end of the 95 % confidence interval of the score; `None` if the interval is unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[f64; 2]>,
}

/// Origin of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// The recording comes from a real sensor.
    Recorded,
    /// The recording comes from a simulated sensor.
    Simulated,
    /// The recording contains artificial test data.
    Synthetic,
    /// The origin of the recording is not stated.
    #[default]
    Unknown,
}

/// Specification and seed of a split.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SplitCard {
    /// Specification of the split in its standard spelling, with its fractions.
    pub split: String,
    /// Seed of the random assignment of samples to parts.
    pub seed: u64,
}

/// Entries of a model card that depend on the kind of model.
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
    /// Version of the model file format that this crate writes.
    pub const FORMAT: &'static str = FORMAT;

    /// Card entries that depend on the kind of model.
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
