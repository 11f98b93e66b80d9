//! Tests of networks: layers, convolutions, trainings, predictions, engines.

mod common;
#[path = "common/draws.rs"]
mod draws;
mod engines;
mod forms;
mod gpu {
    mod device;
    mod features;
    mod not_built;
}
mod instructions;
mod layers;
mod long_training;
mod refusals;
mod torch;
mod training;
