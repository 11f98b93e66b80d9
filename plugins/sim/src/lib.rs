#![doc = include_str!("../README.md")]

mod bench;
mod drive;
mod number;
mod parameters;
mod provenance;
mod rig;
mod specimen;
mod unit;

pub mod contact;
pub mod displacement;
pub mod elastic;
pub mod optics;
pub mod random;

pub use bench::{Bench, Press, PressError};
pub use contact::{Contact, History};
pub use drive::{
    ForceTransducerFactory, LightingFactory, MountError, Mounted, RobotFactory, SensorFactory,
    SimulatedRig,
};
pub use parameters::{
    Ageing, Body, Camera, Dome, Entry, GelFault, GelWear, Gratings, Lattice, Layer, Markers,
    Material, Model, Origin, Outline, ParameterDigest, ParameterError, ParameterErrorKind,
    Parameters, Probing, Robot, Search, Surface, Transducer, Variation,
};
pub use provenance::{MODEL_VERSION, Provenance};
pub use rig::{Label, Touch};
pub use specimen::{Grating, GratingError, GratingPose, Indenter};
pub use unit::Unit;
