#![doc = include_str!("../README.md")]

mod baseline;
mod choice;
mod durable;
mod features;
mod fit;
mod gratings;
mod label_scaling;
mod linalg;
mod linear;
mod model;
mod models;
mod network;
mod pls;
mod plugin;
mod problem;
mod progress;
mod random;
mod registry;
mod ridge;
mod settings;
mod split;

pub use baseline::Baseline;
pub use choice::{ChannelChoice, Choice, ChosenBy};
pub use features::{Color, Extractor, FeatureError, FeatureSpec, Pca};
pub use fit::{ModelEstimator, ModelFit, ModelRegressor};
pub use gratings::{Discriminant, FourierPlane, RadialSpectrum};
pub use label_scaling::LabelScaling;
pub use linear::{LinearEstimator, LinearFit, LinearRegressor};
pub use model::{
    ChannelCard, FitInput, FormatError, Model, ModelCard, ModelFileError, Provenance, SampleCounts,
    Source, SplitCard,
};
pub use models::{ChosenModel, Models};
pub use network::{
    CheckpointError, Checkpoints, Foreign, NetworkCard, NetworkEstimator, NetworkRegressor,
    Preprocessing,
};
pub use pls::Pls;
pub use plugin::{PluginCard, PluginRegressor};
pub use registry::{ALL, ModelInfo, UnknownModel, find};
pub use ridge::Ridge;
pub use settings::{SettingError, SettingInfo, Settings, Suggestion};
pub use split::{
    ColumnSplit, Fractions, Part, Split, SplitCounts, SplitError, SplitInput, SplitKind,
    SplitManifest, SplitSpec,
};
