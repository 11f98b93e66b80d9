//! Guarantees of models: fits, predictions, files, splits and choices.

mod angles;
mod auto;
mod blobs;
mod checkpoints;
mod classes;
mod every_model;
mod feature_distance;
#[cfg(all(feature = "linfa", feature = "smartcore"))]
mod library;
mod linear;
mod linear_models;
mod linear_recordings;
mod model_file;
mod plugin_models;
mod sections;
mod spacings;
mod splits;
