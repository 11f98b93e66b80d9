#![doc = include_str!("../README.md")]
#![no_std]

mod args;
mod changer;
mod device;
mod error;
mod estimator;
pub mod ext;
mod force;
mod host;
mod lighting;
mod plugin;
mod robot;
mod sensor;
mod status;
mod text;

pub use args::{Arg, Args};
pub use changer::ChangerCalls;
pub use device::{Device, DeviceCalls, Factory, Rig, Stamp};
pub use error::{Error, FaultNumber, MESSAGE_SIZE};
pub use estimator::{EstimatorFactory, Progress, Regressor, RegressorCalls, TrainingSet};
pub use force::{ForceCalls, Wrench};
pub use host::{Host, Level};
pub use lighting::LightingCalls;
pub use plugin::{
    ABI_MAJOR, ABI_MINOR, CHANGER_FACTORY, ENTRY_SYMBOL, ESTIMATOR_FACTORY, FORCE_FACTORY,
    LIGHTING_FACTORY, MAGIC, Plugin, ROBOT_FACTORY, SENSOR_FACTORY,
};
pub use robot::{Motion, Pose, RobotCalls};
pub use sensor::{FRAME_DROPPED, FRAME_NUMBERED, Frame, PixelFormat, SensorCalls};
pub use status::Status;
pub use text::{TakeText, Text};
