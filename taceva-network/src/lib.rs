#![doc = include_str!("../README.md")]

mod architecture;
mod batch_norm;
mod constant;
mod convolution;
mod error;
mod head;
mod loss;
mod machine;
mod max_pool;
mod network;
mod normed;
mod optimizer;
mod panel;
mod planes;
mod predictor;
mod random;
mod schedule;
mod scratch;
mod simd;
mod stage;
mod training;
mod update;

pub use architecture::{Architecture, Body, Depth, PlainLayer, Pooling};
pub use error::{NetworkError, Part};
pub use loss::Loss;
pub use network::{Gradients, NamedTensor, Network};
pub use optimizer::Optimizer;
pub use planes::Picture;
pub use predictor::Predictor;
pub use schedule::Schedule;
pub use taceva_core::{Isa, IsaError};
pub use training::{
    Augmentation, Breakage, Checkpoint, Epoch, Jitter, LabelScale, LabelScaling, Labels, Recipe,
    Samples, Step, Summary, Trained, Trainer, TrainingState,
};
