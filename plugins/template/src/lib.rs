#![doc = include_str!("../README.md")]

mod kind;
mod name;
mod project;

pub use kind::Kind;
pub use name::{Name, NameError};
pub use project::{File, Sources, headers, project};
