#![doc = include_str!("../README.md")]

mod architecture;
mod batch_norm;
mod convolution;
mod error;
mod head;
mod isa;
mod loss;
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
pub use isa::{Isa, IsaError};
pub use loss::Loss;
pub use network::{Gradients, NamedTensor, Network};
pub use optimizer::Optimizer;
pub use planes::Picture;
pub use predictor::Predictor;
pub use schedule::Schedule;
pub use training::{
    Augmentation, Checkpoint, Epoch, Jitter, LabelScale, LabelScaling, Labels, Recipe, Samples,
    Step, Summary, Trained, Trainer, TrainingState,
};
