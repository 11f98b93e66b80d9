//! Facts of the source of predictions: a built-in model, or a model of the caller.

use std::collections::BTreeMap;

use taceva_core::Channels;
use taceva_models::{LabelBounds, Model};

/// Facts of the source of predictions.
#[derive(Debug)]
pub struct Predictor {
    /// The channels.
    pub channels: Channels,
    /// Bounds from the training labels, as far as known.
    pub bounds: LabelBounds,
    /// Best constant predictions by channel, as far as known.
    pub constants: BTreeMap<String, f64>,
    /// True if frames are read.
    pub reads_frames: bool,
}

impl Predictor {
    /// Facts of a fitted model.
    pub fn of(model: &Model) -> Predictor {
        Predictor {
            channels: model.channels().clone(),
            bounds: model.label_bounds(),
            constants: model
                .constants()
                .map(|(name, mean)| (name.to_owned(), mean))
                .collect(),
            reads_frames: model.reads_frames(),
        }
    }
}
