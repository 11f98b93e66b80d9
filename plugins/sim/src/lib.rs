#![doc = include_str!("../README.md")]

mod parameters;

pub mod contact;
pub mod displacement;
pub mod elastic;
pub mod random;

pub use parameters::{
    Body, Camera, Dome, Entry, Gratings, Lattice, Layer, Markers, Material, Model, Origin,
    ParameterDigest, ParameterError, ParameterErrorKind, Parameters, Probing, Robot, Search,
    Surface, Transducer, Variation,
};
