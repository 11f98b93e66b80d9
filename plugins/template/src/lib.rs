#![doc = include_str!("../README.md")]

mod c;
mod kind;
mod name;
mod project;
mod python;

pub use c::c_project;
pub use kind::Kind;
pub use name::{Name, NameError};
pub use project::{File, Sources, headers, project};
pub use python::{python_project, torch_project};
