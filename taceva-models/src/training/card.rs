//! Model cards: kind of the model, training data, and errors of the fit.

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
    /// Name of the model.
    pub model: String,
    /// Settings that the user gave, as `key=value`.
    pub settings: Vec<String>,
    /// Chosen setting and error of each channel.
    pub choice: Choice,
    /// True if the model was refitted on training and validation parts with the chosen settings.
    pub refitted: bool,
    /// Specification of the features of frames or signals.
    pub features: FeatureSpec,
    /// Share of the training variance that the principal components explain; `None` without principal components.
    pub pca_variance: Option<f64>,
    /// The only accepted input: size and format of frames (`frame` in the file), or grid of signals (`signals`).
    #[serde(flatten)]
    pub input: InputInfo,
    /// Divisor of each channel of a taxel: the spread over the training part, rounded to a power of two. `None` for frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<Vec<f64>>,
    /// Maximum distance of predictions beyond the training labels, as a share of the label range.
    pub margin: f64,
    /// Learnt channels: each predicted channel, or the sine and cosine of an angle with a period.
    pub channels: Vec<ChannelCard>,
    /// Predicted angles with a period.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub angles: Vec<AngleCard>,
    /// Limits of the distance from the training samples; `None` for a model without features, or in older files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<DistanceCard>,
    /// Number of samples in each part.
    pub samples: SampleCounts,
    /// Provenance of the samples.
    pub provenance: Provenance,
    /// Form of the model; `None` for a linear model or a network.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub form: Option<Form>,
    /// Record of an automatic choice of model; `None` without this choice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub auto: Option<AutoCard>,
    /// Record of an automatic choice of features; `None` without this choice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature_choice: Option<FeatureChoice>,
    /// Network settings; `None` for other models.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub network: Option<NetworkCard>,
    /// Network settings of each member of an ensemble; empty for other models.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ensemble: Vec<NetworkCard>,
    /// Library that fitted the model and is needed to read it; `None` for other models.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<LibraryCard>,
    /// Plugin that fitted the model and is needed for predictions; `None` for other models.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plugin: Option<PluginCard>,
}

/// Form of a model other than a linear model or a network.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Form {
    /// Kernel evaluated at landmarks.
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
        /// Number of stored training samples.
        samples: usize,
    },
    /// Model that predicts one of the training labels.
    Classes {
        /// Total number of classes over all channels.
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
    /// Unit of the predictions.
    pub unit: Unit,
    /// Least training label.
    pub minimum: f64,
    /// Range of the training labels; 1 if all labels are equal.
    pub span: f64,
    /// Mean training label: the best constant prediction, and the reference of the skill.
    pub mean: f64,
    /// True if all training labels are equal. The model then predicts this label.
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
    /// Unit of predictions: degrees or radians.
    #[serde(default = "degree", skip_serializing_if = "is_degree")]
    pub unit: Unit,
    /// Period, in degrees.
    pub period: u16,
    /// True for predictions between 0 and the period, like the labels; false for predictions centred at 0.
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
    /// Number of training samples.
    pub train: usize,
    /// Number of validation samples, on which settings were chosen.
    pub validation: usize,
}

/// Provenance of the samples of a fit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Digest of the recording, `sha256:…`. For several recordings, the digest of all recordings in order. `None` if unknown.
    pub data: Option<String>,
    /// Digest of each recording, in order, if there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<String>,
    /// View of the frames, if samples have several pictures: `left`, or `left+right` for both side by side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<String>,
    /// Origin of the recording.
    pub source: Source,
    /// Split of the recording; `None` if there was no split.
    pub split: Option<SplitCard>,
    /// Further notes for readers.
    pub notes: Vec<String>,
    /// Cross-validation scores, for a model fitted to all samples; `None` without a cross-validation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub validation: Option<ValidationCard>,
    /// Task whose classes the model predicts; `None` for measured channels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub task: Option<TaskCard>,
}

/// Cross-validation of a model that was fitted to all samples.
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
    /// Value of the score, in the unit of metric and channel.
    pub value: f64,
    /// 95 % interval of the score; `None` if it has no interval.
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
    /// Split as the user wrote it, with its fractions.
    pub split: String,
    /// Seed of the split.
    pub seed: u64,
}

/// Entries of a card that depend on the kind of model.
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

    /// Entries that depend on the kind of model.
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
