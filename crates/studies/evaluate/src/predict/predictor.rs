//! Facts about the source of predictions: a built-in model, or a caller's own model.

use std::collections::BTreeMap;

use taceva_core::Channels;
use taceva_models::{LabelBounds, Model};

/// Facts about the source of predictions.
#[derive(Debug)]
pub struct Predictor {
    /// Predicted channels.
    pub channels: Channels,
    /// Bounds computed from the training labels, if known.
    pub bounds: LabelBounds,
    /// Best constant predictions by channel, if known.
    pub constants: BTreeMap<String, f64>,
    /// True if the model reads frames.
    pub reads_frames: bool,
}

impl Predictor {
    /// Facts about a fitted model.
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
