#![doc = include_str!("../README.md")]

mod architecture;
mod batch_norm;
mod constant;
mod convolution;
mod error;
mod gpu;
mod head;
mod labels;
mod loss;
mod machine;
mod max_pool;
mod network;
mod normalised_convolution;
mod optimizer;
mod panel;
mod picture;
mod planes;
mod predictor;
mod samples;
mod schedule;
mod scratch;
mod simd;
mod stage;
mod team;
mod training;
mod update;

pub use architecture::{Architecture, Body, Depth, PlainLayer, Pooling, StagePlan};
pub use convolution::ConvolutionForm;
pub use error::{NetworkError, SampleSet};
pub use gpu::{Gpu, GpuError, GpuKind};
pub use labels::Labels;
pub use loss::Loss;
pub use network::{Gradients, NamedTensor, Network};
pub use optimizer::{Adam, Momentum, Optimizer, Rule};
pub use picture::Picture;
pub use predictor::Predictor;
pub use samples::Samples;
pub use schedule::Schedule;
pub use taceva_core::{Isa, IsaError};
pub use training::{
    Augmentation, Batch, Breakage, Checkpoint, Engine, Epoch, Jitter, LabelScale, LabelScaling,
    Moments, Recipe, Snapshot, Step, Summary, Trained, Trainer, TrainingState,
};
