#![doc = include_str!("../README.md")]

mod calls;
mod convert;
mod driver;
mod driver_lists;
mod entry;
mod estimator;
mod export;
mod factory;
mod failure;
mod guard;
mod handles;
mod host;
mod interruption;
mod memory;
mod plugin;
mod rig;
mod table;

pub use driver::{Driver, Made, MakeEstimator, MakeFactory, Provide};
pub use estimator::{EstimatorFactory, FitRequest};
pub use export::Export;
pub use host::{log, now};
pub use interruption::{HaltLatch, Interrupted, InterruptibleCall, Interruption};
pub use plugin::plugin;
pub use table::{estimator_table, provides_table};
pub use taceva_abi::{self as abi, Level};
