#![doc = include_str!("../README.md")]

#[cfg(feature = "ndarray")]
mod arrays;
mod auto;
mod baseline;
mod choice;
mod discriminant;
mod distance;
mod elastic_net;
mod feature_choice;
mod features;
mod fit;
mod gratings;
mod kernel;
mod label_scaling;
mod library;
mod linalg;
mod linear;
mod model;
mod models;
mod neighbours;
mod network;
mod output;
mod pls;
mod plugin;
mod problem;
mod progress;
mod projected;
mod registry;
mod ridge;
mod settings;
mod split;
mod standard;
mod tensors;
mod trees;
mod trials;

#[cfg(feature = "ndarray")]
pub use arrays::{EstimatorArrays, RegressorArrays, features_of};
pub use auto::{Auto, AutoCard, AutoTrial, Untried};
pub use baseline::Baseline;
pub use choice::{ChannelChoice, Choice, ChosenBy};
pub use discriminant::{ClassRegressor, Discriminant, LinearDiscriminant};
pub use elastic_net::ElasticNet;
pub use feature_choice::{FailedFeatures, FeatureChoice, FeatureTrial, OpenFeatures};
pub use features::{
    Color, Extractor, FeatureError, FeatureKind, FeatureKinds, FeatureSpec, Marker, MarkerTracker,
    Pca, Polarity, Tracked,
};
pub use fit::{Chosen, ModelEstimator, ModelFit, ModelRegressor};
pub use gratings::{FourierPlane, RadialSpectrum};
pub use kernel::{GaussianProcess, KernelRegressor, KernelRidge, NORMAL_95, SupportVectors};
pub use label_scaling::LabelScaling;
pub use library::{
    LibraryCard, LibraryLearner, LibraryModel, LibraryPredictor, LibraryRegressor, LibrarySettings,
    LibrarySizes, LibraryTask, LibraryTensor, LibraryTensors, LoadedPredictor, Numbers,
    library_estimator,
};
pub use linear::{LinearEstimator, LinearFit, LinearRegressor};
pub use model::{
    ChannelCard, FitInput, Form, FormatError, Model, ModelCard, ModelFileError, Provenance,
    SampleCounts, Source, SplitCard,
};
pub use models::{ChosenModel, Models};
pub use neighbours::{NeighbourRegressor, Neighbours};
pub use network::{
    CheckpointError, Checkpoints, Foreign, NetworkCard, NetworkEstimator, NetworkRegressor,
    Preprocessing, SpacingNetwork, SpacingOutput,
};
pub use pls::Pls;
pub use plugin::{PluginCard, PluginRegressor};
pub use projected::ProjectedRegressor;
pub use registry::{ALL, ModelInfo, UnknownModel, find};
pub use ridge::Ridge;
pub use settings::{SettingError, SettingInfo, Settings, Suggestion};
pub use split::{
    ColumnSplit, Fractions, Part, Split, SplitCounts, SplitError, SplitInput, SplitKind,
    SplitManifest, SplitSpec,
};
pub use trees::{GradientBoosting, RandomForest, TreeRegressor};
