//! What is known of whatever predicted: a model of ours, or something that a caller holds.

use std::collections::BTreeMap;

use taceva_core::Channels;
use taceva_models::{LabelBounds, Model};

/// What is known of whatever predicted.
#[derive(Debug)]
pub struct Predictor {
    /// The channels.
    pub channels: Channels,
    /// By the labels that were learnt, as far as they are known.
    pub bounds: LabelBounds,
    /// The best constant answers, by channel, as far as they are known.
    pub constants: BTreeMap<String, f64>,
    /// Whether frames are read.
    pub reads_frames: bool,
}

impl Predictor {
    /// A fitted model.
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
