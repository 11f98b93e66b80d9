#![doc = include_str!("../README.md")]

#[cfg(feature = "ndarray")]
mod arrays;
mod estimators;
mod features;
mod file;
mod linalg;
mod model;
mod models;
mod settings;
mod split;
mod threads;
mod training;

#[cfg(feature = "ndarray")]
pub use arrays::{EstimatorArrays, RegressorArrays, features_of};
pub use estimators::auto::Auto;
pub use estimators::baseline::Baseline;
pub use estimators::discriminant::{ClassRegressor, Discriminant, LinearDiscriminant};
pub use estimators::elastic_net::ElasticNet;
pub use estimators::kernel::{GaussianProcess, KernelRegressor, KernelRidge, NORMAL_95};
pub use estimators::library::{LibraryModel, LibraryRegressor, library_models};
pub use estimators::linear::{LinearEstimator, LinearFit, LinearRegressor};
pub use estimators::neighbours::{NeighbourRegressor, Neighbours};
pub use estimators::network::{
    EnsembleRegressor, NetworkClassifier, NetworkEnsemble, NetworkEstimator, NetworkRegressor,
    SpacingNetwork, SpacingOutput,
};
pub use estimators::pls::Pls;
pub use estimators::plugin::PluginRegressor;
pub use estimators::registry::{ALL, PRESETS, Preset, UnknownModel, find};
pub use estimators::ridge::Ridge;
pub use estimators::trees::{GradientBoosting, RandomForest, TreeRegressor};
pub use features::choice::{FailedFeatures, FeatureChoice, FeatureTrial, OpenFeatures};
pub use features::gratings::{FourierPlane, RadialSpectrum};
pub use features::{
    Color, Extractor, FeatureDistance, FeatureError, FeatureKind, FeatureKinds, FeatureSpec,
    FeaturesByRecording, FrameReduction, FrameWindow, Marker, MarkerTracker, Pca, Polarity,
    Preprocessing, RecordedFrames, Tracked,
};
pub use file::ModelFileError;
pub use model::{CloserFeatures, FitInput, LabelBounds, Model};
pub use models::{ChosenModel, Models};
pub use settings::{ModelSettings, SettingError, SettingInfo, Suggestion};
pub use split::{
    ColumnSplit, FoldGroups, FoldSpec, Folds, Fractions, Part, Split, SplitBlocks, SplitCounts,
    SplitError, SplitInput, SplitKind, SplitManifest, SplitSpec,
};
pub use threads::prepare_threads;
pub use training::card::{
    AngleCard, AutoCard, AutoTrial, ChannelCard, ClassCard, DistanceCard, Form, LibraryCard,
    ModelCard, NetworkCard, PluginCard, Provenance, SampleCounts, Source, SplitCard, TaskCard,
    Untried, ValidationCard, ValidationScore,
};
pub use training::checkpoint::{CheckpointError, Checkpoints, Foreign};
pub use training::choice::{ChannelChoice, Choice, ChosenBy};
pub use training::file::error::FormatError;
pub use training::fit::{Chosen, ModelEstimator, ModelFit};
pub use training::info::ModelInfo;
pub use training::label_scaling::{LabelScaling, label_means};
pub use training::regressor::{ClassProbabilities, ModelRegressor};
