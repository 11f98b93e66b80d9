//! Code shared by the fits of all models: checks of samples, scaling of labels, choice of settings, and results.

pub(crate) mod card;
pub(crate) mod checkpoint;
pub(crate) mod choice;
pub(crate) mod components;
pub(crate) mod file;
pub(crate) mod fit;
pub(crate) mod info;
pub(crate) mod label_scaling;
pub(crate) mod output;
pub(crate) mod problem;
pub(crate) mod regressor;
pub(crate) mod trials;
